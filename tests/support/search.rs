//! A search for the worst case of the accuracy promised in docs/numerics.md: random dampers within the documented
//! ranges, and for each the motion with the largest error relative to its promise, found by hill climbing from random
//! motions.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_core::CheckedParameters;
use dashpot_reference::probing::{LargestErrors, Motion};
use dashpot_testbench::TestbenchError;
use dashpot_testbench::step_errors::StepErrors;

use crate::accuracy::STEPS_S;
use crate::documented_damper::{changed_damper, documented_damper};
use crate::random_damper::Random;
use crate::searched_motion::SearchedMotion;

/// Number of start motions for one damper, and number of changes to each.
const STARTS: usize = 4;
const CHANGES: usize = 12;
/// Number of changed dampers derived from one.
const CHANGED_DAMPERS: usize = 1;

/// Maximum number of cases that a search keeps.
const KEPT: usize = 16;

/// The promised quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promise {
    /// The largest error at a tick.
    LargestError,
    /// The NRMSE of a motion.
    Nrmse,
}

/// A motion of a damper with its errors and promises.
#[derive(Clone, Debug)]
pub struct Case {
    /// The damper.
    pub damper: CheckedParameters,
    /// The motion at its ticks.
    pub motion: Motion,
    /// Form of the motion in words.
    pub form: String,
    /// The step (s).
    pub step_s: f64,
    /// `f64` or `f32`.
    pub scalar: &'static str,
    /// The promised quantity.
    pub promise: Promise,
    /// The measured value, a force (N) or an NRMSE (1).
    pub found: f64,
    /// The promised value, a force (N) or an NRMSE (1).
    pub promised: f64,
}

impl Case {
    /// Measured over promised value; above 1, the promise is broken.
    pub fn ratio(&self) -> f64 {
        self.found / self.promised
    }

    /// One-line summary.
    pub fn line(&self) -> String {
        format!(
            "{:.2} of the promise: {:?} {:.3e} of {:.3e}, {} at {} s, {} at {:.4} m/s",
            self.ratio(),
            self.promise,
            self.found,
            self.promised,
            self.scalar,
            self.step_s,
            self.form,
            self.motion.speed_m_per_s
        )
    }
}

/// Result of a search.
#[derive(Debug, Default)]
pub struct Found {
    /// Motions tried.
    pub evaluations: usize,
    /// Dampers probed.
    pub dampers: usize,
    /// Dampers without a reference solution, with the reason that `verify` reports.
    pub unsolved: Vec<String>,
    /// The worst cases, worst first, at most one per damper, scalar and promise.
    pub cases: Vec<Case>,
}

/// A damper at one step size with its promises.
struct Promised<'a> {
    errors: StepErrors<'a>,
    step_s: f64,
    largest: [LargestErrors; 2],
}

impl<'a> Promised<'a> {
    fn new(damper: &'a CheckedParameters, step_s: f64) -> Result<Self, TestbenchError> {
        let errors = StepErrors::new(damper, step_s, None)?;
        let largest = errors.largest(1)?;
        Ok(Self {
            errors,
            step_s,
            largest,
        })
    }

    /// Measured and promised values of a motion: for each scalar the largest error and the NRMSE.
    fn judge(&self, motion: &Motion) -> Result<[(f64, f64); 4], TestbenchError> {
        let [double, single] = self.errors.on_motion(motion)?;
        let [of_double, of_single] = self.errors.promised(&self.largest);
        Ok([
            (double.largest_n, of_double.0),
            (double.nrmse, of_double.1),
            (single.largest_n, of_single.0),
            (single.nrmse, of_single.1),
        ])
    }
}

/// Scalar and promise in the order of [`Promised::judge`].
const JUDGED: [(&str, Promise); 4] = [
    ("f64", Promise::LargestError),
    ("f64", Promise::Nrmse),
    ("f32", Promise::LargestError),
    ("f32", Promise::Nrmse),
];

/// The worst motion of one damper at one step size for each promise, found by hill climbing from random motions.
fn climb(
    damper: &CheckedParameters,
    step_s: f64,
    random: &mut Random,
    budget: &mut usize,
) -> Result<Vec<Case>, TestbenchError> {
    let promised = Promised::new(damper, step_s)?;
    let top = promised.errors.top_speed_m_per_s();
    let mut worst: [Option<Case>; 4] = Default::default();
    for start in 0..STARTS {
        let judged = start % JUDGED.len();
        let mut best = SearchedMotion::any(random, top);
        let mut best_ratio = 0.0;
        for change in 0..=CHANGES {
            if *budget == 0 {
                break;
            }
            *budget -= 1;
            let searched = if change < 5 {
                SearchedMotion::any(random, top)
            } else {
                best.changed(random, top)
            };
            let motion = searched.motion(promised.step_s);
            let found = promised.judge(&motion)?;
            for (((found, promised), (scalar, promise)), worst) in
                found.into_iter().zip(JUDGED).zip(&mut worst)
            {
                let ratio = found / promised;
                let is_worse = |worst: &Case| ratio.is_nan() || ratio > worst.ratio();
                if worst.as_ref().is_none_or(is_worse) {
                    *worst = Some(Case {
                        damper: damper.clone(),
                        motion: motion.clone(),
                        form: format!("{:?}", searched.form),
                        step_s,
                        scalar,
                        promise,
                        found,
                        promised,
                    });
                }
            }
            let ratio = found[judged].0 / found[judged].1;
            if ratio > best_ratio {
                (best, best_ratio) = (searched, ratio);
            }
        }
    }
    Ok(worst.into_iter().flatten().collect())
}

/// Searches with this number of motions in total. The search has several independent lines of dampers: each starts with
/// a random damper, and the next dampers of the line are changed versions of the worst one so far. The same seed and
/// number always produce the same search, for any number of threads.
pub fn search(evaluations: usize, seed: u64, mut on_worse: impl FnMut(&Case) + Send) -> Found {
    // Lines of dampers share the evaluations evenly, so that each line is independent of the others.
    let per_damper = STARTS * (CHANGES + 1);
    let per_line = per_damper * (1 + CHANGED_DAMPERS);
    let lines = evaluations.div_ceil(per_line);
    let (next, found) = (AtomicUsize::new(0), Mutex::new((Found::default(), 0.0)));
    let on_worse = Mutex::new(&mut on_worse);
    let work = || {
        loop {
            let line = next.fetch_add(1, Ordering::Relaxed);
            if line >= lines {
                break;
            }
            let budget = per_line.min(evaluations - line * per_line);
            let mut random = Random(seed.wrapping_mul(1_000_003).wrapping_add(line as u64));
            let of_line = follow(&mut random, budget, STEPS_S[line % STEPS_S.len()]);
            let Ok(mut found) = found.lock() else { return };
            let (found, worst) = &mut *found;
            for case in of_line.cases {
                if case.ratio() > *worst || case.ratio().is_nan() {
                    *worst = case.ratio();
                    if let Ok(mut report) = on_worse.lock() {
                        report(&case);
                    }
                }
                found.cases.push(case);
            }
            found.cases.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
            found.cases.truncate(KEPT);
            found.dampers += of_line.dampers;
            found.evaluations += of_line.evaluations;
            found.unsolved.extend(of_line.unsolved);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(work);
        }
    });
    let (found, _) = found.into_inner().unwrap_or_default();
    found
}

/// Searches one line of dampers at one step size.
fn follow(random: &mut Random, evaluations: usize, step_s: f64) -> Found {
    let mut found = Found::default();
    let mut budget = evaluations;
    let mut worst: Option<(f64, CheckedParameters)> = None;
    while budget > 0 {
        let damper = match &worst {
            Some((_, damper)) => changed_damper(damper, random),
            None => documented_damper(random),
        };
        let most = budget.min(STARTS * (CHANGES + 1));
        let mut left = most;
        match climb(&damper, step_s, random, &mut left) {
            Ok(cases) => {
                let ratio = cases.iter().map(Case::ratio).fold(0.0, f64::max);
                if worst.as_ref().is_none_or(|(worst, _)| ratio > *worst) {
                    worst = Some((ratio, damper));
                }
                found.cases.extend(cases);
            }
            Err(error) => found.unsolved.push(error.to_string()),
        }
        // A damper without a reference solution costs one evaluation.
        let used = (most - left).max(1);
        budget -= used;
        found.evaluations += used;
        found.dampers += 1;
    }
    found
}
