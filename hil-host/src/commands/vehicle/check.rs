//! `dashpot vehicle --check`: compares the step with the reference solution.

use std::io::{self, Write};

use serde::Serialize;

use super::options::refused;
use crate::commands::arguments::Format;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print::print_report;
use crate::commands::progress;
use dashpot_files::case::Case;
use dashpot_report::verdict::Verdict;
use dashpot_study::verification::VerificationError;
use dashpot_study::verification::deviations::{BOUNDS, CHAOS, Deviations, Worst};
use dashpot_study::verification::seeds::{
    DISTANCE, Difference, OverSeeds, STANDARD_ERRORS, Seeds, over_seeds,
};
use dashpot_study::verification::{LOOSER_TOLERANCE, TOLERANCE, Trace, reference, stepped};
use dashpot_vehicle_run::Ending;

#[derive(Serialize)]
struct Report {
    case: String,
    step_s: f64,
    reference_tolerance: f64,
    deviations: Deviations<Worst>,
    bounds: Deviations<f64>,
    with_half_the_inner_step: Deviations<Worst>,
    /// Difference between two reference solutions with different tolerances, if a bound is exceeded.
    #[serde(skip_serializing_if = "Option::is_none")]
    parting: Option<Deviations<Worst>>,
    /// Indices over seeds of the irregularity, for a chaotic case.
    #[serde(skip_serializing_if = "Option::is_none")]
    over_seeds: Option<OverSeeds>,
    is_within_bounds: bool,
}

/// Runs the check.
///
/// # Errors
/// The case is invalid, has faults or events, or does not complete, or a deviation is out of bounds.
pub(super) fn run(case: &Case, format: Format) -> Outcome<()> {
    for (has, what, without) in [
        (
            !case.faults.is_empty(),
            "changes dampers during the run",
            "faults",
        ),
        (
            !case.events.is_empty(),
            "changes speed, friction or forces during the run",
            "events",
        ),
        (case.push_m != 0.0, "starts with a push", "push_m"),
    ] {
        if has {
            return Err(Failure::wrong_use(format!(
                "--check: {} {what}, which the reference does not support; give a case without {without}",
                case.name
            )));
        }
    }
    let failed = |error: VerificationError| match error {
        VerificationError::Run(error) => refused(case, &error),
        other => Failure::new(format!("{}: {other}", case.name)),
    };
    let bar = progress::bar(0, "step");
    let traced = |every: u64| -> Outcome<Trace> {
        let (trace, ending) = stepped(case, every).map_err(|error| refused(case, &error))?;
        match ending {
            Ending::Completed => Ok(trace),
            ending => Err(Failure::new(format!("--check: {}: {ending}", case.name))),
        }
    };
    let whole = traced(1)?;
    // These ticks take one step each, which is half as long as the steps inside a tick of the case.
    let half = traced((2.0 * case.step_s / whole.inner_step_s()).round() as u64)?;
    bar.set_message("reference solution: takes about ten seconds per simulated second");
    let solution = reference(case, &whole, TOLERANCE).map_err(failed)?;
    let deviations = whole.deviations(&solution);
    let is_within_bounds = deviations.is_within_bounds();
    let parting = if is_within_bounds {
        None
    } else {
        bar.set_message("second reference solution, to check whether the case is chaotic");
        let looser = reference(case, &whole, LOOSER_TOLERANCE).map_err(failed)?;
        Some(looser.deviations(&solution))
    };
    let is_chaotic = parting.as_ref().is_some_and(Deviations::show_chaos);
    let seeds = if is_chaotic {
        bar.set_message("step and reference with other seeds, to compare distributions");
        Some(over_seeds(case).map_err(failed)?)
    } else {
        None
    };
    bar.finish_and_clear();
    let half = half.deviations(&solution);
    let remedy = match &seeds {
        Some(Seeds::NoSeed) => {
            "; the case is chaotic, and its track has no seed to compare distributions over".into()
        }
        Some(Seeds::Ended { seed, ending }) => format!(
            "; the case is chaotic, and its distribution over seeds cannot be compared, for seed {seed} ends: {ending}"
        ),
        None if half.is_within_bounds() => format!(
            "; it is within them with a step of {:.0} us",
            5e5 * whole.inner_step_s()
        ),
        _ => String::new(),
    };
    let over_seeds = match seeds {
        Some(Seeds::Compared(found)) => Some(found),
        _ => None,
    };
    let agrees = over_seeds.as_ref().is_some_and(OverSeeds::agrees);
    let report = Report {
        case: case.name.clone(),
        step_s: case.step_s,
        reference_tolerance: TOLERANCE,
        with_half_the_inner_step: half,
        deviations,
        bounds: BOUNDS,
        parting,
        over_seeds,
        is_within_bounds,
    };
    print_report(format, &report, print)?;
    if is_within_bounds || agrees {
        Ok(())
    } else {
        Err(Failure::new(format!(
            "--check: {}: a deviation is out of bounds{remedy}",
            case.name
        )))
    }
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "{}: step of {:.0} us against the reference with tolerance {:e}, worst values",
        report.case,
        1e6 * report.step_s,
        report.reference_tolerance
    )?;
    let half = &report.with_half_the_inner_step;
    let worst = &report.deviations;
    let rows = [
        (
            "acceleration of bodies, %",
            1e2,
            &worst.acceleration,
            &half.acceleration,
            BOUNDS.acceleration,
        ),
        (
            "wheelset lateral, um rms",
            1e6,
            &worst.lateral_m,
            &half.lateral_m,
            BOUNDS.lateral_m,
        ),
        (
            "wheel load, kN rms",
            1e-3,
            &worst.load_n,
            &half.load_n,
            BOUNDS.load_n,
        ),
        (
            "mean or rms, %",
            1e2,
            &worst.index,
            &half.index,
            BOUNDS.index,
        ),
        (
            "maximum or minimum, %",
            1e2,
            &worst.extreme,
            &half.extreme,
            BOUNDS.extreme,
        ),
    ];
    writeln!(
        out,
        "\n{:<28} {:>9} {:>9} {:>9}  in",
        "", "deviation", "allowed", "half step*"
    )?;
    for (what, factor, worst, half, bound) in rows {
        writeln!(
            out,
            "{what:<28} {:>9} {:9.4} {:10.4}  {}",
            Verdict::of(worst.deviation <= bound).mark(format!("{:.4}", factor * worst.deviation)),
            factor * bound,
            factor * half.deviation,
            worst.quantity
        )?;
    }
    writeln!(out, "* with steps of half the length inside the ticks")?;
    if let Some(parting) = &report.parting {
        writeln!(
            out,
            "\nA second reference with tolerance {:e} differs by {:.4} %, {:.4} um, {:.4} kN, {:.4} %, {:.4} %: the \
             case is {}.",
            LOOSER_TOLERANCE,
            1e2 * parting.acceleration.deviation,
            1e6 * parting.lateral_m.deviation,
            1e-3 * parting.load_n.deviation,
            1e2 * parting.index.deviation,
            1e2 * parting.extreme.deviation,
            if parting.show_chaos() {
                format!(
                    "chaotic (an index differs by more than {:.0} %)",
                    1e2 * CHAOS
                )
            } else {
                "not chaotic".to_owned()
            }
        )?;
    }
    if let Some(found) = &report.over_seeds {
        writeln!(
            out,
            "so the distributions of all indices over {} seeds of the irregularity are compared instead:",
            found.seeds
        )?;
        let mut line = |what: &str, found: &Difference, bound: f64| {
            writeln!(
                out,
                "{what}: {:.2} at most (allowed {bound}), {}, means {:.4} with the step and {:.4} with the reference",
                found.greatest, found.index, found.means.step, found.means.reference
            )
        };
        line(
            "difference of the means in standard errors",
            &found.mean,
            STANDARD_ERRORS,
        )?;
        line(
            "distance of the cumulative distributions",
            &found.distribution,
            DISTANCE,
        )?;
    }
    Ok(())
}
