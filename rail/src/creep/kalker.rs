//! Kalker's creepage coefficients at any ratio of the semi-axes and any Poisson number.

use std::f64::consts::PI;

use crate::math::spline::Spline;

/// The coefficients of one contact, dimensionless: longitudinal, lateral, lateral-spin, spin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// `C11`, longitudinal force over longitudinal creepage.
    pub c11: f64,
    /// `C22`, lateral force over lateral creepage.
    pub c22: f64,
    /// `C23 = -C32`, lateral force over spin and spin moment over lateral creepage.
    pub c23: f64,
    /// `C33`, spin moment over spin; known to about 2 %.
    pub c33: f64,
}

/// Kalker's table for one Poisson number.
///
/// Between rows: a spline of `ln C` over `ln(a/b)`, parabola through the table's three Poisson numbers.
/// Beyond the rows (0.1 to 10): the table's end times the growth of Kalker's asymptotic formulas
/// (Kalker 1967); `C33` of long rolling-direction ellipses stays at its end.
#[derive(Debug, Clone)]
pub struct KalkerTable {
    poisson: f64,
    splines: [Spline; 4],
}

const TABLE: &str = include_str!("../../../data/contact/kalker.csv");
const LEAST: f64 = 0.1;
const GREATEST: f64 = 10.0;

/// Rows of the table: ratio, Poisson number, the four coefficients.
pub fn rows() -> Vec<[f64; 6]> {
    TABLE
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| {
            let mut row = [f64::NAN; 6];
            for (cell, text) in row.iter_mut().zip(line.split(',')) {
                *cell = text.trim().parse().unwrap_or(f64::NAN);
            }
            row
        })
        .collect()
}

impl KalkerTable {
    /// The table for `poisson`, held within 0 to 0.5.
    pub fn new(poisson: f64) -> Self {
        let poisson = poisson.clamp(0.0, 0.5);
        let rows = rows();
        let ratios: Vec<f64> = rows.iter().step_by(3).map(|row| row[0].ln()).collect();
        let spline = |column: usize| {
            let values: Vec<f64> = rows
                .chunks_exact(3)
                .map(|three| parabola(poisson, three, column).ln())
                .collect();
            Spline::fit(&ratios, &values, 0.0)
        };
        Self {
            poisson,
            splines: [spline(2), spline(3), spline(4), spline(5)],
        }
    }

    /// Coefficients at the ratio `a/b` (rolling direction over across), any positive number.
    pub fn at(&self, ratio: f64) -> Coefficients {
        let inside = ratio.clamp(LEAST, GREATEST);
        let [c11, c22, c23, c33] = [0, 1, 2, 3].map(|k| self.splines[k].at(inside.ln())[0].exp());
        let growth = if ratio == inside {
            [1.0; 4]
        } else {
            let (here, end) = (self.asymptotic(ratio), self.asymptotic(inside));
            [0, 1, 2, 3].map(|k| here[k] / end[k])
        };
        Coefficients {
            c11: c11 * growth[0],
            c22: c22 * growth[1],
            c23: c23 * growth[2],
            c33: c33 * growth[3],
        }
    }

    /// Kalker's formulas for very slender ellipses.
    fn asymptotic(&self, ratio: f64) -> [f64; 4] {
        let nu = self.poisson;
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
            let across = (1.0 - nu) * log + 2.0 * nu;
            let rest = 3.0 - 4.0_f64.ln();
            [
                2.0 * PI / ((log - 2.0 * nu) * g) * (1.0 + rest / (log - 2.0 * nu)),
                2.0 * PI / (across * g) * (1.0 + (1.0 - nu) * rest / across),
                2.0 * PI / (3.0 * g * g.sqrt() * ((1.0 - nu) * log - 2.0 + 4.0 * nu)),
                1.0,
            ]
        }
    }
}

/// Parabola through the rows at the table's Poisson numbers 0, 1/4 and 1/2.
fn parabola(nu: f64, three: &[[f64; 6]], column: usize) -> f64 {
    let share = |i: usize| {
        (0..3)
            .filter(|&j| j != i)
            .map(|j| (nu - three[j][1]) / (three[i][1] - three[j][1]))
            .product::<f64>()
    };
    (0..3).map(|i| share(i) * three[i][column]).sum()
}
