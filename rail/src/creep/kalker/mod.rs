//! Kalker's creepage coefficients for any ratio of the semi-axes and any Poisson's ratio.

mod lookup;
mod table;

use std::f64::consts::PI;

pub(crate) use lookup::KalkerLookup;
pub use table::KalkerError;
use table::{Row, rows};

use crate::math::spline::Spline;

/// Kalker's coefficients of one contact, dimensionless; `T` is a number or a vector of numbers.
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KalkerCoefficients<T = f64> {
    /// `C11`: longitudinal force per longitudinal creepage.
    pub c11: T,
    /// `C22`: lateral force per lateral creepage.
    pub c22: T,
    /// `C23 = -C32`: lateral force per spin, and spin moment per lateral creepage.
    pub c23: T,
    /// `C33`: spin moment per spin; known to about 2 %.
    pub c33: T,
}

impl<T> KalkerCoefficients<T> {
    /// Applies `function` to each coefficient.
    fn map<U>(&self, function: impl Fn(&T) -> U) -> KalkerCoefficients<U> {
        KalkerCoefficients {
            c11: function(&self.c11),
            c22: function(&self.c22),
            c23: function(&self.c23),
            c33: function(&self.c33),
        }
    }

    /// Combines each coefficient with that of `other`.
    fn zip<U>(&self, other: &Self, function: impl Fn(&T, &T) -> U) -> KalkerCoefficients<U> {
        KalkerCoefficients {
            c11: function(&self.c11, &other.c11),
            c22: function(&self.c22, &other.c22),
            c23: function(&self.c23, &other.c23),
            c33: function(&self.c33, &other.c33),
        }
    }
}

/// Kalker's table for one Poisson's ratio.
///
/// Between the rows, a spline interpolates `ln C` over `ln(a/b)`, and a parabola interpolates between the three
/// Poisson's ratios of the table. Beyond the rows (0.1 to 10), the value at the end of the table grows as in Kalker's
/// asymptotic formulas (Kalker 1967), except `C33` of contacts that are long in the rolling direction, which stays
/// constant.
///
/// ```
/// use dashpot_rail::creep::KalkerTable;
/// let circle = KalkerTable::new(0.25)?.at(1.0);
/// assert!((circle.c11 - 4.12).abs() < 1e-9);
/// # Ok::<(), dashpot_rail::creep::KalkerError>(())
/// ```
#[derive(Debug, Clone)]
pub struct KalkerTable {
    poisson_ratio: f64,
    /// Minimum and maximum ratio of the rows.
    ratio_limits: [f64; 2],
    splines: KalkerCoefficients<Spline>,
}

/// Kalker's table of 1967.
const TABLE: &str = include_str!("../../../data/kalker.csv");

impl KalkerTable {
    /// Kalker's table of 1967, for `poisson_ratio`.
    ///
    /// # Errors
    /// Poisson's ratio is not within 0 to 0.5.
    pub fn new(poisson_ratio: f64) -> Result<Self, KalkerError> {
        Self::from_csv(TABLE, poisson_ratio)
    }

    /// Reads another table for `poisson_ratio`.
    ///
    /// The columns are `a_over_b,nu,C11,C22,C23,C33`. The table must contain the same three values of `nu` for each
    /// ratio of the semi-axes. Lines that begin with `#` are comments.
    ///
    /// # Errors
    /// A cell is not a positive number (`nu`: 0 to 0.5); rows are incomplete or out of order; Poisson's ratio is not
    /// within 0 to 0.5.
    pub fn from_csv(text: &str, poisson_ratio: f64) -> Result<Self, KalkerError> {
        let rows = rows(text)?;
        if !(0.0..=0.5).contains(&poisson_ratio) {
            return Err(KalkerError::PoissonRatio { poisson_ratio });
        }
        let ratios: Vec<f64> = rows
            .iter()
            .step_by(3)
            .map(|row| libm::log(row.ratio))
            .collect();
        let spline = |column: &'static str, coefficient: fn(&Row) -> f64| {
            let logarithm = |three: &[Row]| {
                let value = parabola(poisson_ratio, three, coefficient);
                if value > 0.0 {
                    Ok(libm::log(value))
                } else {
                    Err(KalkerError::NotPositive {
                        column,
                        ratio: three[0].ratio,
                        poisson_ratio,
                    })
                }
            };
            let values: Result<Vec<f64>, _> = rows.chunks_exact(3).map(logarithm).collect();
            Ok(Spline::fit(&ratios, &values?, 0.0))
        };
        Ok(Self {
            poisson_ratio,
            ratio_limits: [rows[0].ratio, rows[rows.len() - 1].ratio],
            splines: KalkerCoefficients {
                c11: spline("C11", |row| row.coefficients.c11)?,
                c22: spline("C22", |row| row.coefficients.c22)?,
                c23: spline("C23", |row| row.coefficients.c23)?,
                c33: spline("C33", |row| row.coefficients.c33)?,
            },
        })
    }

    /// Coefficients at `ratio`, the semi-axis in the rolling direction divided by that across; any positive number.
    pub fn at(&self, ratio: f64) -> KalkerCoefficients {
        let [min, max] = self.ratio_limits;
        let inside = ratio.clamp(min, max);
        let at_end = self
            .splines
            .map(|spline| libm::exp(spline.at(libm::log(inside))[0]));
        if ratio == inside {
            return at_end;
        }
        let (here, end) = (self.asymptotic(ratio), self.asymptotic(inside));
        let growth = here.zip(&end, |here, end| here / end);
        at_end.zip(&growth, |coefficient, growth| coefficient * growth)
    }

    /// Kalker's formulas for very slender ellipses.
    fn asymptotic(&self, ratio: f64) -> KalkerCoefficients {
        let nu = self.poisson_ratio;
        if ratio < 1.0 {
            let g = ratio;
            KalkerCoefficients {
                c11: PI * PI / (4.0 * (1.0 - nu)),
                c22: PI * PI / 4.0,
                c23: PI * g.sqrt() / (3.0 * (1.0 - nu)),
                c33: PI * PI / (16.0 * (1.0 - nu) * g),
            }
        } else {
            let g = 1.0 / ratio;
            let log = libm::log(16.0 / (g * g));
            let lateral = (1.0 - nu) * log + 2.0 * nu;
            let constant = 3.0 - libm::log(4.0);
            KalkerCoefficients {
                c11: 2.0 * PI / ((log - 2.0 * nu) * g) * (1.0 + constant / (log - 2.0 * nu)),
                c22: 2.0 * PI / (lateral * g) * (1.0 + (1.0 - nu) * constant / lateral),
                c23: 2.0 * PI / (3.0 * g * g.sqrt() * ((1.0 - nu) * log - 2.0 + 4.0 * nu)),
                c33: 1.0,
            }
        }
    }
}

/// Value at `nu` of the parabola through the values of `coefficient` in three rows with different Poisson's ratios.
fn parabola(nu: f64, three: &[Row], coefficient: fn(&Row) -> f64) -> f64 {
    let lagrange = |i: usize| {
        (0..3)
            .filter(|&j| j != i)
            .map(|j| {
                (nu - three[j].poisson_ratio) / (three[i].poisson_ratio - three[j].poisson_ratio)
            })
            .product::<f64>()
    };
    (0..3).map(|i| lagrange(i) * coefficient(&three[i])).sum()
}
