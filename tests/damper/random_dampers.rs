//! Random dampers from the full documented ranges under random motions: the promise that docs/numerics.md bases on
//! `dashpot verify` holds for arbitrary inputs.
//!
//! A seed determines a damper and its motions. `DASHPOT_RANDOM_DAMPERS=1000..2000` tries other seeds.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use dashpot::accuracy::STEPS_S;
use dashpot::documented_damper::documented_damper;
use dashpot::random_damper::Random;
use dashpot::searched_motion::{Form, SearchedMotion};
use dashpot_core::characteristic::{Characteristic, Corner};
use dashpot_testbench::step_errors::{SCALARS, StepErrors};

/// Seeds that are tried.
const NUMBERS: Range<u64> = 0..5;
/// Motions per damper, at each step size.
const MOTIONS: usize = 8;

/// Result for one damper.
#[derive(Default)]
struct Case {
    /// Errors above the promise, in words.
    complaints: Vec<String>,
    /// Largest ratio of a measured error to its promise.
    largest_ratio: f64,
    /// Corners that the reference's force passed through.
    reached: Vec<Corner>,
    forms: Vec<Form>,
}

/// Measures one damper. If the reference has no solution, the error is the reason, as `verify` reports it.
fn measure(number: u64) -> Result<Case, String> {
    let mut random = Random(number);
    let parameters = documented_damper(&mut random);
    let law = Characteristic::new(&parameters);
    let mut case = Case::default();
    for step_s in STEPS_S {
        let errors =
            StepErrors::new(&parameters, step_s, None).map_err(|error| error.to_string())?;
        let largest = errors.largest(1).map_err(|error| error.to_string())?;
        let promised = errors.promised(&largest);
        for _ in 0..MOTIONS {
            let searched = SearchedMotion::any(&mut random, errors.top_speed_m_per_s());
            let motion = searched.motion(step_s);
            let found = errors
                .on_motion(&motion)
                .map_err(|error| error.to_string())?;
            case.forms.push(searched.form);
            for ((found, promised), scalar) in found.iter().zip(promised).zip(SCALARS) {
                for (what, found, promised) in [
                    ("largest error", found.largest_n, promised.0),
                    ("NRMSE", found.nrmse, promised.1),
                ] {
                    let ratio = found / promised;
                    case.largest_ratio = case.largest_ratio.max(ratio);
                    if ratio.is_nan() || ratio > 1.0 {
                        case.complaints.push(format!(
                            "damper {number}, {step_s} s, {scalar}, {:?}: {what} {found:.2e} of {promised:.2e}",
                            searched.form
                        ));
                    }
                }
                let peak = |corner: f64| found.reference_peak_n[usize::from(corner < 0.0)];
                let corners = law.corners();
                case.reached.extend(
                    corners
                        .filter(|(_, at)| peak(*at) >= (1.0 - 1e-9) * at.abs())
                        .map(|(corner, _)| corner),
                );
            }
        }
    }
    Ok(case)
}

fn numbers() -> Range<u64> {
    let Ok(range) = std::env::var("DASHPOT_RANDOM_DAMPERS") else {
        return NUMBERS;
    };
    let ends = range
        .split_once("..")
        .and_then(|(from, to)| Some(from.trim().parse().ok()?..to.trim().parse().ok()?));
    ends.unwrap_or_else(|| panic!("DASHPOT_RANDOM_DAMPERS={range}: must be like 1000..2000"))
}

#[test]
fn the_promise_holds_for_random_dampers_and_motions() {
    let (numbers, next) = (numbers(), AtomicU64::new(0));
    let cases = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                loop {
                    let number = numbers.start + next.fetch_add(1, Ordering::Relaxed);
                    if number >= numbers.end {
                        break;
                    }
                    let case = measure(number);
                    cases.lock().expect("no case panicked before").push(case);
                }
            });
        }
    });
    let cases = cases.into_inner().expect("no case panicked");
    let (solved, unsolved): (Vec<_>, Vec<_>) = cases.into_iter().partition(Result::is_ok);
    let solved: Vec<Case> = solved.into_iter().flatten().collect();
    for reason in unsolved.iter().filter_map(|case| case.as_ref().err()) {
        println!("no promise: {reason}");
    }
    let ratios = solved.iter().map(|case| case.largest_ratio);
    println!(
        "largest ratio to the promise: {:.2}",
        ratios.fold(0.0, f64::max)
    );
    let complaints: Vec<&str> = solved
        .iter()
        .flat_map(|case| case.complaints.iter().map(String::as_str))
        .collect();
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    let corners = [
        Corner::PistonValveOpens,
        Corner::ReliefOpens,
        Corner::FootValveOpens,
        Corner::Vapour,
        Corner::Yields,
    ];
    let is_reached = |corner: &&Corner| solved.iter().any(|case| case.reached.contains(corner));
    let reached: Vec<&Corner> = corners.iter().filter(is_reached).collect();
    assert!(reached.len() >= 3, "the motions reached only {reached:?}");
    for form in [
        Form::Saw,
        Form::MoveAndStop,
        Form::Pieces,
        Form::Ride,
        Form::Harmonic,
        Form::Ramp,
    ] {
        let mut all = solved.iter().map(|case| &case.forms);
        assert!(
            all.any(|forms| forms.contains(&form)),
            "no {form:?} was tried"
        );
    }
    assert!(
        unsolved.len() <= solved.len(),
        "{} dampers have no promise, {} have one",
        unsolved.len(),
        solved.len()
    );
}
