//! `dashpot export --health`: exports the health model of a damper as a constant or as bytes.

use dashpot_core::health::{Health, HealthModel};
use serde::Serialize;

use super::named::{command_line, name_of};
use super::written::Exported;
use super::{ExportArguments, Language};
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print_report_beside;
use crate::commands::sensors::model;
use dashpot_export::{Provenance, health_c_header, health_c_source, health_rust_source};
use dashpot_files::Scalar;

#[derive(Serialize)]
struct Report {
    damper: String,
    #[serde(flatten)]
    exported: Exported,
    step_s: f64,
    image_bytes: usize,
    model_bytes: usize,
    health_bytes: usize,
}

/// Builds the model and writes it.
pub(super) fn run(arguments: &ExportArguments) -> Outcome<()> {
    let noise = arguments.sensors.noise_for("--health")?;
    let settings = arguments.sensors.settings(noise);
    if arguments.scalar != Scalar::F32 {
        return Err(Failure::wrong_use(
            "--scalar f64: health monitoring uses single precision; allowed with --health: f32",
        ));
    }
    let name = name_of(arguments, "_HEALTH")?;
    let step_s = arguments.step_us.step_s();
    let model = model(&arguments.damper.load()?, &settings, step_s)?;
    let constant = name.as_deref().unwrap_or_default();
    let command = format!(
        "{} --health --displacement-noise-m {:e} --force-noise-n {} --memory-s {} --law-deviation {} --lag-s {} \
         --lag-sd-s {}",
        command_line(arguments, constant),
        settings.displacement_noise_m,
        settings.force_noise_n,
        settings.memory_s,
        settings.law_deviation,
        settings.lag_s,
        settings.lag_sd_s,
    );
    let provenance = Provenance {
        damper: &arguments.damper.damper,
        step_us: arguments.step_us.step_us(),
        command: &command,
    };
    let content = |_: Option<&str>| {
        Ok(match arguments.lang {
            Language::Rust => health_rust_source(constant, &model, &provenance)?.into_bytes(),
            Language::C => health_c_source(constant, &model, &provenance)?.into_bytes(),
            Language::Bin => model.to_image().into(),
        })
    };
    let header = || health_c_header(constant, &provenance);
    let report = Report {
        damper: arguments.damper.damper.clone(),
        exported: Exported::write(arguments, name.clone(), content, header)?,
        step_s,
        image_bytes: HealthModel::IMAGE_BYTES,
        model_bytes: size_of::<HealthModel>(),
        health_bytes: size_of::<Health>(),
    };
    print_report_beside(
        &arguments.output,
        arguments.format,
        &report,
        |out, report| {
            report.exported.print(out)?;
            writeln!(
                out,
                ": health model of {} for a step of {} us: image {} bytes, {} bytes in memory, {} bytes per estimate",
                report.damper,
                arguments.step_us,
                report.image_bytes,
                report.model_bytes,
                report.health_bytes
            )
        },
    )
}
