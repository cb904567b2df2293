//! `dashpot export --fmi`: a damper or a bank as an FMU.

use dashpot_core::Damper;
use serde::Serialize;

use super::ExportArguments;
use super::named::constant_name;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print_report_beside;
use crate::files::damper;
use crate::files::output::{self, write_bytes};
use crate::study::Scalar;
use crate::target::export::Word;
use crate::target::export::fmu::{Fmu, Interface, Named, archive, compile};

/// Options of an FMU.
#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "FMU")]
pub(super) struct FmuArguments {
    /// Write an FMU for co-simulation of this version of the interface, with a library for this platform and its sources in C.
    #[arg(long, value_name = "2|3", value_parser = ["2", "3"], conflicts_with_all = ["lang", "standalone", "health"])]
    fmi: Option<String>,
    /// Another damper of the FMU, preset or TOML file, as it is there; repeated for a bank.
    #[arg(long, value_name = "NAME|FILE")]
    also: Vec<String>,
    /// The constants are images in the folder of resources of the FMU, where others may take their place.
    #[arg(long)]
    loadable: bool,
    /// No library for this platform: no C compiler is needed here, and the importer compiles the sources.
    #[arg(long)]
    sources_only: bool,
}

impl FmuArguments {
    /// The interface asked for.
    ///
    /// # Errors
    /// None, with options that mean nothing then.
    pub(super) fn interface(&self) -> Outcome<Option<Interface>> {
        let others = [
            ("--also", !self.also.is_empty()),
            ("--loadable", self.loadable),
            ("--sources-only", self.sources_only),
        ];
        match (
            self.fmi.as_deref(),
            others.iter().find(|(_, is_given)| *is_given),
        ) {
            (None, Some((option, _))) => Err(Failure::wrong_use(format!(
                "{option}: it is of an FMU, allowed: with --fmi"
            ))),
            (None, None) => Ok(None),
            (Some("2"), _) => Ok(Some(Interface::Two)),
            (Some(_), _) => Ok(Some(Interface::Three)),
        }
    }
}

#[derive(Serialize)]
struct Report {
    dampers: Vec<String>,
    fmi: &'static str,
    name: String,
    output: String,
    scalar: Scalar,
    step_s: f64,
    token: String,
    /// Of the library; `None` where there are only sources.
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<String>,
    fmu_bytes: usize,
}

/// Builds the dampers and writes the FMU.
pub(super) fn run<T: Word>(arguments: &ExportArguments, interface: Interface) -> Outcome<()> {
    let step_s = arguments.step_us.step_s();
    let first = (arguments.damper.damper.clone(), arguments.damper.load()?);
    let mut dampers = vec![first];
    for name in &arguments.fmu.also {
        dampers.push((name.clone(), damper::load(name, &[])?));
    }
    let names: Vec<String> = dampers.iter().map(|(name, _)| name.clone()).collect();
    let named = dampers.into_iter().map(|(name, parameters)| -> Outcome<_> {
        let damper: Damper<T> = parameters.build(step_s)?;
        let clearance_m = parameters.mount.clearance_m;
        Ok(Named {
            name,
            damper,
            clearance_m,
        })
    });
    let identifier = match &arguments.name {
        Some(name) => name.clone(),
        None => constant_name(&arguments.damper.damper).to_lowercase(),
    };
    let named = named.collect::<Outcome<_>>()?;
    let fmu = Fmu::new(
        interface,
        &identifier,
        named,
        step_s,
        arguments.fmu.loadable,
    )?;
    let binary = match arguments.fmu.sources_only {
        true => None,
        false => Some(compile(&fmu).map_err(|error| Failure::new(error.to_string()))?),
    };
    let bytes = archive(&fmu, binary.as_ref()).map_err(|error| Failure::new(error.to_string()))?;
    write_bytes(&arguments.output, &bytes)?;
    let report = Report {
        dampers: names,
        fmi: match interface {
            Interface::Two => "2.0",
            Interface::Three => "3.0",
        },
        name: identifier,
        output: output::name(&arguments.output).display().to_string(),
        scalar: Scalar::of::<T>(),
        step_s,
        token: fmu.token(),
        platform: binary.map(|binary| binary.platform),
        fmu_bytes: bytes.len(),
    };
    print_report_beside(
        &arguments.output,
        arguments.format,
        &report,
        |out, report| {
            writeln!(
                out,
                "{} in {}: FMI {}, {} for {} us, {}, {}; {} bytes",
                report.name,
                report.output,
                report.fmi,
                report.dampers.join(", "),
                arguments.step_us,
                report.scalar,
                match &report.platform {
                    Some(platform) => format!("a library for {platform} and sources"),
                    None => "sources only".into(),
                },
                report.fmu_bytes
            )
        },
    )
}
