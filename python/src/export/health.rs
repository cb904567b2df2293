//! Health models as source code or bytes, for firmware.

use std::path::PathBuf;

use dashpot_export::{Provenance, health_c_header, health_c_source, health_rust_source};
use dashpot_report::rounded::microseconds;
use dashpot_testbench::health::Noise;
use pyo3::prelude::*;

use super::written::{Constant, Language};
use crate::damper::Damper;
use crate::error::Outcome;
use crate::range::check_step;
use crate::sensors::{Sensors, model};

/// Builds the health model of a damper for a fixed step and writes it, as `dashpot export --health`; returns the
/// files, which replace older ones.
///
/// The noise of the sensors (standard deviations) must be given; the other properties are those of `dashpot.health`.
/// `lang` and `name` are those of `dashpot.export`; the default name ends in `_HEALTH`. Firmware takes the constant
/// with `HealthModel::from_image`, C with `dashpot_health_model_init`.
///
/// >>> import dashpot, pathlib, tempfile
/// >>> damper = dashpot.Damper("in-service")
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     file = pathlib.Path(folder, "health.c")
/// ...     files = dashpot.export_health(damper, file, displacement_noise_m=60e-6, force_noise_n=60)
/// ...     "uint8_t IN_SERVICE_HEALTH[" in pathlib.Path(files[0]).read_text()
/// True
#[pyfunction]
#[pyo3(signature = (
    damper, output, *, displacement_noise_m, force_noise_n, lang="c", step_s=0.001, memory_s=None, law_deviation=None,
    lag_s=None, lag_sd_s=None, name=None
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn export_health(
    damper: &Bound<'_, Damper>,
    output: &Bound<'_, PyAny>,
    displacement_noise_m: f64,
    force_noise_n: f64,
    lang: &str,
    step_s: f64,
    memory_s: Option<f64>,
    law_deviation: Option<f64>,
    lag_s: Option<f64>,
    lag_sd_s: Option<f64>,
    name: Option<String>,
) -> Outcome<Vec<PathBuf>> {
    check_step(step_s)?;
    let damper = damper.get();
    let constant = Constant::new(damper, output, lang, name, "_HEALTH")?;
    let sensors = Sensors {
        displacement_noise_m: Some(displacement_noise_m),
        force_noise_n: Some(force_noise_n),
        memory_s,
        law_deviation,
        lag_s,
        lag_sd_s,
    };
    let noise = Noise {
        displacement_m: displacement_noise_m,
        force_n: force_noise_n,
    };
    let settings = sensors.settings(noise);
    let model = model(&damper.parameters, &settings, step_s)?;
    let call = format!(
        "dashpot.export_health({}, \"{}\", displacement_noise_m={:e}, force_noise_n={}, lang=\"{}\", step_s={step_s}, \
         memory_s={}, law_deviation={}, lag_s={}, lag_sd_s={}{})",
        damper.called(),
        constant.output.display(),
        settings.displacement_noise_m,
        settings.force_noise_n,
        constant.lang(),
        settings.memory_s,
        settings.law_deviation,
        settings.lag_s,
        settings.lag_sd_s,
        constant.name_argument(),
    );
    let provenance = Provenance {
        damper: &damper.name,
        step_us: microseconds(step_s),
        command: &call,
    };
    let name = constant.name.clone();
    let content = match constant.language {
        Language::Rust => health_rust_source(&name, &model, &provenance)?.into_bytes(),
        Language::C => health_c_source(&name, &model, &provenance)?.into_bytes(),
        Language::Bin => model.to_image().into(),
    };
    constant.write(&content, || Ok(health_c_header(&name, &provenance)?))
}
