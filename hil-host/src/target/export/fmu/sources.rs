//! The sources of an FMU.

use std::fmt::Write;

use super::{Fmu, Interface};
use crate::target::export::Word;
use crate::target::export::standalone::{constants_of, header_of_step, source_of_step};

/// Headers of the interface, which need no compiling.
const HEADERS_2: [(&str, &str); 3] = [
    (
        "fmi2FunctionTypes.h",
        include_str!("headers/fmi2FunctionTypes.h"),
    ),
    ("fmi2Functions.h", include_str!("headers/fmi2Functions.h")),
    (
        "fmi2TypesPlatform.h",
        include_str!("headers/fmi2TypesPlatform.h"),
    ),
];
const HEADERS_3: [(&str, &str); 3] = [
    (
        "fmi3FunctionTypes.h",
        include_str!("headers/fmi3FunctionTypes.h"),
    ),
    ("fmi3Functions.h", include_str!("headers/fmi3Functions.h")),
    (
        "fmi3PlatformTypes.h",
        include_str!("headers/fmi3PlatformTypes.h"),
    ),
];

/// What both versions have.
const COMMON: [(&str, &str); 6] = [
    ("bytes.c", include_str!("sources/bytes.c")),
    ("component.c", include_str!("sources/component.c")),
    ("component.h", include_str!("sources/component.h")),
    ("dampers.h", include_str!("sources/dampers.h")),
    ("model.c", include_str!("sources/model.c")),
    ("model.h", include_str!("sources/model.h")),
];

const FMI_2: (&str, &str) = ("fmi2.c", include_str!("sources/fmi2.c"));
const FMI_3: (&str, &str) = ("fmi3.c", include_str!("sources/fmi3.c"));

/// The step and the constants.
const DAMPERS: &str = "dampers.c";

/// Where the dampers come from.
const BUILT_IN: &str = include_str!("sources/built_in.c");
const LOADED: &str = include_str!("sources/loaded.c");

/// How names begin that several FMUs in one program must not share.
const SHARED: [&str; 4] = ["component_", "damper_", "dampers_", "model_"];

impl<T: Word> Fmu<T> {
    /// Names of the files and their texts, in order of the names. What other files see begins with the identifier.
    pub(super) fn sources(&self) -> Vec<(&'static str, String)> {
        let fixed = self.fixed();
        let mut sources: Vec<_> = fixed.map(|(name, text)| (name, text.to_owned())).collect();
        sources.push(("damper.h", header_of_step::<T>("DAMPER")));
        sources.push((DAMPERS, self.dampers_source()));
        sources.sort_unstable_by_key(|(name, _)| *name);
        let named = |(name, text): (&'static str, String)| (name, self.with_own_names(&text));
        sources.into_iter().map(named).collect()
    }

    /// The headers of the interface, which are the importer's and in no FMU.
    pub(super) fn headers(&self) -> [(&'static str, &'static str); 3] {
        match self.interface {
            Interface::Two => HEADERS_2,
            Interface::Three => HEADERS_3,
        }
    }

    /// A text whose shared names begin with the identifier.
    fn with_own_names(&self, text: &str) -> String {
        let is_of_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
        let mut own = String::with_capacity(2 * text.len());
        let mut rest = text;
        while let Some(start) = rest.find(is_of_name) {
            let (between, from) = rest.split_at(start);
            let end = from.find(|letter| !is_of_name(letter));
            let (word, after) = from.split_at(end.unwrap_or(from.len()));
            own += between;
            if word == "MODEL_IDENTIFIER_" {
                own += &self.identifier;
                own.push('_');
            } else {
                if SHARED.iter().any(|begin| word.starts_with(begin)) {
                    own += &self.identifier;
                    own.push('_');
                }
                own += word;
            }
            rest = after;
        }
        own + rest
    }

    /// Names of the files that are compiled.
    pub(super) fn compiled(&self) -> Vec<&'static str> {
        let names = self.fixed().map(|(name, _)| name).chain([DAMPERS]);
        let mut compiled: Vec<_> = names.filter(|name| name.ends_with(".c")).collect();
        compiled.sort_unstable();
        compiled
    }

    /// The files that are the same for every damper.
    fn fixed(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let functions = match self.interface {
            Interface::Two => FMI_2,
            Interface::Three => FMI_3,
        };
        COMMON.into_iter().chain([functions])
    }

    /// The step and the constants of all dampers.
    fn dampers_source(&self) -> String {
        let mut text = String::from(
            "/* The step of a damper, and the constants of those of this FMU. */\n\n#include \"damper.h\"\n\n",
        );
        text += &source_of_step::<T>("DAMPER");
        let mut names = Vec::new();
        for (number, named) in (1..).zip(&self.dampers) {
            let name = format!("damper_{number}");
            text += &constants_of("damper", &name, &named.damper);
            names.push(format!("&{name}_as_built"));
        }
        // Writing to a String does not fail.
        let _ = write!(
            text,
            "\n#include \"model.h\"\n#include \"dampers.h\"\n\n\
             const double model_step_s = {:e};\n\
             const char model_token[] = \"{}\";\n\n\
             const unsigned dampers_count = {};\n\
             const damper_damper *const dampers_as_built[] = {{{}}};\n",
            self.step_s,
            self.token(),
            self.dampers.len(),
            names.join(", "),
        );
        text + if self.is_loaded { LOADED } else { BUILT_IN }
    }
}
