//! Dampers that an FMU steps together have the states of the core, step by step, whatever the input.

use std::fmt::Write;
use std::fs;
use std::process::Command;

use dashpot_core::{Damper, DamperState, Real};
use dashpot_files::damper;
use xtask::tools::{CLANG, GCC, Tool, have};

use crate::{Unpacked, source};

/// Two groups of eight and three that are left over; each preset is in each lane of some group.
const NAMES: [&str; 19] = {
    let presets = [
        "in-service",
        "paper",
        "reduced-lateral",
        "reduced-vertical",
        "calibrated",
    ];
    let mut names = [presets[0]; 19];
    let mut index = 0;
    while index < names.len() {
        names[index] = presets[index % presets.len()];
        index += 1;
    }
    names
};
const TICKS: usize = 4000;

/// The options of FMUs, more optimisation with fused operations, and none.
const OPTIONS: [&[&str]; 3] = [
    &["-std=c99", "-O2"],
    &["-std=gnu11", "-O3", "-march=native", "-ffp-contract=fast"],
    &["-std=c11", "-O0"],
];

/// Displacement (m) at a tick: slow and fast motion, yielding, jumps, far away, and numbers that are none.
fn displacement_m(tick: usize, lane: usize) -> f64 {
    let (t, number) = (1e-3 * tick as f64, lane as f64);
    let slow = 2e-3 * number * (5.0 + number) * t;
    match (tick % 251, tick % 19 == lane) {
        (100, true) => f64::NAN,
        (150, true) => -f64::INFINITY,
        (200, true) => 0.02 * number,
        (230, true) => 1e30,
        _ => 5e-3 * slow.sin() + 4e-4 * (300.0 * t + number).sin() + f64::from(tick > 3000) * 0.3,
    }
}

/// Every state of every damper as bytes, in hexadecimal.
fn expected<T: Real>(bytes: impl Fn(&DamperState<T>) -> Vec<u8>) -> String {
    let dampers = NAMES.map(|name| -> Damper<T> {
        let parameters = damper::load(name, &[]).unwrap();
        parameters.build(1e-3).unwrap()
    });
    let mut states: [_; 19] = std::array::from_fn(|lane| dampers[lane].at_rest(T::ZERO));
    let mut text = String::new();
    for tick in 0..TICKS {
        for (lane, (damper, state)) in dampers.iter().zip(&mut states).enumerate() {
            damper.step(state, T::from_f64(displacement_m(tick, lane)));
            for byte in bytes(state) {
                write!(text, "{byte:02x}").unwrap();
            }
            text.push('\n');
        }
    }
    text
}

fn stepped_by(fmu: &Unpacked, (tool, options): (Tool, &[&str])) -> String {
    let mut input = Vec::new();
    for tick in 0..TICKS {
        for lane in 0..NAMES.len() {
            input.extend(displacement_m(tick, lane).to_le_bytes());
        }
    }
    fs::write(fmu.path("input"), input).unwrap();
    let mut compiler = Command::new(tool.program);
    compiler
        .args(options)
        .args(["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"])
        .arg("-I")
        .arg(fmu.path("sources"))
        .arg(source("tests/fmu/bank.c"))
        .arg(fmu.path("sources/dampers.c"))
        .args(["-lm", "-o", "bank"])
        .current_dir(fmu.folder.path());
    let output = compiler.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{options:?}: {errors}");
    let program = Command::new(fmu.path("bank"))
        .arg("input")
        .current_dir(fmu.folder.path())
        .output()
        .unwrap();
    assert!(program.status.success(), "{options:?}");
    String::from_utf8(program.stdout).unwrap()
}

#[test]
fn dampers_stepped_together_have_the_states_of_the_core() {
    if !have(&[GCC, CLANG], "banks of FMUs by other compilers") {
        return;
    }
    let also = NAMES[1..].iter().flat_map(|name| ["--also", name]);
    let also: Vec<&str> = also.collect();
    let single = expected::<f32>(|state| state.to_bytes().to_vec());
    let double = expected::<f64>(|state| state.to_bytes().to_vec());
    for (scalar, expected) in [("f32", single), ("f64", double)] {
        let options = [
            &["--scalar", scalar, "--sources-only", "--name", "it"],
            &also[..],
        ]
        .concat();
        let fmu = Unpacked::new("3", &options);
        for tool in [GCC, CLANG] {
            for options in OPTIONS {
                let stepped = stepped_by(&fmu, (tool, options));
                let differing = stepped.lines().zip(expected.lines());
                let first = differing.enumerate().find(|(_, (ours, core))| ours != core);
                assert_eq!(first, None, "{scalar}, {} {options:?}", tool.program);
                assert_eq!(stepped.len(), expected.len());
            }
        }
    }
}
