//! Dampers as source code or bytes, for firmware and other tools.

use std::path::{Path, PathBuf};

use dashpot_core::Damper as Built;
use dashpot_export::{
    ExportError, Provenance, Word, c_header, c_source, constant_name, rust_source,
    standalone_header, standalone_source,
};
use dashpot_files::output::write_together;
use pyo3::prelude::*;

use crate::arrays::Precision;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::overrides::path_of_file;
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
    let first = damper.name.split(", ").next().unwrap_or_default();
    let wanted = Wanted {
        damper,
        output: path_of_file(output)?,
        lang,
        standalone,
        step_s,
        name: name.unwrap_or_else(|| constant_name(first)),
    };
    match Precision::of(dtype)? {
        Precision::Single => wanted.write::<f32>("float32"),
        Precision::Double => wanted.write::<f64>("float64"),
    }
}

/// The damper and the form in which to write it.
struct Wanted<'a> {
    damper: &'a Damper,
    output: PathBuf,
    lang: &'a str,
    standalone: bool,
    step_s: f64,
    name: String,
}

impl Wanted<'_> {
    fn write<T: Word>(&self, dtype: &str) -> Outcome<Vec<PathBuf>> {
        let Self { name, output, .. } = self;
        let built: Built<T> = self.damper.parameters.build(self.step_s)?;
        let call = format!(
            "dashpot.export({}, \"{}\", lang=\"{}\", standalone={}, step_s={}, dtype=\"{dtype}\", name=\"{name}\")",
            self.damper.called(),
            output.display(),
            self.lang,
            if self.standalone { "True" } else { "False" },
            self.step_s,
        );
        let provenance = Provenance {
            damper: &self.damper.name,
            // Round to the picosecond to remove the rounding error of the product.
            step_us: (self.step_s * 1e12).round() / 1e6,
            command: &call,
        };
        let header = output.with_extension("h");
        let included = header.file_name().map(|name| name.to_string_lossy());
        let files = match self.lang {
            "rust" => vec![(output, rust_source(name, &built, &provenance)?.into_bytes())],
            "bin" => vec![(output, T::image(&built))],
            "c" if header == *output => {
                return refuse("output: the name of the header, allowed: another one, such as x.c");
            }
            "c" if self.standalone => vec![
                (
                    output,
                    standalone_source(name, &built, &provenance, included.as_deref())?.into_bytes(),
                ),
                (
                    &header,
                    standalone_header(name, &built, &provenance)?.into_bytes(),
                ),
            ],
            "c" => vec![
                (output, c_source(name, &built, &provenance)?.into_bytes()),
                (&header, c_header(name, &built, &provenance)?.into_bytes()),
            ],
            other => {
                return refuse(format!("lang: `{other}`, allowed: `rust`, `c` or `bin`"));
            }
        };
        let contents: Vec<(&Path, &[u8])> = files
            .iter()
            .map(|(path, content)| (path.as_path(), &content[..]))
            .collect();
        write_together(&contents)?;
        Ok(files.iter().map(|(path, _)| (*path).clone()).collect())
    }
}

impl From<ExportError> for Refusal {
    fn from(error: ExportError) -> Self {
        Self::Value(error.to_string())
    }
}
