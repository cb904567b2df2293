//! Compares the transfer system in portable C with the core, bit for bit, through a test with every fault. It is a
//! second implementation, so a change of only one of the two fails here.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use dashpot::controller::succeed;
use dashpot::document;
use dashpot::transfer_sequence::{Row, run, run_wild};
use dashpot_core::hybrid::GuardAction;
use dashpot_export::{transfer_header, transfer_source};
use xtask::tools::{ARM_GCC, CLANG, GCC, GXX, have};

use crate::standalone::{block, compiler, left_to_others};

const DRIVER: &str = include_str!("../support/standalone/transfer.c");
/// Bytes that the driver writes for a tick: motion, command with status and phase, and reading.
const ANSWER: usize = 4 * (4 + 3 + 10);

/// Options that must not change the bits.
const OPTIONS: [&[&str]; 4] = [
    &["-std=c99", "-pedantic", "-O2", "-ffp-contract=off"],
    &["-std=gnu11", "-O3", "-march=native", "-ffp-contract=fast"],
    &["-std=c11", "-O0"],
    &["-std=c99", "-Os"],
];

fn write_sources(folder: &Path, name: &str) {
    let file = |end: &str| folder.join(format!("{}{end}", name.to_lowercase()));
    let included = format!("{}.h", name.to_lowercase());
    let source = transfer_source(name, "a test", Some(&included)).expect("a name");
    std::fs::write(file(".c"), source).expect("a writable folder");
    let header = transfer_header(name, "a test").expect("a name");
    std::fs::write(file(".h"), header).expect("a writable folder");
}

/// Input of the driver.
fn asked(rows: &[Row]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for row in rows {
        for number in [row.desired_m]
            .into_iter()
            .chain(row.measured.unwrap_or_default())
        {
            bytes.extend(number.to_ne_bytes());
        }
        for flag in [row.measured.is_some(), row.ends, row.reading.is_some()] {
            bytes.extend(u32::from(flag).to_ne_bytes());
        }
    }
    bytes
}

fn answers(program: &Path, action: &str, rows: &[Row]) -> Vec<u8> {
    let mut child = Command::new(program)
        .arg(action)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut input = child.stdin.take().expect("it is piped");
    let mut printed = Vec::new();
    std::thread::scope(|scope| {
        scope.spawn(move || input.write_all(&asked(rows)).expect("it reads"));
        let mut output = child.stdout.take().expect("it is piped");
        output.read_to_end(&mut printed).expect("it prints");
    });
    let status = child.wait().expect("it ends");
    assert!(status.success(), "{program:?}: {status}");
    assert_eq!(printed.len(), ANSWER * rows.len(), "{program:?}");
    printed
}

/// Bits of a number; every NaN counts as the same.
fn bits(number: f32) -> u32 {
    if number.is_nan() {
        u32::MAX
    } else {
        number.to_bits()
    }
}

fn assert_same(rows: &[Row], printed: &[u8], what: &str) {
    for (tick, (row, answer)) in rows.iter().zip(printed.chunks(ANSWER)).enumerate() {
        let words = answer.chunks(4);
        let words: Vec<[u8; 4]> = words.map(|word| word.try_into().expect("a word")).collect();
        let numbers = |range: std::ops::Range<usize>| -> Vec<u32> {
            let found = words[range].iter();
            found.map(|word| bits(f32::from_ne_bytes(*word))).collect()
        };
        let expected = row.motion.iter().chain(&row.command);
        let expected: Vec<u32> = expected.map(|number| bits(*number)).collect();
        assert_eq!(numbers(0..6), expected, "{what}: tick {tick}, {row:?}");
        let [low, high, ..] = words[6];
        let status = u16::from_ne_bytes([low, high]);
        assert_eq!(status, row.status, "{what}: tick {tick}");
        if let Some(reading) = row.reading {
            let expected = reading.map(bits).to_vec();
            assert_eq!(numbers(7..17), expected, "{what}: tick {tick}, {reading:?}");
        }
    }
}

#[test]
fn the_transfer_system_in_portable_c_has_the_cores_bits() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    write_sources(folder, "TRANSFER");
    let main = folder.join("main.c");
    std::fs::write(&main, DRIVER).expect("a writable folder");
    let tests = [
        ("hold", GuardAction::Hold),
        ("zero_force", GuardAction::ZeroForce),
    ]
    .map(|(name, action)| [(name, run(action)), (name, run_wild(action))])
    .concat();
    for tool in [GCC, CLANG] {
        if !have(&[tool], "the transfer system in portable C") {
            continue;
        }
        for options in OPTIONS {
            let program = folder.join("program");
            // Nothing but the compiler's own library is linked, not that of mathematics.
            let mut command = compiler(tool, options);
            command.arg(&main).arg(folder.join("transfer.c"));
            succeed(command.arg("-o").arg(&program));
            for (action, rows) in &tests {
                let what = format!("{} {options:?}, {action}", tool.program);
                let rows = rows.as_ref().expect("allowed settings");
                assert_same(rows, &answers(&program, action, rows), &what);
            }
        }
    }
}

#[test]
fn two_transfer_systems_link_into_one_program_also_in_cpp() {
    if !have(&[GCC, GXX], "two transfer systems in portable C") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let names = ["FRONT", "REAR"];
    let mut objects = Vec::new();
    for name in names {
        write_sources(folder, name);
        let object = folder.join(name).with_extension("o");
        let source = folder.join(name.to_lowercase()).with_extension("c");
        let mut command = compiler(GCC, &["-std=c99", "-O1", "-c"]);
        succeed(command.arg(source).arg("-o").arg(&object));
        objects.push(object);
    }
    let main = folder.join("main.cpp");
    let text = "#include \"front.h\"\n#include \"rear.h\"\n\
                int main() { return front_digest() == FRONT_DIGEST && rear_digest() == REAR_DIGEST ? 0 : 1; }\n";
    std::fs::write(&main, text).expect("a writable folder");
    let program = folder.join("program");
    let mut command = compiler(GXX, &["-std=c++11"]);
    succeed(command.arg(&main).args(&objects).arg("-o").arg(&program));
    succeed(&mut Command::new(&program));
}

#[test]
fn the_documents_controller_prints_what_it_says() {
    if !have(&[GCC], "the controller of docs/hybrid.md") {
        return;
    }
    let text = document::read("docs/hybrid.md");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    write_sources(folder, "TRANSFER");
    std::fs::write(folder.join("main.c"), block(&text, "`main.c`:")).expect("a writable folder");
    let mut command = compiler(GCC, &["-std=c99", "-O2"]);
    command.args(["main.c", "transfer.c", "-o", "main"]);
    succeed(command.current_dir(folder));
    let output = succeed(&mut Command::new(folder.join("main")));
    let printed = String::from_utf8_lossy(&output.stdout);
    assert_eq!(printed, block(&text, "It prints"));
}

#[test]
fn it_needs_no_library_on_a_processor_without_an_operating_system() {
    if !have(&[ARM_GCC], "what the transfer system in portable C needs") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    write_sources(folder.path(), "TRANSFER");
    for processor in [
        &["-mcpu=cortex-m4"][..],
        &["-mcpu=cortex-m7", "-mfpu=fpv5-sp-d16", "-mfloat-abi=hard"],
    ] {
        let mut compiler = compiler(ARM_GCC, &["-O2", "-mthumb"]);
        compiler.args(processor);
        let mut left = left_to_others(&mut compiler, "transfer.c", folder.path());
        // The compiler itself supplies arithmetic that the processor lacks, and copies of structures.
        left.retain(|name| {
            !name.starts_with("__aeabi_") && !["memcpy", "memset"].contains(&&**name)
        });
        assert!(left.is_empty(), "{processor:?}: {left:?}");
    }
}
