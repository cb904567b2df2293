//! FMU of a damper or a bank of dampers, with its sources.

use std::fmt::Write;

use dashpot_core::Damper;
use dashpot_core::parameters::MAX_CLEARANCE_M;
use maud::{Markup, html};

use super::sources::{Source, fixed, of_interface, with_own_names};
use super::terminals::Terminal;
use super::variable::{Kind, Variable};
use super::{Fmu, Interface, check, token_of};
use crate::standalone::{INCLUDES, constants_of, header_of_step, source_with_bank};
use crate::{ExportError, Word};
use dashpot_files::nearest_nanosecond;

/// Sources of every bank.
const SOURCES: [(&str, &str); 2] = [
    ("dampers.h", include_str!("sources/dampers.h")),
    ("model.c", include_str!("sources/model.c")),
];

/// Sources that provide the dampers: compiled in, or loaded from resources.
const BUILT_IN: &str = include_str!("sources/built_in.c");
const LOADED: &str = include_str!("sources/loaded.c");

/// Damper with its name.
#[derive(Clone, Debug)]
pub struct NamedDamper<T> {
    /// Preset or file of the damper.
    pub name: String,
    /// The damper as built.
    pub damper: Damper<T>,
    /// Clearance 2a in the damper file (m).
    pub clearance_m: f64,
}

impl Fmu {
    /// Returns the FMU of dampers that are all built for the step `step_s` (s). The names of its functions start with
    /// `identifier`, which consists of ASCII letters, digits and `_`. With `is_loaded`, the constants are images in the
    /// resources folder, which the user can replace.
    ///
    /// # Errors
    /// Returns an error if the identifier in capitals is not a valid C constant name.
    pub fn of_dampers<T: Word>(
        interface: Interface,
        identifier: &str,
        dampers: &[NamedDamper<T>],
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
            // End of the step that ends closest to 1 s.
            stop_s: nearest_nanosecond((1.0 / step_s).round() * step_s),
            variables: all_variables(dampers),
            terminals: terminals(dampers.len()),
            has_input_derivatives: true,
            may_end: false,
            about: about::<T>(step_s, is_loaded),
            resources,
            sources,
            libraries: Vec::new(),
        })
    }
}

/// Variables of all dampers; with several dampers the names contain the damper's number.
fn all_variables<T>(dampers: &[NamedDamper<T>]) -> Vec<Variable> {
    let of_damper = |(number, named): (usize, &NamedDamper<T>)| match dampers.len() {
        1 => variables("", named.clearance_m),
        _ => variables(&format!("damper[{number}]."), named.clearance_m),
    };
    (1..).zip(dampers).flat_map(of_damper).collect()
}

/// One terminal for each damper: its two ends.
fn terminals(dampers: usize) -> Vec<Terminal> {
    let members = |prefix: String| {
        let members = ["displacement_m", "velocity_m_per_s", "force_n"];
        members
            .map(|member| (member, format!("{prefix}{member}")))
            .into()
    };
    let terminal = |number: usize| Terminal {
        name: if dampers == 1 {
            "damper".into()
        } else {
            format!("damper_{number}")
        },
        description: "Ends of the damper",
        members: members(if dampers == 1 {
            String::new()
        } else {
            format!("damper[{number}].")
        }),
    };
    (1..=dampers).map(terminal).collect()
}

/// Variables of a damper, in the same order as in `model.c`; their names start with `prefix`.
fn variables(prefix: &str, clearance_m: f64) -> [Variable; 6] {
    let prefixed = |name: &str| format!("{prefix}{name}");
    [
        Variable {
            name: prefixed("displacement_m"),
            unit: "m",
            description: "Displacement of the damper's ends at the communication point, positive in extension",
            kind: Kind::Input { start: 0.0 },
        },
        Variable {
            name: prefixed("velocity_m_per_s"),
            unit: "m/s",
            description: "Rate of displacement over the next communication step; with it the force has no delay",
            kind: Kind::Input { start: 0.0 },
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
            description: "Clearance 2a, the total play",
            kind: Kind::Tunable {
                start: clearance_m,
                max: MAX_CLEARANCE_M,
            },
        },
        Variable {
            name: prefixed("status"),
            unit: "",
            description: "Latched bits: 1 input held, 2 input limited, 4 saturated, 8 damper swapped, 16 corrupted, \
                          32 restarted",
            kind: Kind::Counter,
        },
        Variable {
            name: prefixed("rejected_inputs"),
            unit: "",
            description: "Number of steps with a held or limited displacement or a restart, up to 65535",
            kind: Kind::Counter,
        },
    ]
}

/// Source with the step and the constants of all dampers.
fn source<T: Word>(
    dampers: &[NamedDamper<T>],
    step_s: f64,
    token: &str,
    is_loaded: bool,
) -> String {
    let mut text = String::from(
        "/* The step of a damper, and the constants of the dampers of this FMU. */\n\n",
    );
    text += INCLUDES;
    text += "#include \"damper.h\"\n\n";
    text += &source_with_bank::<T>("DAMPER");
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
         const damper_damper *const dampers_as_built[] = {{{}}};\n\n\
         void dampers_step(const damper_damper *dampers, damper_state *states, const damper_real *displacements_m)\n\
         {{\n    damper_step_bank(dampers, states, displacements_m, dampers_count);\n}}\n",
        dampers.len(),
        names.join(", "),
    );
    text + if is_loaded { LOADED } else { BUILT_IN }
}

fn about<T: Word>(step_s: f64, is_loaded: bool) -> Markup {
    html! {
    p {
        "Input: displacement. Output: force, positive when it resists extension. If the communication step equals the \
         internal step and no velocity is given, the forces equal those of a Dashpot replay in "
        (T::NAME) " bit for bit."
    }
    p {
        "A communication step of size h from time t ends at displacement_m + h velocity_m_per_s and moves there in a \
         straight line from the end of the last step. Without the velocity, the force at t + h is that of the \
         displacement at t: one communication step late. With the velocity, it is that of t + h."
    }
    p {
        "h must be a multiple of " (step_s) " s; otherwise the step is refused and nothing changes. A displacement \
         that is not finite is held, and one that moves faster than the damper allows is limited; each sets a \
         bit of status and gives one warning. clearance_m may be changed between steps."
    }
    @if is_loaded {
        p {
            "The constants are images in the folder resources, as Dashpot exports them, for this step and scalar. \
             Each may be replaced by the image of another damper."
        }
    }
    }
}
