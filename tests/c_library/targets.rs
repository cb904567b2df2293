//! Compares the example controller in C, on processors without an operating system under QEMU, with the same run in
//! Rust. Also checks the contents of the image.

use std::path::{Path, PathBuf};
use std::process::Command;

use dashpot::controller::{assert_same_run, compile_with_archive, succeed, tree_of};
use xtask::c_library::{self, Platform};
use xtask::processor::{CORTEX_M4F, CORTEX_M7, CORTEX_M33, Processor};
use xtask::tools::{ARM_GCC, ARM_LIBC, ARM_OBJDUMP, QEMU, have, have_target};

/// The image for a processor; `None`, after a message, if a tool is missing.
fn image_for(processor: &Processor, folder: &Path) -> Option<PathBuf> {
    let what = format!("the C library on {}", processor.title);
    have_target(processor.target, &what)
        .filter(|_| have(&[ARM_GCC, ARM_OBJDUMP, ARM_LIBC, QEMU], &what))?;
    let platform = Platform::Bare(*processor);
    let tree = tree_of(&platform, folder);
    let library = format!("lib{}.a", platform.library());
    let image = folder.join("controller.elf");
    let mut compiler = compile_with_archive(ARM_GCC.program, "cortex-m", folder, &tree, &library);
    compiler.args(processor.gcc).args([
        "-ffreestanding",
        "-nostdlib",
        "-ffunction-sections",
        "-fdata-sections",
        "-Wl,--gc-sections",
        "-Wl,--fatal-warnings",
        "-Wl,-z,noexecstack",
        "-L",
    ]);
    compiler
        .arg(c_library::folder().join("examples/cortex-m"))
        .args(["-T", &format!("{}.ld", processor.board), "-lgcc", "-o"]);
    succeed(compiler.arg(&image));
    Some(image)
}

fn assert_same_run_on(processor: &Processor) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(image) = image_for(processor, folder.path()) else {
        return;
    };
    let mut qemu = Command::new(QEMU.program);
    qemu.args(["-M", processor.board, "-cpu", processor.emulated_cpu]);
    qemu.args(["-display", "none", "-monitor", "none", "-serial", "none"]);
    // With these options, virtual time does not wait for the real clock.
    qemu.args(["-icount", "shift=0,sleep=off"]);
    qemu.args([
        "-semihosting-config",
        "enable=on,target=native,chardev=text",
    ]);
    qemu.args(["-chardev", "stdio,id=text", "-kernel"]);
    assert_same_run(&succeed(qemu.arg(&image)), processor.title);
}

#[test]
fn the_controller_on_a_cortex_m4f_prints_what_rust_does() {
    assert_same_run_on(&CORTEX_M4F);
}

#[test]
fn the_controller_on_a_cortex_m7_prints_what_rust_does() {
    assert_same_run_on(&CORTEX_M7);
}

#[test]
fn the_controller_on_a_cortex_m33_prints_what_rust_does() {
    assert_same_run_on(&CORTEX_M33);
}

/// Names of functions and data in the image.
fn symbols(image: &Path) -> Vec<String> {
    use object::{Object, ObjectSymbol};
    let bytes = std::fs::read(image).expect("an image");
    let file = object::File::parse(&*bytes).expect("an image");
    let names = file
        .symbols()
        .filter_map(|symbol| symbol.name().ok().map(str::to_owned));
    names.collect()
}

#[test]
fn the_image_has_no_panic_no_heap_and_no_double_precision() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(image) = image_for(&CORTEX_M7, folder.path()) else {
        return;
    };
    let symbols = symbols(&image);
    let has = |name: &str| symbols.iter().any(|symbol| symbol == name);
    for function in [
        "dashpot_damper_init",
        "dashpot_step_bank",
        "dashpot_state_restore",
    ] {
        assert!(has(function), "the image does not use {function}");
    }
    // rust_begin_unwind is the panic handler; __aeabi_d... are functions for double precision in software.
    let unwanted = [
        "panic",
        "rust_begin_unwind",
        "alloc",
        "sbrk",
        "__aeabi_d",
        "__aeabi_f2d",
    ];
    for part in unwanted {
        let found: Vec<&String> = symbols
            .iter()
            .filter(|symbol| symbol.contains(part))
            .collect();
        assert!(found.is_empty(), "{part}: {found:?}");
    }
    // Double-precision functions also have other names. The end of a Rust name is an arbitrary hash, so it is ignored.
    let double = |symbol: &&String| {
        symbol.starts_with("__") && (symbol.ends_with("df3") || symbol.ends_with("df2"))
    };
    assert_eq!(symbols.iter().find(double), None);
    // A Cortex-M7 may have single precision only, so there must be no instruction on doubles either.
    let listing = succeed(Command::new(ARM_OBJDUMP.program).arg("-d").arg(&image));
    let listing = String::from_utf8_lossy(&listing.stdout);
    assert!(
        listing.contains("vmul.f32"),
        "the listing shows no instructions"
    );
    let doubles: Vec<&str> = listing
        .lines()
        .filter(|line| line.contains(".f64"))
        .collect();
    assert!(doubles.is_empty(), "{doubles:?}");
}
