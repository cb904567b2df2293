//! The example controller in C against the same run in Rust: on the host under sanitizers and Valgrind,
//! on a Cortex-M7 under QEMU. Also what the image on the target is made of.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use dashpot::damper;
use dashpot_core::Damper;
use dashpot_hil::export::{Provenance, c_source};
use xtask::c_library::{self, build_for, build_for_host};
use xtask::processor::CORTEX_M7;
use xtask::tools::{ARM_GCC, ARM_LIBC, GCC, GXX, QEMU, VALGRIND, have, have_target};

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
const COMPILE_FOR_CORTEX_M7: [&str; 5] = [
    "-mcpu=cortex-m7",
    "-mthumb",
    "-mfpu=fpv5-sp-d16",
    "-mfloat-abi=hard",
    "-ffreestanding",
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

/// The two exported dampers as C sources in `folder`.
fn export(folder: &Path) -> Vec<PathBuf> {
    ["in-service", "reduced-vertical"]
        .map(|name| {
            let built: Damper<f32> = damper(name, &[]).build(1e-3).expect("a preset");
            let provenance = Provenance {
                damper: name,
                step_us: 1000.0,
                command: "a test",
            };
            let constant = name.to_uppercase().replace('-', "_");
            let source = c_source(&constant, &built, &provenance).expect("a name");
            let file = folder.join(name).with_extension("c");
            std::fs::write(&file, source).expect("a writable folder");
            file
        })
        .into()
}

/// `compiler` for the example on `platform`, everything but the result named.
fn compile(compiler: &str, platform: &str, dampers: &[PathBuf], library: &Path) -> Command {
    let examples = c_library::folder().join("examples");
    let mut command = Command::new(compiler);
    command.args(WARNINGS).args(["-O2", "-g"]);
    command
        .arg("-I")
        .arg(c_library::folder().join("include"))
        .arg("-I")
        .arg(&examples);
    command
        .arg(examples.join("controller.c"))
        .arg(examples.join(platform).join("main.c"));
    command.args(dampers).arg(library);
    command
}

/// The image for the Cortex-M7, or nothing when a tool is missing, which has been said.
fn cortex_m7(output: &Path) -> Option<PathBuf> {
    let what = "the C library on a Cortex-M7";
    let toolchain =
        have_target(CORTEX_M7.target, what).filter(|_| have(&[ARM_GCC, ARM_LIBC, QEMU], what))?;
    let library = build_for(&toolchain, &CORTEX_M7).unwrap_or_else(|error| panic!("{error}"));
    let image = output.join("controller.elf");
    let script = c_library::folder().join("examples/cortex-m7/link.ld");
    let mut compiler = compile(ARM_GCC.program, "cortex-m7", &export(output), &library);
    compiler.args(COMPILE_FOR_CORTEX_M7).args([
        "-ffunction-sections",
        "-fdata-sections",
        "-nostdlib",
    ]);
    compiler.args([
        "-Wl,--gc-sections",
        "-Wl,--fatal-warnings",
        "-Wl,-z,noexecstack",
        "-T",
    ]);
    succeed(compiler.arg(script).args(["-lgcc", "-o"]).arg(&image));
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
fn the_controller_on_the_host_prints_what_rust_does() {
    if !have(&[GCC], "the C library on the host") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let dampers = export(folder.path());
    let library = build_for_host().unwrap_or_else(|error| panic!("{error}"));
    let sanitized = folder.path().join("sanitized");
    let mut compiler = compile(GCC.program, "host", &dampers, &library);
    compiler.args([
        "-fsanitize=address,undefined",
        "-fno-sanitize-recover=all",
        "-o",
    ]);
    succeed(compiler.arg(&sanitized));
    assert_same_run(&succeed(&mut Command::new(&sanitized)), "under sanitizers");

    if !have(&[VALGRIND], "the C library under Valgrind") {
        return;
    }
    let plain = folder.path().join("plain");
    let mut compiler = compile(GCC.program, "host", &dampers, &library);
    succeed(compiler.arg("-o").arg(&plain));
    let mut valgrind = Command::new(VALGRIND.program);
    valgrind.args(["--quiet", "--error-exitcode=9", "--leak-check=full"]);
    valgrind.args(["--show-leak-kinds=all", "--errors-for-leak-kinds=all"]);
    assert_same_run(&succeed(valgrind.arg(&plain)), "under Valgrind");
}

#[test]
fn the_controller_on_a_cortex_m7_prints_what_rust_does() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(image) = cortex_m7(folder.path()) else {
        return;
    };
    let mut qemu = Command::new(QEMU.program);
    qemu.args([
        "-M",
        "mps2-an500",
        "-cpu",
        "cortex-m7",
        "-display",
        "none",
        "-monitor",
        "none",
    ]);
    // Virtual time does not wait for the clock on the wall.
    qemu.args(["-serial", "none", "-icount", "shift=0,sleep=off"]);
    qemu.args([
        "-semihosting-config",
        "enable=on,target=native,chardev=text",
    ]);
    qemu.args(["-chardev", "stdio,id=text", "-kernel"]);
    assert_same_run(&succeed(qemu.arg(&image)), "on a Cortex-M7");
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
    let Some(image) = cortex_m7(folder.path()) else {
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

/// The header alone, in both languages.
#[test]
fn the_header_compiles_as_c_and_as_cpp() {
    for (tool, language, standard) in [(GCC, "-xc", "-std=c11"), (GXX, "-xc++", "-std=c++17")] {
        if !have(&[tool], "the header, compiled") {
            continue;
        }
        let folder = tempfile::tempdir().expect("a temporary folder");
        let source = folder.path().join("use.c");
        let lines = "#include \"dashpot.h\"\n#include \"dashpot.h\"\n\
             #ifdef __cplusplus\n#define ASSERT static_assert\n#define ALIGN alignof\n#else\n\
             #define ASSERT _Static_assert\n#define ALIGN _Alignof\n#endif\n\
             ASSERT(sizeof(dashpot_damper) == DASHPOT_DAMPER_SIZE, \"\");\n\
             ASSERT(ALIGN(dashpot_damper) == DASHPOT_DAMPER_ALIGN, \"\");\n\
             ASSERT(sizeof(dashpot_state) == DASHPOT_STATE_SIZE, \"\");\n\
             ASSERT(ALIGN(dashpot_state) == DASHPOT_STATE_ALIGN, \"\");\n";
        std::fs::write(&source, lines).expect("a writable folder");
        let mut compiler = Command::new(tool.program);
        compiler.args([language, standard]).args(&WARNINGS[1..]);
        compiler.arg("-I").arg(c_library::folder().join("include"));
        succeed(compiler.args(["-fsyntax-only"]).arg(&source));
    }
}
