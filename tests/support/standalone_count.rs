//! Counts the instructions of a step in C without a library on emulated processors, and compares its forces with the
//! core's.

use std::fmt::Write;
use std::process::Command;

use dashpot_core::Damper;
use dashpot_testbench::excitation::Excitation;
use xtask::c_library;
use xtask::processor::Processor;
use xtask::tools::{ARM_GCC, QEMU};

use crate::budget::Figures;
use crate::controller::{WARNINGS, succeed};
use crate::damper;
use crate::standalone::export;

/// Program that counts instructions and prints a name and a hexadecimal number per line.
const COUNT: &str = include_str!("standalone/count.c");

/// Step (s).
const STEP_S: f64 = 1e-3;

/// Samples of each motion.
const SAMPLES: usize = 2000;

/// Time of an instruction under `-icount shift=10` (s).
const INSTRUCTION_S: f64 = 1024e-9;

/// Instructions of a step of the in-service damper, by situation.
///
/// # Panics
/// The image does not compile or run, or a force differs from the core's.
pub fn standalone_figures(processor: &Processor) -> Figures {
    let built: Damper<f32> = damper("in-service", &[]).build(STEP_S).expect("a preset");
    let motions = Excitation::ALL.map(|excitation| -> Vec<f32> {
        let all = excitation.displacements_m(STEP_S).into_iter();
        all.map(|x| x as f32).cycle().take(SAMPLES).collect()
    });
    let printed = run(processor, &built, &motions);
    let number = |name: &str| {
        let found = printed.iter().find(|(found, _)| found == name);
        found
            .unwrap_or_else(|| panic!("no {name} in {printed:?}"))
            .1
    };
    let title = processor.title;
    assert_eq!(
        number("digest"),
        digest(&built, &motions),
        "{title}: the force bits differ"
    );
    assert_eq!(
        number("kept"),
        1,
        "{title}: the digest of C without a library"
    );
    let ticks_per_instruction = INSTRUCTION_S * f64::from(number("clock_hz"));
    let instructions = |name: &str| {
        // The subtracted `call` is the time of calling a function of one instruction.
        let ticks = f64::from(number(name)) - f64::from(number("call"));
        (ticks / ticks_per_instruction).round() + 1.0
    };
    assert_eq!(
        instructions("known"),
        101.0,
        "{title}: the count of a known function"
    );
    let rows = [
        ("least", "least"),
        ("most", "most"),
        ("first_step", "first"),
        ("held_input", "held"),
        ("limited_input", "limited"),
        ("swapped_damper", "swapped"),
    ];
    let figure = |(name, printed)| {
        (
            format!("standalone_{name}_instructions"),
            instructions(printed),
        )
    };
    rows.map(figure).into()
}

/// Output of the image for a processor.
fn run(processor: &Processor, built: &Damper<f32>, motions: &[Vec<f32>]) -> Vec<(String, u32)> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let source = export(folder, "damper", built);
    let mut motion = format!(
        "enum {{ MOTIONS = {}, SAMPLES = {SAMPLES} }};\nstatic const float motions_m[MOTIONS][SAMPLES] = {{\n",
        motions.len()
    );
    for displacements in motions {
        let numbers: Vec<String> = displacements.iter().map(|x| format!("{x:e}F")).collect();
        writeln!(motion, "{{{}}},", numbers.join(", ")).expect("text grows");
    }
    std::fs::write(folder.join("motion.h"), motion + "};\n").expect("a writable folder");
    std::fs::write(folder.join("count.c"), COUNT).expect("a writable folder");
    let image = folder.join("count.elf");
    let mut compiler = Command::new(ARM_GCC.program);
    // GNU C uses fused multiply-add unless the source forbids it.
    compiler.args(["-std=gnu11", "-O2", "-ffreestanding", "-nostdlib"]);
    compiler
        .args(processor.gcc)
        .args(WARNINGS)
        .arg("-Wl,--fatal-warnings,-z,noexecstack");
    compiler
        .arg("-L")
        .arg(c_library::folder().join("examples/cortex-m"));
    compiler.arg("-T").arg(format!("{}.ld", processor.board));
    succeed(
        compiler
            .arg(source)
            .arg(folder.join("count.c"))
            .args(["-lgcc", "-o"])
            .arg(&image),
    );
    let mut qemu = Command::new(QEMU.program);
    qemu.args(["-M", processor.board, "-cpu", processor.emulated_cpu]);
    qemu.args(["-display", "none", "-monitor", "none", "-serial", "none"]);
    qemu.args(["-icount", "shift=10,sleep=off"]);
    qemu.args([
        "-semihosting-config",
        "enable=on,target=native,chardev=text",
    ]);
    qemu.args(["-chardev", "stdio,id=text", "-kernel"])
        .arg(&image);
    let text = String::from_utf8_lossy(&succeed(&mut qemu).stdout).into_owned();
    let line = |line: &str| {
        let (name, value) = line.split_once(' ')?;
        Some((name.to_owned(), u32::from_str_radix(value.trim(), 16).ok()?))
    };
    let lines = text
        .lines()
        .map(|text| line(text).unwrap_or_else(|| panic!("{text}")));
    lines.collect()
}

/// Hash of the core's forces over the same steps as in the image.
fn digest(built: &Damper<f32>, motions: &[Vec<f32>]) -> u32 {
    let mut damper = *built;
    let mut forces = Vec::new();
    for displacements in motions {
        let mut state = damper.at_rest(displacements[0]);
        forces.extend(displacements.iter().map(|x| damper.step(&mut state, *x)));
    }
    let mut state = damper.at_rest(0.0);
    forces.extend([1.5e-3, f32::NAN, 10e-3].map(|x| damper.step(&mut state, x)));
    damper.set_clearance_m(2e-3).expect("a clearance");
    forces.push(damper.step(&mut state, 2.5e-3));
    let bytes = forces.iter().flat_map(|force| force.to_le_bytes());
    bytes.fold(0x811c_9dc5, |hash: u32, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    })
}
