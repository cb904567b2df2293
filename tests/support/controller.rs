//! The example controller of the C library: how to compile it, and the same run in Rust.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use dashpot_core::Damper;
use dashpot_export::{Provenance, c_header, c_source};
use xtask::c_library::{self, Platform, install};

use crate::damper;

/// Warnings of the C and C++ compilers, all of them errors.
pub const WARNINGS: [&str; 7] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Wundef",
    "-Werror",
];

/// Runs a command that must succeed and returns its output.
pub fn succeed(command: &mut Command) -> Output {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(
        output.status.success(),
        "{command:?}: {}\n{}{}",
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    output
}

/// Builds the install tree for a platform in `folder` and renames it, because a tree must work after it is moved.
pub fn tree_of(platform: &Platform, folder: &Path) -> PathBuf {
    let made = install(platform, folder).unwrap_or_else(|error| panic!("{error}"));
    let moved = folder.join("moved tree");
    std::fs::rename(made, &moved).expect("a tree that may be moved");
    moved
}

/// Exports the example's two dampers as C sources with headers to `folder`.
pub fn export(folder: &Path) -> [PathBuf; 2] {
    export_presets(["in-service", "reduced-vertical"], folder)
}

/// Exports presets as C sources with headers to `folder`.
pub fn export_presets<const N: usize>(names: [&str; N], folder: &Path) -> [PathBuf; N] {
    names.map(|name| {
        let built: Damper<f32> = damper(name, &[]).build(1e-3).expect("a preset");
        let provenance = Provenance {
            damper: name,
            step_us: 1000.0,
            command: "a test",
        };
        let name = name.replace('-', "_");
        let constant = name.to_uppercase();
        let source = c_source(&constant, &built, &provenance).expect("a name");
        let header = c_header(&constant, &built, &provenance).expect("a name");
        let file = folder.join(name).with_extension("c");
        std::fs::write(&file, source).expect("a writable folder");
        std::fs::write(file.with_extension("h"), header).expect("a writable folder");
        file
    })
}

/// Returns the command that compiles the example for `platform` in `folder`; the caller adds libraries and output.
pub fn compile(compiler: &str, platform: &str, folder: &Path) -> Command {
    let examples = c_library::folder().join("examples");
    let mut command = Command::new(compiler);
    command.arg("-std=c11").args(WARNINGS).args(["-O2", "-g"]);
    command.arg("-I").arg(folder).arg("-I").arg(&examples);
    command
        .arg(examples.join("controller.c"))
        .arg(examples.join(platform).join("main.c"))
        .args(export(folder));
    command
}

/// Like [`compile`], with the static library of a tree.
pub fn compile_with_archive(
    compiler: &str,
    platform: &str,
    folder: &Path,
    tree: &Path,
    library: &str,
) -> Command {
    let mut command = compile(compiler, platform, folder);
    command.arg("-I").arg(tree.join("include"));
    command.arg(tree.join("lib").join(library));
    command
}

/// Displacement (m) of damper `number` at `tick`, as the sensor in controller.c returns it.
fn sensor(number: u32, tick: u32) -> f32 {
    let half = 200 + 35 * number;
    let in_arc = tick % half;
    let arc = (in_arc * (half - in_arc)) as f32 * (0.012 / (half * half) as f32);
    match (number, tick) {
        (1, 2500..2520) => f32::NAN,
        (2, 4500) => 0.01,
        _ if (tick / half).is_multiple_of(2) => arc,
        _ => -arc,
    }
}

/// Expected output of the controller, computed by the core in Rust. The C controller also saves and restores states,
/// which must not change the output, so this run does not.
pub fn expected() -> String {
    let build = |name| -> Damper<f32> { damper(name, &[]).build(1e-3).expect("a preset") };
    let mut dampers = [build("in-service"), build("reduced-vertical")];
    let mut states: [_; 4] = std::array::from_fn(|i| dampers[i % 2].at_rest(sensor(i as u32, 0)));
    let mut text = String::new();
    let mut digest = 0x811c_9dc5_u32;
    for tick in 0..10_000 {
        if tick == 6000 {
            dampers[1].set_clearance_m(2.5e-3).expect("a clearance");
        }
        for (number, state) in states.iter_mut().enumerate() {
            let force = dampers[number % 2].step(state, sensor(number as u32, tick));
            for byte in force.to_le_bytes() {
                digest = (digest ^ u32::from(byte)).wrapping_mul(0x0100_0193);
            }
        }
        if (tick + 1) % 2000 == 0 {
            for (number, state) in states.iter_mut().enumerate() {
                let (status, rejected) = (state.status().bits(), state.rejected_inputs());
                writeln!(
                    text,
                    "tick {:08x} damper {number:08x} status {status:08x} rejected {rejected:08x}",
                    tick + 1
                )
                .expect("a String takes all");
                state.clear_status();
            }
        }
    }
    writeln!(text, "forces {digest:08x}").expect("a String takes all");
    text
}

/// Asserts that a run of the controller printed [`expected`].
pub fn assert_same_run(output: &Output, where_run: &str) {
    let found = String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n");
    assert_eq!(found, expected(), "{where_run} differs from Rust");
}
