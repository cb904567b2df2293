//! `dashpot calibrate`: identifies damper parameters from bench tests.

mod damper_file;
mod digits;
mod further;
mod index_rows;
mod numbers;
mod page;
mod report;
pub mod words;

use std::path::{Path, PathBuf};

use further::{Further, FurtherArguments};
use numbers::{Held, NamedPrior, Variation};
use report::{Recording, Report};

use super::recording::MeasurementArguments;
use super::step_size::{self, StepSize};
use super::{DamperArguments, Format, print_report_beside, progress, streams};
use crate::commands::failure::{Failure, Outcome};
use dashpot_calibration::{
    Assumed, Calibration, CalibrationError, IndexTest, LoopTest, MAX_MISFIT, Progress, Recorded,
    TEMPERATURE_UNCERTAINTY_K,
};
use dashpot_files::FileError;
use dashpot_files::damper::KeyedParameters;
use dashpot_files::output::{cannot_write, write_bytes, write_whole_if};
use dashpot_recording::Gaps;

/// Identify damper parameters from bench tests: force-displacement loops or tables of their indices.
///
/// Reports how well the tests determine each parameter, and rejects parameters that they do not determine.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot calibrate --damper in-service --input bench.mf4 --vary orifice.discharge_coefficient \\
      --vary mount.stiffness_n_per_m --vary mount.clearance_m --output calibrated.toml --page calibrated.html
  dashpot calibrate --damper reduced-vertical --input slow.csv --input fast.csv --displacement Weg \\
      --displacement-unit mm --vary reduced.damping_n_s_per_m=5e4:3e5 --vary mount.stiffness_n_per_m \\
      --output found.toml
  dashpot calibrate --damper my.toml --input warm.mf4 --temperature-c 22 --input cold.mf4 --temperature-c -18 \\
      --validate fast.mf4 --temperature-c 25 --vary orifice.discharge_coefficient --vary-each force_offset_n \\
      --plan acceptance.toml --output found.toml
  dashpot calibrate --damper paper --indices table5.csv --vary orifice.diameter_m \\
      --prior orifice.diameter_m=2e-3:1e-4 --output found.toml

Parameters are identified by least squares, and each test is weighted by the noise of its force. Recorded loops also
determine two parameters of the rig: sensor_skew_s, the delay of the recorded force, and force_offset_n, the reading
of the force sensor at zero force. --vary sets their bounds, --prior states prior knowledge, and --hold fixes them. A
wrong sign, a wrong unit or a start from another kind of damper is an error; the message names the option that
corrects it.

A table of indices is a CSV file with the columns amplitude_m and frequency_hz and any of max_extension_force_n,
max_compression_force_n, energy_per_cycle_j (magnitudes; an empty cell means not measured), force_at_most_n (an upper
limit of the force) and scatter_percent (standard deviation; default 1).")]
pub struct CalibrateArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Recorded loops (time, displacement and force): one file per test, or one file with gaps between the tests.
    #[arg(long, value_name = "FILE")]
    input: Vec<PathBuf>,
    #[command(flatten)]
    channels: MeasurementArguments,
    /// Table of test indices, CSV.
    #[arg(long, value_name = "FILE")]
    indices: Vec<PathBuf>,
    /// Parameter to identify, starting from the damper's value. Bounds are in its unit; the default is a plausible
    /// range.
    #[arg(
        long,
        value_name = "KEY[=MIN:MAX]",
        required_unless_present = "vary_each"
    )]
    vary: Vec<Variation>,
    /// Parameter that each recorded test has for itself, such as oil.temperature_c or force_offset_n. Reports call that
    /// of test 2 KEY@2; the damper file keeps the start.
    #[arg(long, value_name = "KEY[=MIN:MAX]")]
    vary_each: Vec<Variation>,
    /// Oil temperature in the recordings, degrees Celsius: once for all, or once for each --input and then each
    /// --validate, in their order [default: that of the damper].
    #[arg(long, value_name = "C", value_parser = super::sheet::temperature, allow_negative_numbers = true)]
    temperature_c: Vec<f64>,
    #[command(flatten)]
    further: FurtherArguments,
    /// Prior knowledge of a parameter: mean and standard deviation.
    #[arg(long, value_name = "KEY=MEAN:DEVIATION")]
    prior: Vec<NamedPrior>,
    /// Use only the priors given by --prior, not the built-in ones (discharge coefficients, density and bulk modulus
    /// of the oil, elastic modulus of steel).
    #[arg(long)]
    no_priors: bool,
    /// Assume that force and displacement were recorded simultaneously; otherwise the skew between them is identified.
    /// Same as --hold sensor_skew_s.
    #[arg(long)]
    no_skew: bool,
    /// Fix a parameter of the rig, sensor_skew_s or force_offset_n, at a value (default 0) instead of identifying it.
    #[arg(long, value_name = "KEY[=VALUE]")]
    hold: Vec<Held>,
    /// Uncertainty of the oil temperature in the tests (K), as half of a 95 % interval. Included in all intervals.
    #[arg(
        long,
        value_name = "K",
        default_value_t = TEMPERATURE_UNCERTAINTY_K,
        value_parser = uncertainty,
        allow_negative_numbers = true
    )]
    temperature_uncertainty_k: f64,
    /// Uncertainty of the oil density (kg/m3), as half of a 95 % interval. Included in all intervals.
    #[arg(
        long,
        value_name = "KG_PER_M3",
        default_value_t = 0.0,
        value_parser = uncertainty,
        allow_negative_numbers = true
    )]
    density_uncertainty_kg_per_m3: f64,
    /// Largest accepted misfit of each test: rms residual beyond the noise, as a percentage of the rms force. A larger
    /// misfit is an error.
    #[arg(
        long,
        value_name = "PERCENT",
        default_value_t = 100.0 * MAX_MISFIT,
        value_parser = percent,
        allow_negative_numbers = true
    )]
    max_misfit_percent: f64,
    /// Number of starting points of the search.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..=1000))]
    starts: u16,
    /// Step of the model, us.
    #[arg(
        help = step_size::help("Step of the model", ""),
        long,
        default_value = "250",
        value_name = "US",
        allow_negative_numbers = true
    )]
    step_us: StepSize,
    /// Calibrated damper, TOML; its header lists the tests. No partial file is left after an error; `-` is standard
    /// output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// HTML page with the loops before and after calibration.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Runs the command.
///
/// # Errors
/// The damper, a parameter or a test is invalid, or the tests do not determine a parameter. Nothing is then written.
pub fn run(arguments: &CalibrateArguments) -> Outcome<()> {
    if arguments.input.is_empty() && arguments.indices.is_empty() {
        return Err(Failure::wrong_use(
            "no tests: give recorded loops with --input, or a table of indices with --indices",
        ));
    }
    refuse_same_streams(arguments)?;
    let damper = KeyedParameters::new(&arguments.damper.damper, &*arguments.damper.load()?)?;
    let given = arguments.given();
    let in_words = |error: CalibrationError| words::failure(error, &given);
    let request = numbers::request(arguments);
    request.check(&damper).map_err(in_words)?;
    let step_s = arguments.step_us.step_s();
    let bar = progress::bar(0, "reading");
    let planned = arguments.further.planned()?;
    let (mut recordings, mut loops, mut inputs) = (Vec::new(), Vec::new(), Vec::new());
    for (path, temperature_c) in arguments.input.iter().zip(arguments.temperatures_c()?) {
        let read = recorded_tests(arguments, path, temperature_c, in_words)?;
        recordings.push(Recording::new(&read.recorded, &read.gaps, read.tests.len()));
        loops.extend(read.tests);
        inputs.push(read.recorded);
    }
    let mut indices = Vec::new();
    for path in &arguments.indices {
        indices.extend(IndexTest::read(path)?);
    }
    let (varied, rig) = request.varied(&damper, &loops).map_err(in_words)?;
    let calibration = Calibration {
        damper,
        varied,
        loops,
        indices,
        step_s,
        starts: usize::from(arguments.starts),
        rig,
        assumed: Assumed {
            temperature_uncertainty_k: arguments.temperature_uncertainty_k,
            density_uncertainty_kg_per_m3: arguments.density_uncertainty_kg_per_m3,
            max_misfit: 0.01 * arguments.max_misfit_percent,
        },
    };
    let found = calibration.run(&|progress| {
        let Progress { stage, done, total } = progress;
        bar.set_message(format!("{stage}: {done} of {total}"));
    });
    bar.finish_and_clear();
    let found = found.map_err(in_words)?;
    let further = Further::new(arguments, &planned, &calibration, &found, in_words)?;
    let report = Report::new(
        arguments,
        &calibration,
        &inputs,
        recordings,
        &found,
        further,
    )?;
    let file = damper_file::text(&report, &found.damper)?;
    let page = match &arguments.page {
        Some(_) => page::write(&report, &calibration, &found)?,
        None => String::new(),
    };
    write_whole_if::<_, FileError>(arguments.page.as_deref(), |to_page| {
        if let Some((path, to_page)) = to_page {
            to_page
                .write_all(page.as_bytes())
                .map_err(|error| cannot_write(path, error))?;
        }
        write_bytes(&arguments.output, file.as_bytes())
    })?;
    print_report_beside(&arguments.output, arguments.format, &report, Report::print)
}

/// A recording with its tests.
struct Read {
    recorded: Recorded,
    gaps: Gaps,
    tests: Vec<LoopTest>,
}

/// Reads the tests of a recording at its temperature.
fn recorded_tests(
    arguments: &CalibrateArguments,
    path: &Path,
    temperature_c: Option<f64>,
    in_words: impl Fn(CalibrationError) -> Failure,
) -> Outcome<Read> {
    let (recorded, gaps) = super::recorded::read(path, &arguments.channels.channels())?;
    let step_s = arguments.step_us.step_s();
    let mut tests = LoopTest::from_recording(&recorded, step_s).map_err(in_words)?;
    for test in &mut tests {
        test.temperature_c = temperature_c;
    }
    Ok(Read {
        recorded,
        gaps,
        tests,
    })
}

impl CalibrateArguments {
    /// Returns the oil temperature of each recording, fitted ones first.
    fn temperatures_c(&self) -> Outcome<Vec<Option<f64>>> {
        let count = self.input.len() + self.further.validate.len();
        super::sheet::for_each(
            &self.temperature_c,
            count,
            "each --input and each --validate",
        )
    }

    /// Options that the advice in error messages depends on.
    fn given(&self) -> words::Given {
        let channels = self.channels.channels();
        words::Given {
            displacement_unit: channels.displacement.unit,
            force_unit: channels.force.unit,
            displacement_is_reversed: channels.displacement.reversed,
            force_is_reversed: channels.force.reversed,
            has_overrides: !self.damper.overrides.is_empty(),
            has_no_skew: self.no_skew,
        }
    }
}

/// Parses an uncertainty: 0 to 1000.
fn uncertainty(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|number| (0.0..=1e3).contains(number));
    number.ok_or_else(|| "allowed: 0 to 1000".into())
}

/// Parses a percentage.
fn percent(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|number| (0.1..=1e4).contains(number));
    number.ok_or_else(|| "allowed: 0.1 to 10000".into())
}

/// Rejects standard input for two inputs, and outputs that would overwrite an input.
fn refuse_same_streams(arguments: &CalibrateArguments) -> Outcome<()> {
    let damper = [("--damper", std::path::Path::new(&arguments.damper.damper))];
    let inputs = arguments
        .input
        .iter()
        .map(|path| ("--input", path.as_path()));
    let indices = arguments
        .indices
        .iter()
        .map(|path| ("--indices", path.as_path()));
    let held_back = arguments.further.held_back();
    let read = damper
        .into_iter()
        .chain(inputs)
        .chain(held_back)
        .chain(indices);
    let read: Vec<_> = read.collect();
    streams::refuse_second_standard_input(&read)?;
    let recordings = [&arguments.input[..], &arguments.further.validate].concat();
    streams::refuse_twice("--input and --validate", &recordings)?;
    streams::refuse_twice("--indices", &arguments.indices)?;
    streams::refuse_same_output(&[
        ("--output", Some(&arguments.output)),
        ("--page", arguments.page.as_deref()),
    ])?;
    for (_, path) in read {
        streams::refuse_input("--output", &arguments.output, path)?;
        if let Some(page) = &arguments.page {
            streams::refuse_input("--page", page, path)?;
        }
    }
    Ok(())
}
