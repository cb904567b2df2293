//! Random dampers of every term under random motions: the accuracy that docs/numerics.md promises, for inputs
//! nobody chose.
//!
//! A number makes a damper and its motion. `DASHPOT_RANDOM_DAMPERS=1000..2000` tries others.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use dashpot::accuracy::{STEPS_S, stepped};
use dashpot::random_damper::{Random, damper};
use dashpot_core::Damper;
use dashpot_core::characteristic::{Characteristic, Corner};
use dashpot_hil::study::Scalar;
use dashpot_hil::study::accuracy_limits::{
    AccuracyLimits, LEAST_RMS_FORCE_RATIO, relaxation_time_s,
};
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::{largest_magnitude, nrmse_above};

/// Dampers tried.
const NUMBERS: Range<u64> = 0..48;

/// Least share of them that the promise covers.
const COVERED: f64 = 0.8;

/// What an NRMSE is of, in the order of [`Case::nrmse`].
const COLUMNS: [&str; 4] = ["1 kHz f64", "1 kHz f32", "10 kHz f64", "10 kHz f32"];

const DURATION_S: f64 = 2.0;

/// A displacement (m) over time (s): random to 20 Hz, velocity ramps out and back with sudden stops, or
/// harmonic.
fn motion(random: &mut Random) -> Box<dyn Fn(f64) -> f64> {
    match (3.0 * random.unit()) as u32 {
        0 => {
            let velocity = random.decades(0.005, 0.4);
            let lines: Vec<[f64; 3]> = (0..40)
                .map(|_| {
                    let angular = TAU * random.decades(0.2, 20.0);
                    [random.unit(), angular, TAU * random.unit()]
                })
                .collect();
            let sum: f64 = lines.iter().map(|[share, ..]| share * share).sum();
            let scale = velocity / (0.5 * sum).sqrt();
            Box::new(move |t| {
                let line = |[share, angular, phase]: &[f64; 3]| {
                    share / angular * ((angular * t + phase).sin() - phase.sin())
                };
                scale * lines.iter().map(line).sum::<f64>()
            })
        }
        1 => {
            let velocity = random.decades(0.02, 0.6);
            Box::new(move |t| {
                let quarter = DURATION_S / 4.0;
                let ramp = |t: f64| 0.5 * velocity * t.clamp(0.0, quarter).powi(2) / quarter;
                ramp(t) + ramp(t - quarter) - ramp(t - 2.0 * quarter) - ramp(t - 3.0 * quarter)
            })
        }
        _ => {
            let amplitude = random.decades(1e-3, 3e-2);
            let angular = TAU * random.decades(0.3, 5.0);
            Box::new(move |t| amplitude * (angular * t).sin())
        }
    }
}

/// What a damper did at each step of [`STEPS_S`].
struct Case {
    number: u64,
    /// Relaxation time (s), of the last step.
    relaxation_s: f64,
    /// NRMSE for each step size in `f64` and in `f32`.
    nrmse: [[f64; 2]; 2],
    /// Corners that the force went through.
    reached: Vec<Corner>,
}

fn measure(number: u64) -> Result<Case, String> {
    let mut random = Random(number);
    let parameters = damper(&mut random);
    let motion = motion(&mut random);
    let mut case = Case {
        number,
        relaxation_s: 0.0,
        nrmse: [[0.0; 2]; 2],
        reached: Vec::new(),
    };
    let law = Characteristic::new(&parameters.check().map_err(|error| error.to_string())?);
    for (step_s, found) in STEPS_S.into_iter().zip(&mut case.nrmse) {
        let ticks = (DURATION_S / step_s).round() as usize;
        let times: Vec<f64> = (0..=ticks).map(|tick| tick as f64 * step_s).collect();
        let displacements: Vec<f64> = times
            .iter()
            .map(|time| f64::from(motion(*time) as f32))
            .collect();
        let reference = Reference::new(&parameters)
            .and_then(|mut reference| reference.forces(&times, &displacements))
            .map_err(|failure| format!("{failure}"))?;
        if largest_magnitude(reference.iter().copied()) == 0.0 {
            return Err("the motion stays within the clearance".into());
        }
        let beyond = |corner: f64| reference.iter().any(|force| force / corner >= 1.0 - 1e-9);
        let corners = law.corners().into_iter();
        case.reached.extend(
            corners
                .filter(|(_, at)| beyond(*at))
                .map(|(corner, _)| corner),
        );
        case.relaxation_s = relaxation_time_s(&parameters, step_s, &displacements, &reference);
        let stepped = [
            stepped::<f64>(&parameters, step_s, &displacements),
            stepped::<f32>(&parameters, step_s, &displacements),
        ];
        let built: Damper<f64> = parameters
            .build(step_s)
            .map_err(|error| error.to_string())?;
        let least_rms_n = LEAST_RMS_FORCE_RATIO * built.force_limit_n();
        *found = stepped.map(|forces| nrmse_above(&forces, &reference, least_rms_n));
    }
    Ok(case)
}

/// NRMSE promised for each step of [`STEPS_S`] in `f64` and in `f32`, where there is a promise.
fn promised(relaxation_s: f64) -> Option<[[f64; 2]; 2]> {
    let promise = AccuracyLimits::of(relaxation_s)?;
    let nrmse = |step_s, scalar| {
        promise
            .nrmse(step_s, scalar)
            .expect("a step of 1 ms at most")
    };
    Some(STEPS_S.map(|step_s| [Scalar::F64, Scalar::F32].map(|scalar| nrmse(step_s, scalar))))
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
    let mut complaints = Vec::new();
    let mut found: [Vec<f64>; 4] = Default::default();
    for case in cases.iter().flatten() {
        let Some(promised) = promised(case.relaxation_s) else {
            continue;
        };
        let columns = case
            .nrmse
            .as_flattened()
            .iter()
            .zip(promised.as_flattened());
        for ((nrmse, promised), (found, column)) in columns.zip(found.iter_mut().zip(COLUMNS)) {
            found.push(*nrmse);
            if nrmse > promised {
                complaints.push(format!(
                    "damper {}, relaxation time {:.1e} s, {column}: {nrmse:.1e} of {promised:.0e}",
                    case.number, case.relaxation_s
                ));
            }
        }
    }
    for corner in [
        Corner::PistonValveOpens,
        Corner::ReliefOpens,
        Corner::FootValveOpens,
        Corner::Vapour,
        Corner::Yields,
    ] {
        let covered = |case: &&Case| promised(case.relaxation_s).is_some();
        let mut reached = cases
            .iter()
            .flatten()
            .filter(covered)
            .map(|case| &case.reached);
        assert!(
            reached.any(|all| all.contains(&corner)),
            "no motion reached {corner:?}"
        );
    }
    for (found, column) in found.iter_mut().zip(COLUMNS) {
        found.sort_by(f64::total_cmp);
        let (median, largest) = (found[found.len() / 2], found[found.len() - 1]);
        println!(
            "{column}: median {median:.1e}, largest {largest:.1e} of {}",
            found.len()
        );
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    let (covered, tried) = (found[0].len(), numbers.end - numbers.start);
    assert!(
        covered as f64 >= COVERED * tried as f64,
        "the promise covers {covered} of {tried} dampers"
    );
}
