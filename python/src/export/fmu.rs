//! Dampers as FMUs.

use dashpot_export::fmu::{
    Binary, CompileError, Fmu, Interface, NamedDamper, Platform, Remedy, Target, archive, compile,
};
use dashpot_export::{Word, constant_name};
use dashpot_files::output::write_bytes;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::own_name;
use crate::arrays::Precision;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::overrides::path_of_file;
use crate::range::check_step;

/// Writes a damper, or a sequence of dampers as a bank, as an FMU for co-simulation, as `dashpot export --fmi`; returns
/// the platforms of its libraries.
///
/// `fmi` is the version of the standard, 2 or 3; `step_s` the internal step; `dtype` float32 or float64; `name` that of
/// the FMU, by default the first damper's in small letters. With `loadable`, the constants are images in the FMU, where
/// they can be replaced. A C compiler builds the library for this platform: `cc`, or the one in the variable `CC`.
/// `platforms` adds others: a dictionary from platform to compiler, such as `{"x86_64-windows":
/// "x86_64-w64-mingw32-gcc"}`. With `sources_only` no compiler is needed; the importer compiles the sources.
///
/// >>> import dashpot, pathlib, tempfile, zipfile
/// >>> damper = dashpot.Damper("in-service")
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     file = pathlib.Path(folder, "damper.fmu")
/// ...     platforms = dashpot.export_fmu(damper, file, sources_only=True)
/// ...     platforms, "modelDescription.xml" in zipfile.ZipFile(file).namelist()
/// ([], True)
#[pyfunction]
#[pyo3(signature = (
    dampers, output, *, fmi=3, step_s=0.001, dtype=None, name=None, loadable=false, platforms=None, sources_only=false
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn export_fmu(
    py: Python<'_>,
    dampers: &Bound<'_, PyAny>,
    output: &Bound<'_, PyAny>,
    fmi: u32,
    step_s: f64,
    dtype: Option<&Bound<'_, PyAny>>,
    name: Option<String>,
    loadable: bool,
    platforms: Option<&Bound<'_, PyDict>>,
    sources_only: bool,
) -> Outcome<Vec<String>> {
    check_step(step_s)?;
    let interface = match fmi {
        2 => Interface::Two,
        3 => Interface::Three,
        other => return refuse(format!("fmi: {other}, allowed: 2 or 3")),
    };
    let targets = targets(platforms, sources_only)?;
    let output = path_of_file(output)?;
    let dampers = match dampers.cast::<Damper>() {
        Ok(one) => vec![one.clone()],
        Err(_) => dampers.extract::<Vec<Bound<'_, Damper>>>()?,
    };
    let Some(first) = dampers.first() else {
        return refuse("dampers: empty, allowed: a damper, or a sequence of at least one");
    };
    let name = name.unwrap_or_else(|| constant_name(own_name(first.get())).to_lowercase());
    let dampers: Vec<&Damper> = dampers.iter().map(Bound::get).collect();
    let fmu = match Precision::of(dtype)? {
        Precision::Single => fmu::<f32>(&dampers, interface, &name, step_s, loadable)?,
        Precision::Double => fmu::<f64>(&dampers, interface, &name, step_s, loadable)?,
    };
    py.detach(|| {
        let binaries = targets
            .iter()
            .map(|target| compile(&fmu, target).map_err(|error| cannot_compile(&error, target)));
        let binaries: Vec<Binary> = binaries.collect::<Outcome<_>>()?;
        let bytes = archive(&fmu, &binaries).map_err(|error| Refusal::Value(error.to_string()))?;
        write_bytes(&output, &bytes)?;
        Ok(binaries.into_iter().map(|binary| binary.platform).collect())
    })
}

/// The platforms for which to compile.
fn targets(platforms: Option<&Bound<'_, PyDict>>, sources_only: bool) -> Outcome<Vec<Target>> {
    let mut targets = Vec::new();
    for (platform, compiler) in platforms.into_iter().flatten() {
        let platform: String = platform.extract()?;
        let compiler: String = compiler.extract()?;
        if compiler.trim().is_empty() {
            return refuse(format!("platforms: {platform}: no compiler"));
        }
        let platform = match platform.parse::<Platform>() {
            Ok(platform) => platform,
            Err(error) => return refuse(format!("platforms: {error}")),
        };
        targets.push(Target { platform, compiler });
    }
    match (sources_only, targets.is_empty()) {
        (true, true) => Ok(targets),
        (true, false) => {
            refuse("platforms: not with sources_only=True, which compiles for no platform")
        }
        (false, _) => Ok(Target::with_here(targets)),
    }
}

fn fmu<T: Word>(
    dampers: &[&Damper],
    interface: Interface,
    name: &str,
    step_s: f64,
    is_loaded: bool,
) -> Outcome<Fmu> {
    let named = dampers.iter().map(|damper| {
        Ok(NamedDamper {
            name: damper.name.clone(),
            damper: damper.parameters.build::<T>(step_s)?,
            clearance_m: damper.parameters.mount.clearance_m,
        })
    });
    let named = named.collect::<Outcome<Vec<_>>>()?;
    Ok(Fmu::of_dampers(interface, name, &named, step_s, is_loaded)?)
}

/// Describes a compile error and its remedies in terms of arguments.
fn cannot_compile(error: &CompileError, target: &Target) -> Refusal {
    let platform = &target.platform;
    let is_here = *platform == Platform::here();
    Refusal::Value(error.with_remedies(|remedy| match remedy {
        Remedy::OtherCompiler if is_here => "another C compiler in the variable CC".into(),
        Remedy::OtherCompiler => {
            format!("another C compiler with platforms={{\"{platform}\": COMPILER}}")
        }
        Remedy::SourcesOnly => "no library with sources_only=True".into(),
        Remedy::Fmi3 => "fmi=3".into(),
        // Only the FMU of a vehicle has a library.
        Remedy::OtherLibrary => "the command, which takes libraries".into(),
    }))
}
