//! Prints the digests of the model's results on this processor: `dashpot-physics STUDY`.

use std::process::ExitCode;

use dashpot_physics::{Results, Runs, study};

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage error: dashpot-physics STUDY");
        return ExitCode::from(2);
    };
    let results = Results::new(&Runs::of(&study(&path)));
    print!("{}", results.text());
    ExitCode::SUCCESS
}
