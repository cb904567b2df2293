//! A damper or a bank of them as an FMU, sources and all.

use std::fmt::Write;

use dashpot_core::Damper;
use dashpot_core::parameters::MAX_CLEARANCE_M;
use maud::{Markup, html};

use super::sources::{Source, fixed, of_interface, with_own_names};
use super::variable::{Kind, Variable};
use super::{Fmu, Interface, check, token_of};
use crate::standalone::{constants_of, header_of_step, source_of_step};
use crate::{ExportError, Word};
use dashpot_files::nearest_nanosecond;

/// What every bank has.
const SOURCES: [(&str, &str); 2] = [
    ("dampers.h", include_str!("sources/dampers.h")),
    ("model.c", include_str!("sources/model.c")),
];

/// Where the dampers come from.
const BUILT_IN: &str = include_str!("sources/built_in.c");
const LOADED: &str = include_str!("sources/loaded.c");

/// A damper and where it came from.
pub struct Named<T> {
    /// Preset or file.
    pub name: String,
    /// As built.
    pub damper: Damper<T>,
    /// Clearance 2a as its file has it (m).
    pub clearance_m: f64,
}

impl Fmu {
    /// Of dampers, all built for the step `step_s` (s); its functions begin with `identifier`, of ASCII letters, digits and `_`.
    /// `is_loaded`: the constants are images in the folder of resources, which may be replaced.
    ///
    /// # Errors
    /// The identifier in capitals is no name of a constant of C.
    pub fn of_dampers<T: Word>(
        interface: Interface,
        identifier: &str,
        dampers: &[Named<T>],
        step_s: f64,
        is_loaded: bool,
    ) -> Result<Self, ExportError> {
        check(identifier)?;
        let images: Vec<Vec<u8>> = dampers
            .iter()
            .map(|named| T::image(&named.damper))
            .collect();
        let parts = images.iter().map(Vec::as_slice);
        let token = token_of(
            identifier,
            interface,
            [&[u8::from(is_loaded)][..]].into_iter().chain(parts),
        );
        let mut sources: Vec<Source> = fixed(&SOURCES);
        sources.extend(of_interface(interface));
        sources.push(("damper.h", header_of_step::<T>("DAMPER")));
        sources.push(("dampers.c", source(dampers, step_s, &token, is_loaded)));
        sources.sort_unstable_by_key(|(name, _)| *name);
        for (_, text) in &mut sources {
            *text = with_own_names(identifier, text);
        }
        let image = |(number, image)| (format!("image_{number}.bin"), image);
        let resources = match is_loaded {
            true => (1..).zip(images).map(image).collect(),
            false => Vec::new(),
        };
        let names: Vec<&str> = dampers.iter().map(|named| &*named.name).collect();
        let what = match names.len() {
            1 => "Damper",
            _ => "Dampers",
        };
        Ok(Self {
            interface,
            identifier: identifier.to_owned(),
            token,
            title: format!(
                "{what} {}, internal step {step_s} s, {}",
                names.join(", "),
                T::NAME
            ),
            step_s,
            // Steps of this size end there.
            stop_s: nearest_nanosecond((1.0 / step_s).round() * step_s),
            variables: all_variables(dampers),
            has_input_derivatives: true,
            may_end: false,
            about: about::<T>(step_s, is_loaded),
            resources,
            sources,
            library: None,
        })
    }
}

/// Those of all dampers, by their numbers where there are several.
fn all_variables<T>(dampers: &[Named<T>]) -> Vec<Variable> {
    let of = |(number, named): (usize, &Named<T>)| match dampers.len() {
        1 => variables("", named.clearance_m),
        _ => variables(&format!("damper[{number}]."), named.clearance_m),
    };
    (1..).zip(dampers).flat_map(of).collect()
}

/// Variables of a damper, in the order of `model.c`; their names begin with `prefix`.
fn variables(prefix: &str, clearance_m: f64) -> [Variable; 6] {
    let prefixed = |name: &str| format!("{prefix}{name}");
    [
        Variable {
            name: prefixed("displacement_m"),
            unit: "m",
            description: "Displacement of the seats at the communication point, positive in extension",
            kind: Kind::Input,
        },
        Variable {
            name: prefixed("velocity_m_per_s"),
            unit: "m/s",
            description: "Its rate over the communication step to come; with it the force is not late",
            kind: Kind::Input,
        },
        Variable {
            name: prefixed("force_n"),
            unit: "N",
            description: "Force, positive when it resists extension",
            kind: Kind::Output,
        },
        Variable {
            name: prefixed("clearance_m"),
            unit: "m",
            description: "Clearance 2a, the whole play",
            kind: Kind::Tunable {
                start: clearance_m,
                greatest: MAX_CLEARANCE_M,
            },
        },
        Variable {
            name: prefixed("status"),
            unit: "",
            description: "Bits latched: 1 input held, 2 input limited, 4 saturated, 8 damper swapped, 16 corrupted",
            kind: Kind::Counter,
        },
        Variable {
            name: prefixed("rejected_inputs"),
            unit: "",
            description: "Steps whose displacement was held or limited, up to 65535",
            kind: Kind::Counter,
        },
    ]
}

/// The step and the constants of all dampers.
fn source<T: Word>(dampers: &[Named<T>], step_s: f64, token: &str, is_loaded: bool) -> String {
    let mut text = String::from(
        "/* The step of a damper, and the constants of those of this FMU. */\n\n#include \"damper.h\"\n\n",
    );
    text += &source_of_step::<T>("DAMPER");
    let mut names = Vec::new();
    for (number, named) in (1..).zip(dampers) {
        let name = format!("damper_{number}");
        text += &constants_of("damper", &name, &named.damper);
        names.push(format!("&{name}_as_built"));
    }
    // Writing to a String does not fail.
    let _ = write!(
        text,
        "\n#include \"model.h\"\n#include \"dampers.h\"\n\n\
         const double model_step_s = {step_s:e};\n\
         const char model_token[] = \"{token}\";\n\n\
         const unsigned dampers_count = {};\n\
         const damper_damper *const dampers_as_built[] = {{{}}};\n",
        dampers.len(),
        names.join(", "),
    );
    text + if is_loaded { LOADED } else { BUILT_IN }
}

fn about<T: Word>(step_s: f64, is_loaded: bool) -> Markup {
    html! {
    p {
        "Displacement in, force out; the force resists extension when it is positive. The same bits as "
        code { "dashpot replay --scalar " (T::NAME) }
        ", where the communication step is the internal step and no velocity is given."
    }
    p {
        "A communication step of h from t ends at displacement_m + h velocity_m_per_s and goes there in a straight \
         line from where the last one ended. Without velocity the force at t + h is thus that of the displacement at \
         t: one communication step late. With it, it is that of t + h."
    }
    p {
        "h is a multiple of " (step_s) " s, or the step is refused and nothing changes. A displacement that is not \
         finite is held, one faster than the damper allows is limited: a warning once, and a bit of status. \
         clearance_m may be changed between steps."
    }
    @if is_loaded {
        p {
            "The constants are images in the folder resources (dashpot export --lang bin), for this step and scalar; \
             another image under the same name is another damper."
        }
    }    }
}
