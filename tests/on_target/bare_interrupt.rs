//! The images that step a bank in the SysTick interrupt, in C (`firmware/c`) and Rust (`firmware/src/bin/bare`): under
//! QEMU they print the hash of the forces that the core computes here. For the NUCLEO-H753ZI they are linked.

use std::path::{Path, PathBuf};
use std::process::Command;

use dashpot::controller::{export_presets, succeed, tree_of};
use dashpot::in_turn::images;
use dashpot::target::Emulator;
use dashpot::{damper, document, standalone};
use dashpot_core::{Damper, Status};
use object::{Object, ObjectSection};
use xtask::c_library::Platform;
use xtask::processor::CORTEX_M7;
use xtask::target_toolchain::TargetToolchain;
use xtask::tools::{ARM_GCC, ARM_LIBC, CMAKE, MAKE, QEMU, have, have_target};

const DAMPERS: usize = 12;
const KINDS: [&str; 3] = ["in-service", "reduced-vertical", "reduced-lateral"];
/// Ticks between two lines.
const REPORT_EVERY: u32 = 100;
/// Number of lines that are compared. The failed sensor is back before the last one.
const LINES: u32 = 7;

fn dampers() -> [Damper<f32>; KINDS.len()] {
    KINDS.map(|name| damper(name, &[]).build(1e-3).expect("a preset"))
}

/// Displacement (m) of damper `number`, as the images make it.
fn displacement_m(number: usize, tick: u32) -> f32 {
    if number == 1 && (500..550).contains(&(tick % 1000)) {
        return f32::NAN;
    }
    let half = 200 + 35 * number as u32;
    let in_arc = tick % half;
    let arc = (in_arc * (half - in_arc)) as f32 * (0.012 / (half * half) as f32);
    if (tick / half).is_multiple_of(2) {
        arc
    } else {
        -arc
    }
}

/// Lines that an image prints, without the number of cycles.
fn expected() -> Vec<String> {
    let dampers = dampers();
    let kind = |number: usize| &dampers[number / 4];
    let mut states: [_; DAMPERS] =
        std::array::from_fn(|number| kind(number).at_rest(displacement_m(number, 0)));
    let mut lines = vec!["start".to_owned()];
    let mut hash = 0x811c_9dc5_u32;
    let (mut status, mut rejected) = (Status::empty(), 0);
    let mut bad_ticks = [0; DAMPERS];
    for tick in 1..=LINES * REPORT_EVERY {
        let mut forces_n = [0.0; DAMPERS];
        for (number, state) in states.iter_mut().enumerate() {
            let force_n = kind(number).step(state, displacement_m(number, tick));
            let is_bad = state
                .status()
                .intersects(Status::INPUT_HELD | Status::RESTARTED);
            status |= state.status();
            state.clear_status();
            rejected += u32::from(is_bad);
            bad_ticks[number] = if is_bad { bad_ticks[number] + 1 } else { 0 };
            forces_n[number] = if bad_ticks[number] > 20 { 0.0 } else { force_n };
            hash = (hash ^ forces_n[number].to_bits()).wrapping_mul(0x0100_0193);
        }
        if tick % REPORT_EVERY == 0 {
            let forces_n = forces_n.map(|force_n| (force_n as i32).to_string());
            lines.push(format!(
                "tick {tick} hash {hash:08x} status {} rejected {rejected} late 0 forces {}",
                status.bits(),
                forces_n.join(" ")
            ));
            (status, rejected) = (Status::empty(), 0);
        }
    }
    lines
}

/// Lines that an image prints under QEMU, without the numbers of cycles, which must be plausible. Virtual time does not
/// wait for the real clock.
fn printed(image: &Path, count: u32) -> Vec<String> {
    let virtual_time = ["-icount", "shift=0,sleep=off"];
    let mut emulator = Emulator::start_with(image, &CORTEX_M7, &virtual_time);
    let lines = (0..count).map(|_| emulator.line().trim_end().to_owned());
    let without_cycles = |line: String| match line.split_once(" cycles ") {
        Some((before, after)) => {
            let (cycles, forces) = after.split_once(' ').expect("forces");
            let cycles: u32 = cycles.parse().expect("a number");
            // A cycle is 40 ns and a tick 1 ms; 12 dampers take more than 600 instructions of 1 ns.
            assert!((15..25_000).contains(&cycles), "{line}");
            format!("{before} {forces}")
        }
        None => line,
    };
    lines.map(without_cycles).collect()
}

/// Asserts that an image prints what the core computes.
fn assert_same_run(image: &Path) {
    let printed = printed(image, LINES + 1);
    assert_eq!(printed, expected(), "{}", image.display());
}

/// Asserts that code is in the flash of the NUCLEO-H753ZI, data in one of its memories, and the stack in the DTCM.
fn assert_is_for_nucleo(image: &Path, vectors: &str, data: std::ops::Range<u64>) {
    let bytes = std::fs::read(image).expect("an image");
    let file = object::File::parse(&*bytes).expect("an ELF file");
    let section = |name| file.section_by_name(name).expect("a section");
    let vectors = section(vectors);
    assert_eq!(vectors.address(), 0x0800_0000);
    let words = vectors.data().expect("bytes").as_chunks::<4>().0;
    let [stack, reset] = [0, 1].map(|at| u64::from(u32::from_le_bytes(words[at])));
    let dtcm = 0x2000_0000..=0x2002_0000;
    assert!(dtcm.contains(&stack) && stack % 8 == 0, "{stack:x}");
    let text = section(".text");
    let code = text.address()..text.address() + text.size();
    assert!(reset % 2 == 1 && code.contains(&reset), "{reset:x}");
    let bss = section(".bss");
    assert!(data.contains(&bss.address()) && data.contains(&(bss.address() + bss.size())));
}

#[test]
fn rust_prints_the_cores_forces() {
    let Some(images) = images() else {
        return;
    };
    assert_same_run(&images.join("bare"));
    let toolchain = TargetToolchain::find(CORTEX_M7.target).expect("the images are built");
    let images = xtask::firmware::build_for_nucleo(&toolchain);
    let images = images.unwrap_or_else(|error| panic!("{error}"));
    for image in ["bare", "dashpot-firmware"] {
        let axi_sram = 0x2400_0000..0x2408_0000;
        assert_is_for_nucleo(&images.join(image), ".vector_table", axi_sram);
    }
}

/// Configures and builds `firmware/c` in a folder of dampers, and returns the image.
fn build_c(dampers: &Path, board: &str, options: &[String]) -> PathBuf {
    let source = document::in_repository("firmware/c");
    let build = dampers.join(board);
    let mut configure = Command::new(CMAKE.program);
    configure.arg("-S").arg(&source).arg("-B").arg(&build);
    configure.args(["-G", "Unix Makefiles"]).args(options);
    configure.arg(format!("-DBOARD={board}"));
    configure.arg(format!("-DDAMPERS={}", dampers.display()));
    configure.arg("-DCMAKE_COMPILE_WARNING_AS_ERROR=ON");
    succeed(&mut configure);
    succeed(Command::new(CMAKE.program).arg("--build").arg(&build));
    build.join("rig.elf")
}

#[test]
fn portable_c_prints_the_cores_forces_and_its_watchdog_resets_the_board() {
    let what = "a bank in an interrupt in portable C";
    if !have(&[CMAKE, MAKE, ARM_GCC, ARM_LIBC, QEMU], what) {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    for (name, damper) in KINDS.iter().zip(&dampers()) {
        standalone::export(folder, &name.replace('-', "_"), damper);
    }
    let dtcm = 0x2000_2000..0x2002_0000;
    assert_is_for_nucleo(&build_c(folder, "nucleo-h753zi", &[]), ".text", dtcm);
    assert_same_run(&build_c(folder, "mps2-an500", &[]));

    // A sensor that never answers.
    let stuck = folder.join("stuck.c");
    let text = document::read("firmware/c/rig.c");
    let reading = "    for (uint32_t i = 0; i < DAMPERS; i++) {\n        const uint32_t half";
    assert!(text.contains(reading));
    let text = text.replace(
        reading,
        &format!("    while (tick == 150U) {{}}\n{reading}"),
    );
    std::fs::write(&stuck, text).expect("a writable folder");
    let rig = format!("-DRIG={}", stuck.display());
    let printed = printed(&build_c(folder, "mps2-an500", &[rig]), 4);
    assert_eq!(printed[0], "start");
    assert_eq!(printed[2], "reset by the watchdog", "{printed:?}");
    assert_eq!(printed[1], printed[3], "it starts again");
}

#[test]
fn the_c_library_prints_the_cores_forces() {
    let what = "a bank in an interrupt with the C library";
    if have_target(CORTEX_M7.target, what).is_none()
        || !have(&[CMAKE, MAKE, ARM_GCC, ARM_LIBC, QEMU], what)
    {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    export_presets(KINDS, folder);
    let tree = tree_of(&Platform::Bare(CORTEX_M7), folder);
    let tree = format!("-DCMAKE_PREFIX_PATH={}", tree.display());
    assert_same_run(&build_c(
        folder,
        "mps2-an500",
        &["-DLIBRARY=ON".into(), tree],
    ));
}
