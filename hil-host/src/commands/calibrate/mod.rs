//! `dashpot calibrate`: from bench tests to the numbers of a damper.

mod damper_file;
mod numbers;
mod page;
mod recorded;
mod report;
pub mod words;

use std::path::PathBuf;

use numbers::{Held, NamedPrior, Variation};
use report::{Recording, Report};

use super::recording::MeasurementArguments;
use super::step_size::{self, StepSize};
use super::{DamperArguments, Format, print_report_beside, progress, streams};
use crate::commands::failure::{Failure, Outcome};
use dashpot_calibration::{
    Assumed, Calibration, CalibrationError, IndexTest, LoopTest, MAX_MISFIT, Progress,
    TEMPERATURE_UNCERTAINTY_K,
};
use dashpot_files::FileError;
use dashpot_files::damper::Keyed;
use dashpot_files::output::{cannot_write, write_bytes, write_whole_if};

/// Find the numbers of a damper from bench tests: force-displacement loops, or tables of their indices.
///
/// Says how well the tests determine each number, and refuses those that they do not.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot calibrate --damper in-service --input bench.mf4 --vary orifice.discharge_coefficient \\
      --vary mount.stiffness_n_per_m --vary mount.clearance_m --output calibrated.toml --page calibrated.html
  dashpot calibrate --damper reduced-vertical --input slow.csv --input fast.csv --displacement Weg --displacement-unit mm \\
      --vary reduced.damping_n_s_per_m=5e4:3e5 --vary mount.stiffness_n_per_m --output found.toml
  dashpot calibrate --damper paper --indices table5.csv --vary orifice.diameter_m --prior orifice.diameter_m=2e-3:1e-4 \\
      --output found.toml

Numbers are found by least squares; each test counts by what its force scatters by. Two numbers of the rig are found with them from recorded
loops: sensor_skew_s, the time by which the force is recorded later, and force_offset_n, what the force sensor shows at no force. --vary gives
them bounds, --prior says what is known of them, and --hold keeps them. A wrong sign, a wrong unit and a start from another kind of damper
are refused with the option that helps. A table of indices is CSV with the columns
amplitude_m, frequency_hz and any of max_extension_force_n, max_compression_force_n, energy_per_cycle_j (magnitudes; an empty cell was
not measured), force_at_most_n (what no force exceeds) and scatter_percent (standard deviation; 1 where none is given).")]
pub struct CalibrateArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Recorded loops: time, displacement and force; one file for each test, or one with gaps between the tests.
    #[arg(long, value_name = "FILE")]
    input: Vec<PathBuf>,
    #[command(flatten)]
    channels: MeasurementArguments,
    /// Table of the indices of tests, CSV.
    #[arg(long, value_name = "FILE")]
    indices: Vec<PathBuf>,
    /// A number to find, where it starts being the damper's; bounds in its unit, where they are not to be the plausible ones.
    #[arg(long, value_name = "KEY[=LEAST:GREATEST]", required = true)]
    vary: Vec<Variation>,
    /// What is known of a number before the tests: mean and standard deviation.
    #[arg(long, value_name = "KEY=MEAN:DEVIATION")]
    prior: Vec<NamedPrior>,
    /// Only priors that are given, not those that hold for every damper (discharge coefficients, density and bulk modulus of oil, steel).
    #[arg(long)]
    no_priors: bool,
    /// Force and displacement are recorded at the same instant; else the skew between them is found too. The same as --hold sensor_skew_s.
    #[arg(long)]
    no_skew: bool,
    /// A number of the rig that is not to be found, sensor_skew_s or force_offset_n, and its value, 0 where none is given.
    #[arg(long, value_name = "KEY[=VALUE]")]
    hold: Vec<Held>,
    /// How well you know the temperature of the oil in the tests (K): half of an interval of 95 %. All intervals include it.
    #[arg(long, value_name = "K", default_value_t = TEMPERATURE_UNCERTAINTY_K, value_parser = uncertainty, allow_negative_numbers = true)]
    temperature_uncertainty_k: f64,
    /// How well you know the density of the oil (kg/m3): half of an interval of 95 %. All intervals include it.
    #[arg(long, value_name = "KG_PER_M3", default_value_t = 0.0, value_parser = uncertainty, allow_negative_numbers = true)]
    density_uncertainty_kg_per_m3: f64,
    /// What the model may miss of each test's force beyond its noise, rms of rms (%); a fit that misses more is refused.
    #[arg(long, value_name = "PERCENT", default_value_t = 100.0 * MAX_MISFIT, value_parser = percent, allow_negative_numbers = true)]
    max_misfit_percent: f64,
    /// Starts of the search.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..=1000))]
    starts: u16,
    /// The step, us.
    #[arg(help = step_size::help("Step of the model", ""), long, default_value = "250", value_name = "US", allow_negative_numbers = true)]
    step_us: StepSize,
    /// The damper found, TOML, with what it was found from in its head; a file is written whole or not at all, `-` is standard output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// Page with loops before and after, HTML.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Runs the command.
///
/// # Errors
/// A damper, number or test that cannot be used, or numbers that the tests do not determine; then nothing is written.
pub fn run(arguments: &CalibrateArguments) -> Outcome<()> {
    if arguments.input.is_empty() && arguments.indices.is_empty() {
        return Err(Failure::wrong_use(
            "nothing to calibrate from: give recorded loops with --input, or a table of indices with --indices",
        ));
    }
    refuse_same_streams(arguments)?;
    let damper = Keyed::new(&arguments.damper.damper, &*arguments.damper.load()?)?;
    let given = arguments.given();
    let in_words = |error: CalibrationError| words::failure(error, &given);
    let request = numbers::request(arguments);
    request.check(&damper).map_err(in_words)?;
    let step_s = arguments.step_us.step_s();
    let bar = progress::bar(0, "reading");
    let (mut recordings, mut loops) = (Vec::new(), Vec::new());
    for path in &arguments.input {
        let (recorded, gaps) = recorded::read(path, &arguments.channels.channels())?;
        let tests = LoopTest::from_recording(&recorded, step_s).map_err(in_words)?;
        recordings.push(Recording::new(&recorded, &gaps, tests.len()));
        loops.extend(tests);
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
    let report = Report::new(arguments, &calibration, recordings, &found)?;
    let file = damper_file::text(&report, &found.damper)?;
    let page = match &arguments.page {
        Some(_) => page::write(&report, &calibration, &found)?,
        None => String::new(),
    };
    write_whole_if::<FileError>(arguments.page.as_deref(), |to_page| {
        if let Some((path, to_page)) = to_page {
            to_page
                .write_all(page.as_bytes())
                .map_err(|error| cannot_write(path, error))?;
        }
        write_bytes(&arguments.output, file.as_bytes())
    })?;
    print_report_beside(&arguments.output, arguments.format, &report, Report::print)
}

impl CalibrateArguments {
    /// What the options say of the recording and the damper, for advice.
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

/// An uncertainty, 0 or above.
fn uncertainty(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|number| (0.0..=1e3).contains(number));
    number.ok_or_else(|| "allowed: 0 to 1000".into())
}

/// A part in percent.
fn percent(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    let number = number.filter(|number| (0.1..=1e4).contains(number));
    number.ok_or_else(|| "allowed: 0.1 to 10000".into())
}

/// Refuses standard input twice, and outputs that would overwrite what is read.
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
    let read: Vec<_> = damper.into_iter().chain(inputs).chain(indices).collect();
    streams::refuse_second_standard_input(&read)?;
    streams::refuse_twice("--input", &arguments.input)?;
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
