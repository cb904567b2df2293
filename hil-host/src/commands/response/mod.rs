//! `dashpot response`: computes dynamic stiffness and loss angle over frequency and amplitude.

mod family;
mod page;
mod report;
mod rows;

use std::path::{Path, PathBuf};

use family::Family;
use report::Report;

use super::{DamperArguments, Format, print_report_beside, progress, streams};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::harmonic::MAX_FREQUENCY_HZ;
use dashpot_files::input::is_standard_stream;
use dashpot_files::output::{cannot_write, write_whole_if};
use dashpot_testbench::response::frequencies;

/// Compute dynamic stiffness, loss angle and damping over frequency and amplitude; also for the linearised damper.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot response --damper in-service --amplitude-m 0.6e-3,1e-3,5e-3 --output response.csv --page response.html
  dashpot response --damper in-service --swept --octaves-per-minute 0.5 --format json

Amplitude-frequency characteristics of the paper, Figs. 13b and 18b:
  dashpot response --damper reduced-vertical --over mount.stiffness_n_per_m=2e6,6e6,10e6 --amplitude-m 2e-3 \\
      --page fig13b.html
  dashpot response --damper reduced-lateral --over mount.clearance_m=0.5e-3,1e-3,2e-3 --amplitude-m 5e-3 \\
      --page fig18b.html

For x = A sin wt, the first harmonic of the force is A (K' sin wt + K\" cos wt). Dynamic stiffness is its magnitude
divided by A; the loss angle is the phase by which it leads the displacement (0 for a spring, 90 degrees for a
dashpot); damping is K\"/w. Harmonic values come from the periodic force at one frequency after the other. Linearised
values apply to a peak velocity of 0.1 mm/s with the clearance taken up. Swept values come from one motion through all
frequencies, demodulated with a Bartlett window of 2 cycles around each frequency, and are compared with the harmonic
values.

Columns of --output: response (harmonic, linearised or swept), the parameter of --over, amplitude_m, frequency_hz,
dynamic_stiffness_n_per_m, loss_angle_deg, storage_n_per_m (K'), loss_n_per_m (K\"), damping_n_s_per_m, difference
(between swept and harmonic stiffness, divided by the harmonic stiffness)."
)]
pub struct ResponseArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Damper parameter and its values to compare: table.key=value,value.
    #[arg(long, value_name = "KEY=VALUE,..")]
    over: Option<Family>,
    /// Amplitudes of the motion, m.
    #[arg(
        long,
        value_name = "M,..",
        value_delimiter = ',',
        default_value = "1e-3,2e-3,5e-3"
    )]
    amplitude_m: Vec<f64>,
    /// First frequency, Hz.
    #[arg(long, default_value_t = 0.1, value_name = "HZ")]
    from_hz: f64,
    /// Last frequency, Hz.
    #[arg(long, default_value_t = 20.0, value_name = "HZ")]
    to_hz: f64,
    /// Number of frequencies; the ratio between neighbours is constant.
    #[arg(long, default_value_t = 41, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=10_000))]
    points: u16,
    /// Also run a sweep through the frequencies.
    #[arg(long)]
    swept: bool,
    /// Sweep rate, octaves per minute.
    #[arg(
        long,
        default_value_t = 1.0,
        value_name = "OCTAVES",
        requires = "swept"
    )]
    octaves_per_minute: f64,
    /// Write all values as CSV; `-` for standard output.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Page, a self-contained HTML file; `-` for standard output.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Runs the command.
///
/// # Errors
/// The damper, the motion or a file is invalid, or the force does not become periodic.
pub fn run(arguments: &ResponseArguments) -> Outcome<()> {
    arguments.check_files()?;
    let dampers = family::dampers(arguments)?;
    let frequencies_hz = arguments.frequencies_hz()?;
    // Open both files before the run, so that an unwritable file is reported early.
    let report = write_whole_if::<_, Failure>(arguments.page.as_deref(), |page| {
        let report = write_whole_if::<_, Failure>(arguments.output.as_deref(), |file| {
            let bar = progress::bar(0, "responses");
            let report = Report::new(arguments, &dampers, &frequencies_hz)?;
            bar.finish_and_clear();
            if let Some((path, file)) = file {
                rows::write(path, file, &report)?;
            }
            Ok(report)
        })?;
        if let Some((path, page)) = page {
            page.write_all(page::write(&report)?.as_bytes())
                .map_err(|error| cannot_write(path, error))?;
        }
        Ok(report)
    })?;
    let data = arguments.files().find(|path| is_standard_stream(path));
    print_report_beside(
        data.unwrap_or(Path::new("")),
        arguments.format,
        &report,
        Report::print,
    )
}

impl ResponseArguments {
    /// Returns the output files.
    fn files(&self) -> impl Iterator<Item = &Path> {
        [&self.output, &self.page]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path)
    }

    fn check_files(&self) -> Outcome<()> {
        let damper = Path::new(&self.damper.damper);
        for (option, path) in [("--output", &self.output), ("--page", &self.page)] {
            if let Some(path) = path {
                streams::refuse_input(option, path, damper)?;
            }
        }
        streams::refuse_same_output(&[
            ("--output", self.output.as_deref()),
            ("--page", self.page.as_deref()),
        ])
    }

    fn frequencies_hz(&self) -> Outcome<Vec<f64>> {
        let Self { from_hz, to_hz, .. } = *self;
        let is_within = |hz: f64| hz > 0.0 && hz <= MAX_FREQUENCY_HZ;
        for (option, hz) in [("--from-hz", from_hz), ("--to-hz", to_hz)] {
            if !is_within(hz) {
                return Err(Failure::wrong_use(format!(
                    "{option}: {hz}, allowed: above 0 and at most {MAX_FREQUENCY_HZ} Hz"
                )));
            }
        }
        if from_hz >= to_hz {
            return Err(Failure::wrong_use(format!(
                "--to-hz: {to_hz}, allowed: above --from-hz, {from_hz} Hz"
            )));
        }
        Ok(frequencies(from_hz, to_hz, usize::from(self.points)))
    }
}
