//! The example controller in C against the same run in Rust, from each install tree: on the host under
//! sanitizers and Valgrind, through pkg-config and CMake; on the processors under QEMU. Also what the image on
//! a target and the shared library are made of.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use dashpot::damper;
use dashpot_core::Damper;
use dashpot_hil::export::{Provenance, c_header, c_source};
use xtask::c_library::{self, Platform, install};
use xtask::processor::{AARCH64, CORTEX_M4F, CORTEX_M7, CORTEX_M33, Processor};
use xtask::tools::{
    AARCH64_GCC, AARCH64_LIBC, ARM_GCC, ARM_LIBC, CMAKE, GCC, MAKE, PKG_CONFIG, QEMU, QEMU_AARCH64,
    VALGRIND, have, have_library, have_target,
};

const WARNINGS: [&str; 8] = [
    "-std=c11",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Wundef",
    "-Werror",
];

fn succeed(command: &mut Command) -> Output {
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

/// The install tree for a platform, in `folder` under another name than it was made with.
fn tree_of(platform: &Platform, folder: &Path) -> PathBuf {
    let made = install(platform, folder).unwrap_or_else(|error| panic!("{error}"));
    let moved = folder.join("moved tree");
    std::fs::rename(made, &moved).expect("a tree that may be moved");
    moved
}

/// That of this machine; `None` where it is none of the platforms.
fn host_tree(folder: &Path) -> Option<PathBuf> {
    let host = Platform::ALL.into_iter().find(Platform::is_host)?;
    Some(tree_of(&host, folder))
}

/// The two exported dampers as C sources in `folder`, their headers beside them.
fn export(folder: &Path) -> [PathBuf; 2] {
    ["in-service", "reduced-vertical"].map(|name| {
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

/// `compiler` for the example on `platform`, made in `folder`; libraries and result not named yet.
fn compile(compiler: &str, platform: &str, folder: &Path) -> Command {
    let examples = c_library::folder().join("examples");
    let mut command = Command::new(compiler);
    command.args(WARNINGS).args(["-O2", "-g"]);
    command.arg("-I").arg(folder).arg("-I").arg(&examples);
    command
        .arg(examples.join("controller.c"))
        .arg(examples.join(platform).join("main.c"))
        .args(export(folder));
    command
}

/// As [`compile`], with the static library of a tree.
fn compile_with_archive(
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

/// The image for a processor, or nothing when a tool is missing, which has been said.
fn image_for(processor: &Processor, folder: &Path) -> Option<PathBuf> {
    let what = format!("the C library on {}", processor.title);
    have_target(processor.target, &what).filter(|_| have(&[ARM_GCC, ARM_LIBC, QEMU], &what))?;
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

/// Displacement of damper `number` at `tick` (m), as the sensor in controller.c.
fn sensor(number: u32, tick: u32) -> f32 {
    let half = 200 + 35 * number;
    let in_arc = tick % half;
    let arc = (in_arc * (half - in_arc)) as f32 * (0.012 / (half * half) as f32);
    match (number, tick) {
        (1, 2500..2520) => f32::NAN,
        (2, 4500) => 1.0,
        _ if (tick / half).is_multiple_of(2) => arc,
        _ => -arc,
    }
}

/// What the controller prints, from the core in Rust. Nothing is saved and restored here: that must not
/// show.
fn expected() -> String {
    let build = |name| -> Damper<f32> { damper(name, &[]).build(1e-3).expect("a preset") };
    let mut dampers = [build("in-service"), build("reduced-vertical")];
    let mut states: [_; 4] = std::array::from_fn(|i| dampers[i % 2].at_rest(sensor(i as u32, 0)));
    let mut text = String::new();
    let mut digest = 0x811c_9dc5_u32;
    for tick in 0..10_000 {
        if tick == 6000 {
            dampers[1].set_clearance_m(2.5e-3);
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

fn assert_same_run(output: &Output, where_run: &str) {
    let found = String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n");
    assert_eq!(found, expected(), "{where_run} differs from Rust");
}

#[test]
fn the_run_is_worth_comparing() {
    let text = expected();
    let line = |part: &str| text.lines().any(|line| line.contains(part));
    // Twenty failed readings held, the jump limited, the clearance changed.
    assert!(
        line("damper 00000001 status 00000005 rejected 00000014"),
        "{text}"
    );
    assert!(
        line("damper 00000002 status 00000002 rejected 00000002"),
        "{text}"
    );
    assert!(
        line("tick 00001f40 damper 00000003 status 0000000c"),
        "{text}"
    );
}

#[test]
fn the_static_library_on_the_host_prints_what_rust_does() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    if !have(&[GCC], "the C library on the host") {
        return;
    }
    let Some(tree) = host_tree(folder) else {
        return;
    };
    let compiler = || compile_with_archive(GCC.program, "host", folder, &tree, "libdashpot.a");
    let sanitized = folder.join("sanitized");
    succeed(
        compiler()
            .args(["-fsanitize=address,undefined", "-fno-sanitize-recover=all"])
            .arg("-o")
            .arg(&sanitized),
    );
    assert_same_run(&succeed(&mut Command::new(&sanitized)), "under sanitizers");

    if !have(&[VALGRIND], "the C library under Valgrind") {
        return;
    }
    let plain = folder.join("plain");
    succeed(compiler().arg("-o").arg(&plain));
    let mut valgrind = Command::new(VALGRIND.program);
    valgrind.args(["--quiet", "--error-exitcode=9", "--leak-check=full"]);
    valgrind.args(["--show-leak-kinds=all", "--errors-for-leak-kinds=all"]);
    assert_same_run(&succeed(valgrind.arg(&plain)), "under Valgrind");
}

#[test]
fn the_shared_library_is_found_by_pkg_config() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    if !have(&[GCC, PKG_CONFIG], "the C library through pkg-config") {
        return;
    }
    let Some(tree) = host_tree(folder) else {
        return;
    };
    let ask = |arguments: &[&str]| {
        let mut pkg_config = Command::new(PKG_CONFIG.program);
        pkg_config.env("PKG_CONFIG_PATH", tree.join("lib/pkgconfig"));
        let output = succeed(pkg_config.args(arguments).arg("dashpot"));
        String::from_utf8(output.stdout).expect("text")
    };
    assert_eq!(ask(&["--modversion"]).trim(), env!("CARGO_PKG_VERSION"));
    let flags = ask(&["--cflags", "--libs"]);
    // A blank of a folder is behind a backslash, as for a shell.
    let flags = flags.trim().replace("\\ ", "\0");
    let flags = flags.split(' ').map(|flag| flag.replace('\0', " "));
    let program = folder.join("controller");
    succeed(
        compile(GCC.program, "host", folder)
            .args(flags)
            .arg("-o")
            .arg(&program),
    );
    let mut run = Command::new(&program);
    assert_same_run(
        &succeed(run.env("LD_LIBRARY_PATH", tree.join("lib"))),
        "with the shared library",
    );
    let without = Command::new(&program).output().expect("a program");
    assert!(
        !without.status.success(),
        "it runs without the shared library"
    );
}

#[test]
fn both_libraries_are_found_by_cmake() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    if !have(&[GCC, CMAKE, MAKE], "the C library through CMake") {
        return;
    }
    let Some(tree) = host_tree(folder) else {
        return;
    };
    export(folder);
    let build = folder.join("build");
    let mut configure = Command::new(CMAKE.program);
    configure
        .arg("-S")
        .arg(c_library::folder().join("examples/host"));
    configure
        .arg("-B")
        .arg(&build)
        .args(["-G", "Unix Makefiles"]);
    for (name, value) in [("CMAKE_PREFIX_PATH", &*tree), ("DAMPERS", folder)] {
        configure.arg(format!("-D{name}={}", value.display()));
    }
    succeed(&mut configure);
    succeed(Command::new(CMAKE.program).arg("--build").arg(&build));
    for program in ["controller-dashpot", "controller-dashpot-static"] {
        assert_same_run(&succeed(&mut Command::new(build.join(program))), program);
    }
    // Another minor version is another interface.
    std::fs::write(
        folder.join("CMakeLists.txt"),
        "cmake_minimum_required(VERSION 3.16)\nproject(later C)\nfind_package(Dashpot ${WANTED} REQUIRED)\n",
    )
    .expect("a writable folder");
    for (wanted, found) in [
        ("0.1.0", true),
        ("0.1.1", false),
        ("0.2", false),
        ("1.0", false),
    ] {
        let mut configure = Command::new(CMAKE.program);
        configure
            .arg("-S")
            .arg(folder)
            .arg("-B")
            .arg(folder.join(wanted));
        configure.arg(format!("-DCMAKE_PREFIX_PATH={}", tree.display()));
        configure.arg(format!("-DWANTED={wanted}"));
        let output = configure.output().expect("CMake starts");
        assert_eq!(output.status.success(), found, "{wanted}: {output:?}");
    }
}

#[test]
fn the_shared_library_exports_its_functions_only() {
    use object::{Object, ObjectSymbol};
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(tree) = host_tree(folder.path()) else {
        return;
    };
    let bytes = std::fs::read(tree.join("lib/libdashpot.so")).expect("a link to the library");
    let library = object::File::parse(&*bytes).expect("a shared library");
    let exported: Vec<&str> = library
        .dynamic_symbols()
        .filter(|symbol| symbol.is_definition())
        .filter_map(|symbol| symbol.name().ok())
        .collect();
    assert!(exported.contains(&"dashpot_step"), "{exported:?}");
    let others: Vec<&&str> = exported
        .iter()
        .filter(|name| !name.starts_with("dashpot_"))
        .collect();
    assert!(others.is_empty(), "{others:?}");
}

#[test]
fn the_controller_on_64_bit_arm_prints_what_rust_does() {
    let what = "the C library on a 64-bit Arm processor";
    let tools = [AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64];
    if !have(&tools, what) || !have_library(AARCH64, what) {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let platform = Platform::Linux("aarch64");
    let tree = tree_of(&platform, folder);
    let library = format!("lib{}", platform.library());
    for end in ["a", "so"] {
        let program = folder.join(end);
        let name = format!("{library}.{end}");
        let gcc = AARCH64_GCC.program;
        let mut compiler = compile_with_archive(gcc, "host", folder, &tree, &name);
        compiler.arg(format!("-Wl,-rpath,{}", tree.join("lib").display()));
        succeed(compiler.arg("-o").arg(&program));
        assert_same_run(&succeed(&mut xtask::aarch64::program(&program)), &name);
    }
}

fn assert_same_run_on(processor: &Processor) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(image) = image_for(processor, folder.path()) else {
        return;
    };
    let mut qemu = Command::new(QEMU.program);
    qemu.args(["-M", processor.board, "-cpu", processor.emulated_cpu]);
    qemu.args(["-display", "none", "-monitor", "none", "-serial", "none"]);
    // Virtual time does not wait for the clock on the wall.
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
    // rust_begin_unwind is the panic handler; __aeabi_d..., ...df... are double precision in software.
    let unwanted = [
        "panic",
        "rust_begin_unwind",
        "alloc",
        "sbrk",
        "__aeabi_d",
        "__aeabi_f2d",
        "df3",
        "df2",
    ];
    for part in unwanted {
        let found: Vec<&String> = symbols
            .iter()
            .filter(|symbol| symbol.contains(part))
            .collect();
        assert!(found.is_empty(), "{part}: {found:?}");
    }
    // A Cortex-M7 may have single precision only: no instruction on doubles either.
    let listing = succeed(Command::new("arm-none-eabi-objdump").arg("-d").arg(&image));
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
