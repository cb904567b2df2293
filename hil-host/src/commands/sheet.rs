//! `dashpot sheet`: computes an acceptance sheet from recordings of a bench.

use std::path::{Path, PathBuf};

use super::failure::{Failure, Outcome};
use super::recording::MeasurementArguments;
use super::rig::publish;
use super::{Format, counted, streams};
use dashpot_files::input::is_standard_stream;
use dashpot_files::sheet::SheetParameters;
use dashpot_report::sheet::{Line, SheetInput, measured};
use dashpot_testbench::steady::SensorUncertainty;

/// Compute an acceptance sheet from recordings of a bench: indices with uncertainties, limits and verdict.
///
/// Finds the steady cycles of each harmonic motion in the recordings and assigns them to the tests of the sheet.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot sheet --input bench.mf4 --sheet acceptance.toml --temperature-c 20 --page sheet.html
  dashpot sheet --input warm.csv --temperature-c 20 --input cold.csv --temperature-c -20 --sheet example \\
      --displacement Weg --displacement-unit mm --force Kraft --force-unit kN \\
      --serial-number 4711-0815 --operator \"A. Miller\" --page sheet.html

A motion belongs to a test if amplitude and frequency differ from those of the test by at most
motion_tolerance_percent of the sheet (5 by default). A limit is met if the value and its whole 95 % interval are
within; otherwise it is violated, or undecided if the limit is within the interval. The exit code is 1 unless every
limit is met and every test was measured; the page is written in any case. docs/rig.md describes sheets."
)]
pub struct SheetArguments {
    /// Recording of one or more tests (time, displacement and force).
    #[arg(long, value_name = "FILE", required = true)]
    input: Vec<PathBuf>,
    #[command(flatten)]
    channels: MeasurementArguments,
    /// Sheet: built-in name or TOML file, `-` for standard input.
    #[arg(long, value_name = "NAME|FILE")]
    sheet: String,
    /// Oil temperature in the recordings, degrees Celsius: once for all, or once for each --input in the same order.
    #[arg(long, value_name = "C", value_parser = temperature)]
    temperature_c: Vec<f64>,
    /// Uncertainty of the force sensor's calibration, % of the value (half of a 95 % interval).
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, value_parser = percent)]
    force_uncertainty_percent: f64,
    /// Uncertainty of the displacement sensor's calibration, % of the value (half of a 95 % interval).
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, value_parser = percent)]
    displacement_uncertainty_percent: f64,
    /// Serial number of the damper, for the header.
    #[arg(long, value_name = "TEXT")]
    serial_number: Option<String>,
    /// Name of the operator, for the header.
    #[arg(long, value_name = "TEXT")]
    operator: Option<String>,
    /// Date of the test, for the header.
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
    /// Page for archiving or printing, a self-contained HTML file; `-` for standard output.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Runs the command.
///
/// # Errors
/// The sheet or a recording is invalid, no motion of a recording is steady, or the verdict is not good.
pub fn run(arguments: &SheetArguments) -> Outcome<()> {
    refuse_same_streams(arguments)?;
    let temperatures_c = arguments.temperatures_c()?;
    let sheet = SheetParameters::load(&arguments.sheet)?;
    let channels = arguments.channels.channels();
    let inputs = arguments.input.iter().zip(temperatures_c);
    let inputs =
        inputs.map(|(path, temperature_c)| SheetInput::read(path, &channels, temperature_c));
    let inputs = inputs.collect::<Result<Vec<_>, _>>()?;
    let sensors = SensorUncertainty {
        force: 0.01 * arguments.force_uncertainty_percent,
        displacement: 0.01 * arguments.displacement_uncertainty_percent,
    };
    let mut report = measured(&sheet, inputs, sensors)
        .map_err(|error| Failure::new(format!("{error}; give it with --temperature-c")))?;
    report.fields.extend(arguments.fields());
    publish(&mut report, arguments.page.as_deref(), arguments.format)
}

impl SheetArguments {
    /// Returns the oil temperature of each recording.
    fn temperatures_c(&self) -> Outcome<Vec<Option<f64>>> {
        for_each(&self.temperature_c, self.input.len(), "each --input")
    }

    /// Returns the lines of the header that were given as options.
    fn fields(&self) -> impl Iterator<Item = Line> {
        let given = [
            ("Serial number", &self.serial_number),
            ("Date of the test", &self.date),
            ("Operator", &self.operator),
        ];
        given.into_iter().filter_map(|(name, text)| {
            text.as_ref().map(|text| Line {
                name: name.into(),
                text: text.clone(),
            })
        })
    }
}

/// Returns the temperature of each of `count` recordings, given once for all or once for each.
pub(super) fn for_each(given: &[f64], count: usize, each: &str) -> Outcome<Vec<Option<f64>>> {
    match given {
        [] => Ok(vec![None; count]),
        [temperature_c] => Ok(vec![Some(*temperature_c); count]),
        _ if given.len() == count => Ok(given.iter().copied().map(Some).collect()),
        _ => Err(Failure::wrong_use(format!(
            "--temperature-c: {} values for {}; give one for all, or one for {each}",
            given.len(),
            counted(count as u64, "recording")
        ))),
    }
}

fn refuse_same_streams(arguments: &SheetArguments) -> Outcome<()> {
    if let Some(path) = arguments.input.iter().find(|path| is_standard_stream(path)) {
        return Err(Failure::wrong_use(format!(
            "--input {}: a sheet states the SHA-256 of each recording; give the name of a file",
            path.display()
        )));
    }
    streams::refuse_twice("--input", &arguments.input)?;
    let Some(page) = &arguments.page else {
        return Ok(());
    };
    let inputs = arguments.input.iter().map(PathBuf::as_path);
    for path in inputs.chain([Path::new(&arguments.sheet)]) {
        streams::refuse_input("--page", page, path)?;
    }
    Ok(())
}

pub(super) fn temperature(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|number| (-100.0..=300.0).contains(number));
    number.ok_or_else(|| "allowed: -100 to 300".into())
}

fn percent(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|number| (0.0..=100.0).contains(number));
    number.ok_or_else(|| "allowed: 0 to 100".into())
}
