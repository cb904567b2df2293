//! A vehicle whose dampers outside other FMUs are: the interface in C over a library of Rust.

use std::fs;
use std::path::PathBuf;

use maud::{Markup, html};

use super::sources::of_interface;
use super::variable::{Kind, Variable};
use super::{Fmu, Interface, check, token_of};
use crate::ExportError;
use dashpot_files::nearest_nanosecond;
use dashpot_vehicle_run::{Coupled, CoupledCase, CoupledVariable};

/// Units by the ends of names, longest first.
const UNITS: [(&str, &str); 5] = [
    ("_m_per_s2", "m/s2"),
    ("_m_per_s", "m/s"),
    ("_rad", "rad"),
    ("_m", "m"),
    ("_n", "N"),
];

impl Fmu {
    /// Of a vehicle that has the variables of `coupled`; its functions begin with `identifier`, of ASCII letters, digits and `_`. `library`
    /// is that of `dashpot-vehicle-model`, `tables` name and content of the contact's tables.
    ///
    /// # Errors
    /// The identifier in capitals is no name of a constant of C; a case that cannot be written; a library that cannot be read.
    pub fn of_vehicle(
        interface: Interface,
        identifier: &str,
        of: &CoupledCase,
        coupled: &Coupled,
        tables: (String, Vec<u8>),
        library: PathBuf,
    ) -> Result<Self, ExportError> {
        check(identifier)?;
        let case = serde_json::to_vec(of).map_err(|error| ExportError::Case(error.to_string()))?;
        let bytes = fs::read(&library)
            .map_err(|error| ExportError::Library(format!("{}: {error}", library.display())))?;
        let token = token_of(identifier, interface, [case.as_slice(), bytes.as_slice()]);
        let step_s = coupled.step_s();
        let mut sources = of_interface(interface);
        sources.push((
            "constants.c",
            constants(step_s, &token, &CoupledCase::digest(&case)),
        ));
        let mut variables: Vec<Variable> = coupled.variables().iter().map(variable).collect();
        variables.push(Variable {
            name: "ending".into(),
            unit: "",
            description: "0 on its way, 1 the case is over, 2 derailed, 3 outside the tables of the contact, 4 diverged, 5 beyond the model, 6 overturned",
            kind: Kind::Counter,
        });
        Ok(Self {
            interface,
            identifier: identifier.to_owned(),
            token,
            title: format!(
                "{}, internal step {step_s} s, outside: {}",
                of.case.name,
                of.outside.join(", ")
            ),
            step_s,
            stop_s: nearest_nanosecond(coupled.duration_s()),
            variables,
            has_input_derivatives: false,
            may_end: true,
            about: about(of),
            resources: vec![(CoupledCase::FILE.into(), case), tables],
            sources,
            library: Some(library),
        })
    }
}

fn variable(of: &CoupledVariable) -> Variable {
    let unit = UNITS.iter().find(|(end, _)| of.name.ends_with(end));
    Variable {
        name: of.name.clone(),
        unit: unit.map_or("", |(_, unit)| unit),
        description: match of.is_force() {
            true => "Force of the damper outside, positive when it resists extension",
            false => "",
        },
        kind: match of.is_force() {
            true => Kind::Input,
            false => Kind::Output,
        },
    }
}

fn constants(step_s: f64, token: &str, digest: &str) -> String {
    format!(
        "/* What this FMU is. */\n\n#include \"model.h\"\n\n\
         const double model_step_s = {step_s:e};\nconst char model_token[] = \"{token}\";\n\n\
         /* Of the case in the resources, for the library. */\nconst char model_case_digest[] = \"{digest}\";\n"
    )
}

fn about(of: &CoupledCase) -> Markup {
    html! {
        p {
            "The vehicle of the case " (of.case.name) " on its track, without the force of " (of.outside.join(", ")) ": that is an \
             input. Outputs are the columns of history.csv of " code { "dashpot vehicle" } ", and the rate of each damper outside over the \
             last internal step."
        }
        p {
            "A force that is set at t acts at the end of the internal step from t, and stays until another is set. A simulation ends with the \
             case, or when the vehicle derails, overturns or goes beyond the model: " code { "ending" } " tells why."
        }
    }
}
