//! Accuracy of the fixed step, compared with the reference solver. The errors of every case must be within its row of
//! the tolerance table, and no row may be looser than needed. Also writes and checks the table in docs/numerics.md.

use std::collections::HashMap;
use std::fmt::Write;

use dashpot::accuracy::{DAMPERS, Errors, STEPS_S, measure_all};
use dashpot::tolerance::{FILE, MIN_USE, SLACK, Tolerance, required, rows, to_text};
use dashpot::{damper, document};
use dashpot_core::characteristic::{Characteristic, Corner};
use dashpot_testbench::accuracy_limits::{ACCURACY_LIMITS, AccuracyLimits};
use dashpot_testbench::excitation::Excitation;

type Found = HashMap<(&'static str, &'static str), Errors>;

const SCALARS: [&str; 2] = ["f64", "f32"];

/// Damper and excitation of every row, in order.
fn cases() -> impl Iterator<Item = (&'static str, &'static str)> {
    DAMPERS.into_iter().flat_map(|(damper, _, _)| {
        Excitation::ALL
            .into_iter()
            .map(move |excitation| (damper, excitation.name()))
    })
}

fn bless(found: &Found) {
    let rows: Vec<Tolerance> = cases()
        .map(|case| Tolerance {
            damper: case.0.to_owned(),
            excitation: case.1.to_owned(),
            nrmse: found[&case]
                .nrmse
                .map(|scalars| scalars.map(|nrmse| SLACK * nrmse)),
        })
        .collect();
    document::compare(FILE, &to_text(&rows));
}

/// Discrepancies between the measured errors and the table.
fn complaints(found: &Found) -> Vec<String> {
    let rows = rows();
    let mut complaints = Vec::new();
    for case in cases() {
        let row = rows
            .iter()
            .find(|row| (row.damper.as_str(), row.excitation.as_str()) == case);
        let Some(row) = row else {
            complaints.push(format!("{case:?} has no row in {FILE}"));
            continue;
        };
        for (step, step_s) in STEPS_S.into_iter().enumerate() {
            for (scalar, name) in SCALARS.into_iter().enumerate() {
                let measured = found[&case].nrmse[step][scalar];
                let allowed = row.nrmse[step][scalar];
                let required = required(case.0, step)[scalar];
                let label = format!("{case:?}, {step_s} s, {name}: {measured:.2e}");
                if measured > required {
                    complaints.push(format!("{label} is above the required {required:.0e}"));
                }
                if measured > allowed {
                    complaints.push(format!("{label} is above its row {allowed:.1e}"));
                }
                if measured < MIN_USE * allowed {
                    complaints.push(format!(
                        "{label}: the row {allowed:.1e} is looser than needed"
                    ));
                }
            }
        }
    }
    for (damper, ..) in DAMPERS {
        for (corner, force) in corners(damper) {
            let mut runs = cases().filter(|case| case.0 == damper);
            if !runs.any(|case| found[&case].reached(force)) {
                complaints.push(format!(
                    "{damper}: no excitation reaches {corner}, {force:.0} N"
                ));
            }
        }
    }
    if rows.len() != cases().count() {
        complaints.push(format!("{FILE} has {} rows, not one a case", rows.len()));
    }
    complaints
}

/// Corners of a damper of [`DAMPERS`]: letters for kind and direction, and the force (N).
fn corners(name: &str) -> Vec<(String, f64)> {
    let (_, preset, overrides) = DAMPERS
        .into_iter()
        .find(|(row, ..)| *row == name)
        .expect("a row of the table");
    let law = Characteristic::new(&damper(preset, overrides).check().expect("a valid damper"));
    law.corners()
        .map(|(corner, force)| {
            let what = match corner {
                Corner::PistonValveOpens => "P",
                Corner::ReliefOpens => "R",
                Corner::FootValveOpens => "F",
                Corner::Vapour => "V",
                Corner::Yields => "Y",
                other => panic!("{other:?} has no letter"),
            };
            let side = if force < 0.0 { "c" } else { "e" };
            (format!("{what}{side}"), force)
        })
        .collect()
}

/// The corners that a run reached, followed by all corners if it did not reach all, such as `Pe Re of Pe Re Ye`.
fn reached(found: &Errors, corners: &[(String, f64)]) -> String {
    let names = |wanted: &dyn Fn(f64) -> bool| -> Vec<&str> {
        let wanted = corners.iter().filter(|(_, force)| wanted(*force));
        wanted.map(|(name, _)| name.as_str()).collect()
    };
    let (reached, all) = (names(&|force| found.reached(force)), names(&|_| true));
    match reached.len() {
        0 => format!("none of {}", all.join(" ")),
        some if some == all.len() => all.join(" "),
        _ => format!("{} of {}", reached.join(" "), all.join(" ")),
    }
}

/// The measured table of docs/numerics.md.
fn document_part(found: &Found) -> String {
    let mut text = String::from(
        "| damper | excitation | 1 kHz f64 | 1 kHz f32 | 10 kHz f64 | 10 kHz f32 | corners \
         |\n|---|---|---|---|---|---|---|\n",
    );
    for case in cases() {
        let [[slow, slow_single], [fast, fast_single]] = found[&case].nrmse;
        writeln!(
            text,
            "| {} | {} | {slow:.1e} | {slow_single:.1e} | {fast:.1e} | {fast_single:.1e} | {} |",
            case.0,
            case.1,
            reached(&found[&case], &corners(case.0)),
        )
        .expect("text grows");
    }
    text
}

/// The promised limits of docs/numerics.md.
fn promise_part() -> String {
    let [long, short] = ACCURACY_LIMITS;
    assert_eq!(
        (long.nrmse_10_khz_f64, long.nrmse_10_khz_f32),
        (short.nrmse_10_khz_f64, short.nrmse_10_khz_f32)
    );
    let ms = |promise: AccuracyLimits| promise.min_relaxation_time_s * 1e3;
    format!(
        "| relaxation time | 1 kHz | 10 kHz |\n|---|---|---|\n\
         | {} ms or more | {:e} | {:e} in `f64`, {:e} in `f32` |\n| {} to {} ms | {:e} | the same |\n",
        ms(long),
        long.nrmse_1_khz,
        long.nrmse_10_khz_f64,
        long.nrmse_10_khz_f32,
        ms(short),
        ms(long),
        short.nrmse_1_khz
    )
}

#[test]
fn the_document_has_the_promised_limits() {
    document::compare_part("docs/numerics.md", "promise", &promise_part());
}

#[test]
fn every_case_meets_its_row_and_no_row_is_looser_than_needed() {
    let found = measure_all();
    if document::blessing() {
        bless(&found);
    }
    let complaints = complaints(&found);
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    document::compare_part("docs/numerics.md", "measured", &document_part(&found));
}
