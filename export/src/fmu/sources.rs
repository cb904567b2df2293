//! C sources of an FMU.

use super::{Fmu, Interface};

/// Name and text of a source file.
pub(super) type Source = (&'static str, String);

/// Official headers of the interface.
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

/// Sources of every FMU.
const COMMON: [(&str, &str); 4] = [
    ("bytes.c", include_str!("sources/bytes.c")),
    ("component.c", include_str!("sources/component.c")),
    ("component.h", include_str!("sources/component.h")),
    ("model.h", include_str!("sources/model.h")),
];

const FMI_2: (&str, &str) = ("fmi2.c", include_str!("sources/fmi2.c"));
const FMI_3: (&str, &str) = ("fmi3.c", include_str!("sources/fmi3.c"));

/// Prefixes of names that must differ between FMUs in one program.
const SHARED_PREFIXES: [&str; 4] = ["component_", "damper_", "dampers_", "model_"];

/// Copies files without a change.
pub(super) fn fixed(files: &[(&'static str, &str)]) -> Vec<Source> {
    let owned = |(name, text): &(&'static str, &str)| (*name, (*text).to_owned());
    files.iter().map(owned).collect()
}

/// Sources of the FMI interface, which use the model through `model.h`.
pub(super) fn of_interface(interface: Interface) -> Vec<Source> {
    let functions = match interface {
        Interface::Two => FMI_2,
        Interface::Three => FMI_3,
    };
    let mut sources = fixed(&COMMON);
    sources.extend(fixed(&[functions]));
    sources
}

/// Prepends the identifier to all shared names in a text.
pub(super) fn with_own_names(identifier: &str, text: &str) -> String {
    let is_name_char = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let mut own = String::with_capacity(2 * text.len());
    let mut rest = text;
    while let Some(start) = rest.find(is_name_char) {
        let (between, from) = rest.split_at(start);
        let end = from.find(|letter| !is_name_char(letter));
        let (word, after) = from.split_at(end.unwrap_or(from.len()));
        own += between;
        if word == "MODEL_IDENTIFIER_" {
            own += identifier;
            own.push('_');
        } else {
            if SHARED_PREFIXES
                .iter()
                .any(|prefix| word.starts_with(prefix))
            {
                own += identifier;
                own.push('_');
            }
            own += word;
        }
        rest = after;
    }
    own + rest
}

impl Fmu {
    /// Headers of the interface; the importer has its own, so they are not part of the FMU.
    pub(super) fn headers(&self) -> [(&'static str, &'static str); 3] {
        match self.interface {
            Interface::Two => HEADERS_2,
            Interface::Three => HEADERS_3,
        }
    }

    /// Names of the source files to compile.
    pub(super) fn compiled(&self) -> Vec<&'static str> {
        let names = self.sources.iter().map(|(name, _)| *name);
        let mut compiled: Vec<_> = names.filter(|name| name.ends_with(".c")).collect();
        compiled.sort_unstable();
        compiled
    }
}
