//! The table of tolerances: allowed NRMSE of the fixed step, compared with the reference solver.
//!
//! Its rows are in `tolerance.csv`. `DASHPOT_BLESS=1` rewrites them at [`SLACK`] times the measured error; no row,
//! blessed or not, may exceed [`required`].

use dashpot_files::Scalar;
use dashpot_testbench::accuracy_limits::ACCURACY_LIMITS;

use crate::accuracy::{DAMPERS, STEPS_S};

/// A row fails as too loose if the measured error is below this fraction of it.
pub const MIN_USE: f64 = 0.5;

/// Ratio of a blessed row to the measured error.
pub const SLACK: f64 = 1.4;

/// File of the rows.
pub const FILE: &str = "tests/support/tolerance.csv";

/// One damper under one excitation.
#[derive(Clone, Debug)]
pub struct Tolerance {
    /// Name in [`DAMPERS`].
    pub damper: String,
    /// Name of the excitation.
    pub excitation: String,
    /// For each step size of [`STEPS_S`], the allowed NRMSE in `f64` and in `f32`.
    pub nrmse: [[f64; 2]; 2],
}

/// Promised NRMSE at step size `step` of [`STEPS_S`], in `f64` and in `f32`.
pub fn required(damper: &str, step: usize) -> [f64; 2] {
    assert!(DAMPERS.iter().any(|(name, _, _)| *name == damper));
    let [usual, stiff] = &ACCURACY_LIMITS;
    let promise = if damper == "paper, Ke 40 MN/m" {
        stiff
    } else {
        usual
    };
    [Scalar::F64, Scalar::F32].map(|scalar| {
        let promised = promise.nrmse(STEPS_S[step], scalar);
        promised.expect("a promise for every step of the table")
    })
}

/// The rows.
pub fn rows() -> Vec<Tolerance> {
    let text = crate::document::read(FILE);
    text.lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.split(';').map(str::trim).collect();
            let number = |column: usize| cells[column].parse().expect("a number");
            Tolerance {
                damper: cells[0].to_owned(),
                excitation: cells[1].to_owned(),
                nrmse: [[number(2), number(3)], [number(4), number(5)]],
            }
        })
        .collect()
}

/// Text of the file with the rows.
pub fn to_text(rows: &[Tolerance]) -> String {
    let mut text =
        String::from("damper; excitation; 1 kHz f64; 1 kHz f32; 10 kHz f64; 10 kHz f32\n");
    for row in rows {
        let [[slow, slow_single], [fast, fast_single]] = row.nrmse;
        text += &format!(
            "{}; {}; {slow:.1e}; {slow_single:.1e}; {fast:.1e}; {fast_single:.1e}\n",
            row.damper, row.excitation
        );
    }
    text
}
