//! Kalker's creepage coefficients at any ratio of the semi-axes and any Poisson's ratio.

mod table;

use std::f64::consts::PI;

pub use table::KalkerError;
use table::{COLUMNS, Row, rows};

use crate::math::spline::Spline;

/// Kalker's coefficients of one contact, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KalkerCoefficients {
    /// `C11`: longitudinal force over longitudinal creepage.
    pub c11: f64,
    /// `C22`: lateral force over lateral creepage.
    pub c22: f64,
    /// `C23 = -C32`: lateral force over spin, and spin moment over lateral creepage.
    pub c23: f64,
    /// `C33`: spin moment over spin; known to about 2 %.
    pub c33: f64,
}

/// Kalker's table for one Poisson's ratio.
///
/// Between the rows: a spline of `ln C` over `ln(a/b)`, and a parabola through the table's three Poisson's ratios.
/// Beyond the rows (0.1 to 10): the end of the table times the growth of Kalker's asymptotic formulas
/// (Kalker 1967). `C33` of contacts that are long in the rolling direction remains at the end of the table.
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
    /// Smallest and greatest ratio of the rows.
    ratio_limits: [f64; 2],
    splines: [Spline; 4],
}

/// Kalker's table of 1967.
const TABLE: &str = include_str!("../../../data/kalker.csv");

impl KalkerTable {
    /// Kalker's own table for `poisson_ratio`.
    ///
    /// # Errors
    /// Poisson's ratio is not within 0 to 0.5.
    pub fn new(poisson_ratio: f64) -> Result<Self, KalkerError> {
        Self::from_csv(TABLE, poisson_ratio)
    }

    /// Another table for `poisson_ratio`: columns `a_over_b,nu,C11,C22,C23,C33`, each ratio of the semi-axes with the
    /// same three values of `nu`; lines that begin with `#` are comments.
    ///
    /// # Errors
    /// A cell that is not a positive number (`nu`: 0 to 0.5), with its line and column; rows that are incomplete or
    /// not in order; Poisson's ratio not within 0 to 0.5.
    pub fn from_csv(text: &str, poisson_ratio: f64) -> Result<Self, KalkerError> {
        let rows = rows(text)?;
        if !(0.0..=0.5).contains(&poisson_ratio) {
            return Err(KalkerError::PoissonRatio { poisson_ratio });
        }
        let ratios: Vec<f64> = rows.iter().step_by(3).map(|row| row[0].ln()).collect();
        let spline = |column: usize| {
            let logarithm = |three: &[Row]| {
                let value = parabola(poisson_ratio, three, column);
                if value > 0.0 {
                    Ok(value.ln())
                } else {
                    Err(KalkerError::NotPositive {
                        column: COLUMNS[column],
                        ratio: three[0][0],
                        poisson_ratio,
                    })
                }
            };
            let values: Result<Vec<f64>, _> = rows.chunks_exact(3).map(logarithm).collect();
            Ok(Spline::fit(&ratios, &values?, 0.0))
        };
        Ok(Self {
            poisson_ratio,
            ratio_limits: [rows[0][0], rows[rows.len() - 1][0]],
            splines: [spline(2)?, spline(3)?, spline(4)?, spline(5)?],
        })
    }

    /// Coefficients at `ratio`, the semi-axis in the rolling direction over that across; any positive number.
    pub fn at(&self, ratio: f64) -> KalkerCoefficients {
        let [least, greatest] = self.ratio_limits;
        let inside = ratio.clamp(least, greatest);
        let [c11, c22, c23, c33] = [0, 1, 2, 3].map(|k| self.splines[k].at(inside.ln())[0].exp());
        let growth = if ratio == inside {
            [1.0; 4]
        } else {
            let (here, end) = (self.asymptotic(ratio), self.asymptotic(inside));
            [0, 1, 2, 3].map(|k| here[k] / end[k])
        };
        KalkerCoefficients {
            c11: c11 * growth[0],
            c22: c22 * growth[1],
            c23: c23 * growth[2],
            c33: c33 * growth[3],
        }
    }

    /// Kalker's formulas for very slender ellipses.
    fn asymptotic(&self, ratio: f64) -> [f64; 4] {
        let nu = self.poisson_ratio;
        if ratio < 1.0 {
            let g = ratio;
            [
                PI * PI / (4.0 * (1.0 - nu)),
                PI * PI / 4.0,
                PI * g.sqrt() / (3.0 * (1.0 - nu)),
                PI * PI / (16.0 * (1.0 - nu) * g),
            ]
        } else {
            let g = 1.0 / ratio;
            let log = (16.0 / (g * g)).ln();
            let lateral = (1.0 - nu) * log + 2.0 * nu;
            let constant = 3.0 - 4.0_f64.ln();
            [
                2.0 * PI / ((log - 2.0 * nu) * g) * (1.0 + constant / (log - 2.0 * nu)),
                2.0 * PI / (lateral * g) * (1.0 + (1.0 - nu) * constant / lateral),
                2.0 * PI / (3.0 * g * g.sqrt() * ((1.0 - nu) * log - 2.0 + 4.0 * nu)),
                1.0,
            ]
        }
    }
}

/// Value at `nu` of the parabola through a column of three rows with different Poisson's ratios.
fn parabola(nu: f64, three: &[Row], column: usize) -> f64 {
    let lagrange = |i: usize| {
        (0..3)
            .filter(|&j| j != i)
            .map(|j| (nu - three[j][1]) / (three[i][1] - three[j][1]))
            .product::<f64>()
    };
    (0..3).map(|i| lagrange(i) * three[i][column]).sum()
}
