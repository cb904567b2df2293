//! Calibration errors and warnings, with remedies expressed as arguments of `dashpot.calibrate`.

use dashpot_calibration::{Advice, CalibrationError, Finding, Remedy, TEMPERATURE, Warning};

/// Error message with its remedy.
pub fn message(error: &CalibrationError) -> String {
    let what = match error {
        CalibrationError::HeldAndVaried { .. }
        | CalibrationError::NotOfRig { .. }
        | CalibrationError::Held { .. } => {
            format!("hold {error}")
        }
        CalibrationError::Prior { .. } => format!("prior {error}"),
        other => other.to_string(),
    };
    let said: Vec<String> = error.advice().iter().map(said).collect();
    match error {
        CalibrationError::Implausible { advice, finding } => match advice.first() {
            Some(first) => {
                let causes: Vec<String> = first.iter().filter_map(Remedy::cause).collect();
                format!(
                    "{}: {}\n  {what}",
                    causes.join(", and "),
                    said.join(", or ")
                )
            }
            None => nothing_found(finding, &what, &said),
        },
        CalibrationError::Undetermined { .. } => {
            format!(
                "{what}\n{}, or add a test that separates them",
                said.join(", or ")
            )
        }
        CalibrationError::PriorOfHeld { .. } => {
            format!("{what}; allowed: a parameter that is varied")
        }
        _ if said.is_empty() => what,
        _ => format!("{what}; {}", said.join(", or ")),
    }
}

/// Message if no cause was found.
fn nothing_found(finding: &Finding, what: &str, said: &[String]) -> String {
    let tried = "no sign, unit, bound or preset that was tried explains the recordings";
    match finding {
        Finding::Missed { .. } => format!(
            "{what}\n  {tried}: this damper model lacks an effect that they contain; to accept the closest fit \
             anyway, {}",
            said.join(", or ")
        ),
        Finding::AtBound { .. } => format!(
            "{what}\n  {tried}; to accept the best value within these bounds anyway, {}",
            said.join(", or ")
        ),
        Finding::Driven { .. } => {
            format!(
                "{what}\n  the force or the displacement has the opposite sign: pass -force or -displacement"
            )
        }
        _ => format!("{what}\n  check the units of the displacement and of the time"),
    }
}

/// Remedy as a clause without a full stop.
fn said(advice: &Advice) -> String {
    let parts: Vec<String> = advice.iter().map(remedy).collect();
    parts.join(" and ")
}

fn remedy(remedy: &Remedy) -> String {
    let listed = |keys: &[String]| {
        keys.iter()
            .map(|key| format!("\"{key}\""))
            .collect::<Vec<_>>()
            .join(", ")
    };
    match remedy {
        Remedy::ReverseForce => "pass -force".into(),
        Remedy::ReverseDisplacement => "pass -displacement".into(),
        Remedy::ScaleDisplacement(factor) => format!("pass {factor:e} * displacement"),
        Remedy::ScaleForce(factor) => format!("pass {factor:e} * force"),
        Remedy::Bounds {
            key,
            bounds: [min, max],
        } => {
            format!("use vary={{\"{key}\": ({min:e}, {max:e})}}")
        }
        Remedy::VaryAlso(keys) => format!("vary {} too", listed(keys)),
        Remedy::OtherDamper { name, vary } if vary.is_empty() => {
            format!("start from dashpot.Damper(\"{name}\")")
        }
        Remedy::OtherDamper { name, vary } => {
            format!(
                "start from dashpot.Damper(\"{name}\") with vary=[{}]",
                listed(vary)
            )
        }
        Remedy::Leave(key) => format!("leave \"{key}\" out of vary"),
        Remedy::Know(key) => format!("use priors={{\"{key}\": (mean, deviation)}}"),
        Remedy::Forget(key) => format!("leave \"{key}\" out of priors"),
        Remedy::Hold(key) => format!("use hold={{\"{key}\": value}}"),
        Remedy::Release(key) => format!("leave \"{key}\" out of hold"),
        Remedy::Set { key, value } => {
            format!("start from damper.replace({{\"{key}\": {value:e}}})")
        }
        Remedy::Starts(starts) => format!("use starts={starts}"),
        Remedy::AllowMisfit(part) => format!("use max_misfit_percent={:.0}", 100.0 * part),
    }
}

/// Warning as a sentence.
pub fn warning(warning: &Warning) -> String {
    match warning {
        Warning::Missed {
            test,
            missed_n,
            noise_n,
        } => format!(
            "{test}: the residual is {missed_n:.0} N but the noise only {noise_n:.0} N: the model lacks an effect that \
             this test contains, and the intervals do not account for it"
        ),
        Warning::ZeroDiffers { test, mean_n } => format!(
            "{test}: the zero of the force differs by {:.0} N from that of the other tests: calibrate this \
             test separately",
            -mean_n
        ),
        Warning::AtBound {
            key,
            bound,
            is_physical: true,
        } => format!("{key} is {bound:e}, the physical limit"),
        Warning::AtBound { key, bound, .. } => format!(
            "{key} is at the bound {bound:e} that you gave, so the best value lies beyond it; set other bounds with \
             vary={{\"{key}\": (min, max)}}"
        ),
        Warning::Close { a, b, correlation } => {
            format!("the tests hardly separate {a} and {b}: correlation {correlation:.3}")
        }
        Warning::Assumed {
            key,
            assumed,
            value,
            uncertainty,
            shift_percent,
        } => {
            let argument = if assumed == TEMPERATURE {
                "temperature_uncertainty_k"
            } else {
                "density_uncertainty_kg_per_m3"
            };
            format!(
                "{key} shifts by {shift_percent:.2} % if {assumed} is {value} +- {uncertainty}; the noise of the tests \
                 shifts it less. The tests cannot separate the two. The interval includes this shift; set the \
                 uncertainty with {argument}"
            )
        }
        Warning::FitsBetter {
            assumed,
            value,
            better,
        } => format!(
            "the recordings fit better with {assumed} {better} than with {value}: check the thermometer; to use that \
             value, start from damper.replace({{\"{assumed}\": {better:e}}})"
        ),
    }
}
