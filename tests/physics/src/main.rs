//! Prints the digest of the model's results on this processor: `dashpot-physics STUDY`.

use std::process::ExitCode;

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage error: dashpot-physics STUDY");
        return ExitCode::from(2);
    };
    println!(
        "{}",
        dashpot_physics::digest(&dashpot_physics::study(&path))
    );
    ExitCode::SUCCESS
}
