//! Dampers as source code or bytes, for firmware.

use std::path::PathBuf;

use dashpot_core::Damper as Built;
use dashpot_export::{
    Provenance, Word, c_header, c_source, rust_source, standalone_header, standalone_source,
};
use dashpot_report::rounded::microseconds;
use pyo3::prelude::*;

use super::written::{Constant, Language};
use crate::arrays::Precision;
use crate::damper::Damper;
use crate::error::{Outcome, refuse};
use crate::range::check_step;

/// Builds a damper for a fixed step and writes it, as `dashpot export --lang`; returns the files, which replace older
/// ones.
///
/// `lang` is `"rust"` (a `static` of dashpot-core), `"c"` (bytes for the C library, and a header beside `output`) or
/// `"bin"` (bytes only). With `standalone`, C contains the step and needs no library. `dtype` is float32, as on the
/// target, or float64. `name` is that of the constant, by default the damper's in capitals. A comment states this call.
///
/// >>> import dashpot, pathlib, tempfile
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     files = dashpot.export(dashpot.Damper("in-service"), pathlib.Path(folder, "damper.c"), standalone=True)
/// ...     [pathlib.Path(file).name for file in files], "in_service_step" in pathlib.Path(files[1]).read_text()
/// (['damper.c', 'damper.h'], True)
#[pyfunction]
#[pyo3(signature = (damper, output, *, lang="c", standalone=false, step_s=0.001, dtype=None, name=None))]
pub fn export(
    damper: &Bound<'_, Damper>,
    output: &Bound<'_, PyAny>,
    lang: &str,
    standalone: bool,
    step_s: f64,
    dtype: Option<&Bound<'_, PyAny>>,
    name: Option<String>,
) -> Outcome<Vec<PathBuf>> {
    check_step(step_s)?;
    if standalone && lang != "c" {
        return refuse("standalone: allowed only with lang=\"c\"");
    }
    let damper = damper.get();
    let wanted = Wanted {
        damper,
        constant: Constant::new(damper, output, lang, name, "")?,
        standalone,
        step_s,
    };
    match Precision::of(dtype)? {
        Precision::Single => wanted.write::<f32>("float32"),
        Precision::Double => wanted.write::<f64>("float64"),
    }
}

/// The damper and the form in which to write it.
struct Wanted<'a> {
    damper: &'a Damper,
    constant: Constant,
    standalone: bool,
    step_s: f64,
}

impl Wanted<'_> {
    fn write<T: Word>(self, dtype: &str) -> Outcome<Vec<PathBuf>> {
        let constant = self.constant;
        let built: Built<T> = self.damper.parameters.build(self.step_s)?;
        let call = format!(
            "dashpot.export({}, \"{}\", lang=\"{}\", standalone={}, step_s={}, dtype=\"{dtype}\"{})",
            self.damper.called(),
            constant.output.display(),
            constant.lang(),
            if self.standalone { "True" } else { "False" },
            self.step_s,
            constant.name_argument(),
        );
        let provenance = Provenance {
            damper: &self.damper.name,
            step_us: microseconds(self.step_s),
            command: &call,
        };
        let name = constant.name.clone();
        let content = match constant.language {
            Language::Rust => rust_source(&name, &built, &provenance)?.into_bytes(),
            Language::Bin => T::image(&built),
            Language::C if self.standalone => {
                let included = constant.included();
                standalone_source(&name, &built, &provenance, included.as_deref())?.into_bytes()
            }
            Language::C => c_source(&name, &built, &provenance)?.into_bytes(),
        };
        constant.write(&content, || {
            Ok(match self.standalone {
                true => standalone_header(&name, &built, &provenance)?,
                false => c_header(&name, &built, &provenance)?,
            })
        })
    }
}
