//! Vehicle FMU with externally computed dampers: the C interface on top of a Rust library.

use std::fs;
use std::path::PathBuf;

use maud::{Markup, html};

use super::sources::of_interface;
use super::terminals::Terminal;
use super::variable::{Kind, Variable};
use super::{Fmu, Interface, Platform, check, token_of};
use crate::ExportError;
use dashpot_files::nearest_nanosecond;
use dashpot_vehicle_run::signals::slug;
use dashpot_vehicle_run::{Coupled, CoupledCase, CoupledVariable, Input};

/// Units by the suffix of a variable's name, longest first.
const UNITS: [(&str, &str); 6] = [
    ("_n_m", "N.m"),
    ("_m_per_s2", "m/s2"),
    ("_m_per_s", "m/s"),
    ("_rad", "rad"),
    ("_m", "m"),
    ("_n", "N"),
];

impl Fmu {
    /// Returns the FMU of a vehicle with the variables of `coupled`. The names of its functions start with
    /// `identifier`, which consists of ASCII letters, digits and `_`. `libraries` are the static library of
    /// `dashpot-vehicle-model` for each platform; `tables` are the names and contents of the files with the contact
    /// tables.
    ///
    /// # Errors
    /// Returns an error if the identifier in capitals is not a valid C constant name, if the case cannot be written, or
    /// if the library cannot be read.
    pub fn of_vehicle(
        interface: Interface,
        identifier: &str,
        case: &CoupledCase,
        coupled: &Coupled,
        tables: Vec<(String, Vec<u8>)>,
        libraries: Vec<(Platform, PathBuf)>,
    ) -> Result<Self, ExportError> {
        check(identifier)?;
        let json =
            serde_json::to_vec(case).map_err(|error| ExportError::Case(error.to_string()))?;
        let read = |(_, library): &(Platform, PathBuf)| {
            fs::read(library).map_err(|error| ExportError::Library {
                path: library.clone(),
                reason: error.to_string(),
            })
        };
        let contents: Vec<Vec<u8>> = libraries.iter().map(read).collect::<Result<_, _>>()?;
        let parts = contents.iter().map(Vec::as_slice);
        let token = token_of(identifier, interface, std::iter::once(&*json).chain(parts));
        let step_s = coupled.step_s();
        let mut sources = of_interface(interface);
        sources.push((
            "constants.c",
            constants(step_s, &token, &CoupledCase::digest(&json)),
        ));
        let mut variables: Vec<Variable> = coupled
            .variables()
            .iter()
            .enumerate()
            .map(|(index, one)| variable(one, coupled.value(index).unwrap_or_default()))
            .collect();
        variables.push(Variable {
            name: "ending".into(),
            unit: "",
            description: "0 running, 1 completed, 2 a wheel climbed the rail, 3 outside the contact tables, \
                          4 diverged, 5 beyond the model, 6 overturned",
            kind: Kind::Counter,
        });
        Ok(Self {
            interface,
            identifier: identifier.to_owned(),
            token,
            title: format!(
                "{}, internal step {step_s} s, outside: {}",
                case.case.name,
                case.outside.join(", ")
            ),
            step_s,
            stop_s: nearest_nanosecond(coupled.duration_s()),
            terminals: case.outside.iter().map(|damper| terminal(damper)).collect(),
            variables,
            has_input_derivatives: false,
            may_end: true,
            about: about(case),
            resources: std::iter::once((CoupledCase::FILE.into(), json))
                .chain(tables)
                .collect(),
            sources,
            libraries,
        })
    }
}

/// Terminal of an external damper, for the terminal of a damper's FMU.
fn terminal(damper: &str) -> Terminal {
    let name = slug(damper);
    let members = ["displacement_m", "velocity_m_per_s", "force_n"];
    Terminal {
        members: members
            .map(|member| (member, format!("{name}_{member}")))
            .into(),
        description: "Ends of an external damper",
        name,
    }
}

fn variable(variable: &CoupledVariable, start: f64) -> Variable {
    let unit = UNITS
        .iter()
        .find(|(suffix, _)| variable.name.ends_with(suffix));
    Variable {
        name: variable.name.clone(),
        unit: unit.map_or("", |(_, unit)| unit),
        description: variable.input().map_or("", Input::description),
        kind: match variable.input() {
            Some(_) => Kind::Input { start },
            None => Kind::Output,
        },
    }
}

fn constants(step_s: f64, token: &str, digest: &str) -> String {
    format!(
        "/* Identity of this FMU. */\n\n#include \"model.h\"\n\n\
         const double model_step_s = {step_s:e};\nconst char model_token[] = \"{token}\";\n\n\
         /* Digest of the case in the resources folder, which the library checks. */\n\
         const char model_case_digest[] = \"{digest}\";\n"
    )
}

fn about(case: &CoupledCase) -> Markup {
    html! {
        p {
            "The vehicle of the case " (case.case.name) " on its track. The force of " (case.outside.join(", "))
            " is an input, and so are the speed, a factor on the friction, and forces and moments on each body. \
             Outputs are the signals of a Dashpot vehicle history, and the rate of each external damper over the last \
             internal step."
        }
        p {
            "A damper force that is set at time t acts at the end of the internal step that starts at t; other inputs \
             act during it. A value stays until another is set. A simulation ends with the case, or when the vehicle \
             derails, overturns or goes beyond the model; "
            code { "ending" }
            " gives the reason."
        }
    }
}
