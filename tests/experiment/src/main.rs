//! Prints the digest of an experiment's forces: `dashpot-experiment FILE`.

use std::process::ExitCode;

use dashpot_core::{Damper, step_bank};
use dashpot_experiment::Experiment;

fn main() -> ExitCode {
    match std::env::args_os().nth(1) {
        Some(path) => match run(path.as_ref()) {
            Ok(digest) => {
                println!("{digest:016x}");
                ExitCode::SUCCESS
            }
            Err(reason) => {
                eprintln!("error: {}: {reason}", path.display());
                ExitCode::FAILURE
            }
        },
        None => {
            eprintln!("usage error: dashpot-experiment FILE");
            ExitCode::from(2)
        }
    }
}

fn run(path: &std::path::Path) -> Result<u64, String> {
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let experiment = Experiment::parse(&bytes).ok_or("not an experiment, or truncated")?;
    let damper = Damper::<f32>::from_image(experiment.damper).map_err(|error| error.to_string())?;
    let digest = experiment.run(&damper, |damper, state, x| damper.step(state, x), step_bank);
    Ok(digest.value())
}
