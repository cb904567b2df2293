//! Parsers of option values whose types come from libraries that do not depend on the command line.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use dashpot_files::Scalar;
use dashpot_recording::{DecimalMark, Separator};

/// Parser of `--scalar`.
pub(super) fn scalar() -> impl TypedValueParser<Value = Scalar> {
    named([
        ("f32", "Single precision, as on the target", Scalar::F32),
        ("f64", "Double precision", Scalar::F64),
    ])
}

/// Parser of `--separator`.
pub(super) fn separator() -> impl TypedValueParser<Value = Separator> {
    named([
        ("comma", "`,`", Separator::Comma),
        ("semicolon", "`;`", Separator::Semicolon),
        ("tab", "Tabulator", Separator::Tab),
        ("spaces", "One or more spaces", Separator::Spaces),
        ("bar", "`|`", Separator::Bar),
    ])
}

/// Parser of `--decimal-mark`.
pub(super) fn decimal_mark() -> impl TypedValueParser<Value = DecimalMark> {
    named([
        ("point", "`0.5`", DecimalMark::Point),
        ("comma", "`0,5`", DecimalMark::Comma),
    ])
}

/// Parser of one of `values`: name, help and value.
fn named<T, const N: usize>(
    values: [(&'static str, &'static str, T); N],
) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    let allowed = values.map(|(name, help, _)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(allowed).map(move |given| {
        let (_, _, value) = values
            .iter()
            .find(|(name, _, _)| *name == given)
            .expect("the parser passes only these names");
        *value
    })
}
