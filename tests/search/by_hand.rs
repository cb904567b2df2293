//! `cargo xtask search`: tries a number of motions, finds the one that comes closest to the accuracy promise or breaks
//! it, and writes it as files that `dashpot verify` reads.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use dashpot::search::{Case, search};
use dashpot_files::damper;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [evaluations, seed, folder] = &arguments[..] else {
        return Err("three arguments: evaluations, seed, folder for the worst case".into());
    };
    let found = search(evaluations.parse()?, seed.parse()?, |case| {
        println!("{}", case.line());
    });
    println!(
        "{} motions of {} dampers; {} dampers without a reference",
        found.evaluations,
        found.dampers,
        found.unsolved.len()
    );
    for reason in found.unsolved.iter().take(10) {
        println!("  {reason}");
    }
    let Some(worst) = found.cases.first() else {
        return Err("no motion was tried".into());
    };
    println!("the worst: {}", worst.line());
    write(worst, Path::new(folder))?;
    if worst.ratio() <= 1.0 {
        Ok(())
    } else {
        Err("the promise of docs/numerics.md is broken".into())
    }
}

fn write(case: &Case, folder: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    let (toml, csv) = (folder.join("worst.toml"), folder.join("worst.csv"));
    std::fs::write(&toml, damper::text(&case.damper)?)?;
    let mut text = String::from("time_s,displacement_m\n");
    for (tick, x) in case.motion.displacements_m.iter().enumerate() {
        writeln!(text, "{},{x}", tick as f64 * case.step_s)?;
    }
    std::fs::write(&csv, text)?;
    println!(
        "to see it: dashpot verify --damper {toml} --input {csv} --step-us {us}\n\
         against:   dashpot verify --damper {toml} --step-us {us}",
        toml = toml.display(),
        csv = csv.display(),
        us = case.step_s * 1e6
    );
    Ok(())
}
