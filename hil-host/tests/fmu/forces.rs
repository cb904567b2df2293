//! Forces of an FMU equal those of a replay bit for bit, with or without a delay of one communication step.

use std::fmt::Write;
use std::fs;
use std::process::Command;

use xtask::tools::{CLANG, GCC, VALGRIND, have};

use crate::common::dashpot;
use crate::driver::{Driver, hexadecimal};
use crate::{Unpacked, bits, displacements_m, forces_n, source};

fn lines(displacements_m: &[f64]) -> String {
    displacements_m.iter().fold(String::new(), |mut text, x| {
        writeln!(text, "{x:e}").unwrap();
        text
    })
}

#[test]
fn forces_have_the_bits_of_a_replay() {
    for (fmi, scalar) in [("2", "f32"), ("3", "f32"), ("3", "f64"), ("2", "f64")] {
        let fmu = Unpacked::new(fmi, &["--scalar", scalar]);
        let x = displacements_m();
        let rows = x
            .iter()
            .enumerate()
            .map(|(tick, x)| format!("{},{x:e}\n", tick as f64 / 1e3));
        let recording = format!("time_s,displacement_m\n{}", rows.collect::<String>());
        fs::write(fmu.path("run.csv"), recording).unwrap();
        let replay = [
            "replay",
            "--damper",
            "in-service",
            "--scalar",
            scalar,
            "--input",
            "run.csv",
            "--output",
            "force.csv",
        ];
        dashpot(&replay, fmu.folder.path()).success();
        let replayed = fs::read_to_string(fmu.path("force.csv")).unwrap();
        let replayed = replayed
            .lines()
            .skip(1)
            .map(|row| row.rsplit(',').next().unwrap());
        let replayed: Vec<f64> = match scalar {
            "f32" => replayed
                .map(|force| f64::from(force.parse::<f32>().unwrap()))
                .collect(),
            _ => replayed.map(|force| force.parse().unwrap()).collect(),
        };
        let text = Driver::new(fmi).run(&fmu, &["run", "1"], &lines(&x));
        assert_eq!(
            bits(&hexadecimal(&text)),
            bits(&replayed),
            "FMI {fmi} {scalar}"
        );
        assert!(text.contains("followed at the largest rate"));
    }
}

/// Between communication points, the displacement is interpolated linearly.
#[test]
fn internal_steps_go_straight_to_the_displacement() {
    let x: Vec<f64> = displacements_m()
        .into_iter()
        .take(2400)
        .step_by(5)
        .collect();
    let within = x.iter().enumerate().flat_map(|(number, to)| {
        let from = x[number.saturating_sub(1)];
        (1..=5).map(move |step| match step {
            5 => *to,
            step => from + (to - from) * (f64::from(step) / 5.0),
        })
    });
    let within: Vec<f64> = [x[0]].into_iter().chain(within).collect();
    let forces: Vec<f64> = forces_n("in-service", &within)
        .into_iter()
        .skip(1)
        .collect();
    let at_ends: Vec<f64> = forces.into_iter().skip(4).step_by(5).collect();
    let text = Driver::new("3").run(&Unpacked::new("3", &[]), &["run", "5"], &lines(&x));
    assert_eq!(bits(&hexadecimal(&text)), bits(&at_ends));
}

/// If the velocity is given, the displacement at the end of the step is known, so the force is not delayed.
#[test]
fn with_the_velocity_the_force_is_not_late() {
    let wave = |t: f64| 5e-3 * (10.0 * t).sin();
    let exact: Vec<f64> = (0..=2000)
        .map(|tick| wave(1e-3 * f64::from(tick)))
        .collect();
    let exact = forces_n("in-service", &exact);
    let largest = exact
        .iter()
        .fold(0.0_f64, |most, force| most.max(force.abs()));
    for fmi in ["2", "3"] {
        let fmu = Unpacked::new(fmi, &[]);
        let driver = Driver::new(fmi);
        for steps in [1, 4] {
            let at_ends: Vec<f64> = exact.iter().copied().skip(steps).step_by(steps).collect();
            let error = |forces: Vec<f64>| {
                let pairs = forces.iter().zip(&at_ends);
                let max = pairs.fold(0.0_f64, |max, (force, exact)| {
                    max.max((force - exact).abs())
                });
                max / largest
            };
            let count = steps.to_string();
            let with = error(hexadecimal(&driver.run(&fmu, &["rate", &count], "")));
            let x: Vec<f64> = (0..2000 / steps)
                .map(|number| wave(1e-3 * (number * steps) as f64))
                .collect();
            let without = error(hexadecimal(&driver.run(&fmu, &["run", &count], &lines(&x))));
            let row = format!(
                "| {steps} ms | {:.1} % | {:.3} % |",
                1e2 * without,
                1e2 * with
            );
            let page = fs::read_to_string(source("../docs/fmu.md")).unwrap();
            assert!(page.contains(&row), "docs/fmu.md has not {row}");
            assert!(with < 0.2 * without, "{with} {without}");
        }
    }
}

#[test]
fn saved_states_are_restored_to_the_bit() {
    for fmi in ["2", "3"] {
        let text = Driver::new(fmi).run(&Unpacked::new(fmi, &[]), &["states"], "");
        let printed: Vec<&str> = text
            .lines()
            .filter(|line| !line.starts_with("log "))
            .collect();
        let expected = [
            "put back: equal, clearance 0.0020 m",
            "short memory: 2",
            "freed: 1",
            "of bytes, after a reset: equal",
            "damaged: 2",
            "short: 2",
            "no state: 2",
            "then: equal",
        ];
        assert_eq!(printed, expected, "FMI {fmi}");
    }
}

/// Each damper of a bank behaves as if it were alone.
#[test]
fn dampers_of_a_bank_are_independent() {
    let fmu = Unpacked::new("3", &["--also", "reduced-lateral", "--also", "in-service"]);
    for name in [
        "damper[1].displacement_m",
        "damper[2].force_n",
        "damper[3].clearance_m",
    ] {
        assert!(fmu.description.contains(name), "{name}");
    }
    let x = displacements_m();
    let text = Driver::new("3").run(&fmu, &["run", "1"], &lines(&x));
    assert_eq!(bits(&hexadecimal(&text)), bits(&forces_n("in-service", &x)));
}

/// Time is counted in steps, so rounding when an importer adds up times does not matter.
#[test]
fn rounding_of_summed_times_does_not_matter() {
    let text = Driver::new("2").run(&Unpacked::new("2", &[]), &["added", "10000000"], "");
    assert!(
        text.ends_with(", time 10000 s\n") && !text.starts_with("10000 s"),
        "{text}"
    );
}

/// No memory is lost when instances and states are created and freed.
#[test]
fn no_memory_is_lost_or_misused() {
    if !have(&[VALGRIND], "memory of FMUs") {
        return;
    }
    for (fmi, more, steps) in [
        ("2", &["--loadable", "--also", "paper"][..], "100000"),
        ("3", &[][..], "1000000"),
    ] {
        let fmu = Unpacked::new(fmi, more);
        let driver = Driver::new(fmi);
        let valgrind = [
            "valgrind",
            "--quiet",
            "--leak-check=full",
            "--errors-for-leak-kinds=all",
            "--error-exitcode=9",
        ];
        let output = driver.output(&valgrind, &fmu, fmu.token(), &["many", steps], "");
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
}

/// The sources compile without warnings at high warning levels, and the sanitizers report nothing.
#[test]
fn the_sources_are_clean() {
    if !have(&[GCC, CLANG], "the sources of FMUs by other compilers") {
        return;
    }
    for (fmi, scalar, more) in [("2", "f32", &[][..]), ("3", "f64", &["--loadable"][..])] {
        let fmu = Unpacked::new(
            fmi,
            &[&["--scalar", scalar, "--sources-only"], more].concat(),
        );
        let sources = fs::read_dir(fmu.path("sources")).unwrap();
        let names = sources.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let compiled: Vec<String> = names.filter(|name| name.ends_with(".c")).collect();
        for compiler in ["gcc", "clang"] {
            let mut command = Command::new(compiler);
            command
                .args([
                    "-std=c99",
                    "-Wall",
                    "-Wextra",
                    "-Wconversion",
                    "-pedantic",
                    "-Werror",
                    "-O2",
                    "-fPIC",
                    "-shared",
                ])
                .args(["-fsanitize=undefined", "-o", "library.so"])
                .arg("-I")
                .arg(source("../export/src/fmu/headers"))
                .args(&compiled)
                .current_dir(fmu.path("sources"));
            let output = command.output().unwrap();
            assert!(
                output.status.success(),
                "{compiler}: {}",
                String::from_utf8_lossy(&output.stderr)
            );
        }
    }
}
