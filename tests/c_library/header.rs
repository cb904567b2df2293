//! dashpot.h compiles in every supported language, states the measured costs, and reports wrong calls from C.

use std::process::Command;

use dashpot::controller::WARNINGS;
use dashpot::document;
use xtask::c_library::{self, Platform};
use xtask::tools::{GCC, GXX, Tool, have};

fn compiler(tool: Tool, language: &[&str]) -> Command {
    let mut command = Command::new(tool.program);
    command.args(language).args(WARNINGS);
    command.arg("-I").arg(c_library::folder().join("include"));
    command
}

fn run(command: &mut Command) {
    let output = command.output().expect("it starts");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {text}");
}

#[test]
fn the_header_compiles_as_c_and_as_cpp() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("use.c");
    // An array with a negative size is an error in every version of both languages.
    let lines = "#include \"dashpot.h\"\n#include \"dashpot.h\"\n\
         typedef char damper_size[sizeof(dashpot_damper) == DASHPOT_DAMPER_SIZE ? 1 : -1];\n\
         typedef char state_size[sizeof(dashpot_state) == DASHPOT_STATE_SIZE ? 1 : -1];\n\
         struct damper_behind { char first; dashpot_damper damper; };\n\
         struct state_behind { char first; dashpot_state state; };\n\
         typedef char damper_align[offsetof(struct damper_behind, damper) == DASHPOT_DAMPER_ALIGN ? 1 : -1];\n\
         typedef char state_align[offsetof(struct state_behind, state) == DASHPOT_STATE_ALIGN ? 1 : -1];\n\
         #if DASHPOT_VERSION != \
         10000 * DASHPOT_VERSION_MAJOR + 100 * DASHPOT_VERSION_MINOR + DASHPOT_VERSION_PATCH\n\
         #error \"the version as one number\"\n#endif\n\
         int start(void);\nint start(void) { return DASHPOT_CHECK_HEADER() == DASHPOT_ERROR_NONE; }\n";
    std::fs::write(&source, lines).expect("a writable folder");
    for (tool, languages) in [
        (
            GCC,
            [
                ["-xc", "-std=c99"],
                ["-xc", "-std=c11"],
                ["-xc", "-std=c17"],
            ],
        ),
        (
            GXX,
            [
                ["-xc++", "-std=c++11"],
                ["-xc++", "-std=c++17"],
                ["-xc++", "-std=c++20"],
            ],
        ),
    ] {
        if !have(&[tool], "the header, compiled") {
            continue;
        }
        for language in languages {
            run(compiler(tool, &language).arg("-fsyntax-only").arg(&source));
        }
    }
}

/// Overlapping arguments, and a header of another version: C receives error codes, and only the caller's memory is
/// touched.
#[test]
fn wrong_calls_from_c_are_codes_under_sanitizers() {
    let Some(host) = Platform::ALL.into_iter().find(Platform::is_host) else {
        return;
    };
    if !have(&[GCC], "wrong calls of the C library") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let tree = c_library::install(&host, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    let program = folder.path().join("wrong_calls");
    run(compiler(GCC, &["-std=c99", "-g"])
        .args(["-fsanitize=address,undefined", "-fno-sanitize-recover=all"])
        .arg(c_library::folder().join("tests/wrong_calls.c"))
        .arg(tree.join("lib/libdashpot.a"))
        .arg("-o")
        .arg(&program));
    run(&mut Command::new(&program));
}

/// Numbers before the word `instructions` in the comment above a function.
fn stated_instructions(header: &str, function: &str) -> Vec<f64> {
    let prototype = format!("dashpot_error {function}(");
    let (before, _) = header.split_once(&prototype).expect("its prototype");
    let (_, comment) = before.rsplit_once("/**").expect("its comment");
    let words: Vec<&str> = comment
        .split_whitespace()
        .filter(|word| *word != "*")
        .collect();
    let positions = words
        .iter()
        .enumerate()
        .filter(|(_, word)| word.starts_with("instructions"));
    positions
        .map(|(position, _)| {
            // Spaces separate groups of three digits.
            let digits = words[..position]
                .iter()
                .rev()
                .take_while(|word| word.parse::<u32>().is_ok());
            let mut groups: Vec<&str> = digits.copied().collect();
            groups.reverse();
            groups
                .concat()
                .parse()
                .expect("a number before `instructions`")
        })
        .collect()
}

/// Maximum instructions of `dashpot_health_tick` in docs/health.md, over all its dampers.
fn max_of_a_health_tick() -> f64 {
    let table = document::part("docs/health.md", "cost");
    let rows = table.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.map(|row| row.split('|').nth(4).expect("a column for C"));
    let numbers = cells.map(|cell| cell.trim().parse::<f64>().expect("a number"));
    numbers.fold(f64::NAN, f64::max)
}

/// Figure for the Cortex-M7 in a row of the timing contract's table.
fn measured_instructions(row: &str) -> f64 {
    let table = document::part("docs/timing-contract.md", "measured");
    let line = table
        .lines()
        .find(|line| line.starts_with(&format!("| {row} |")));
    let cell = line
        .and_then(|line| line.split('|').nth(2))
        .expect("its row");
    cell.trim().parse().expect("one number")
}

/// Stated and measured costs agree to 5 %.
#[test]
fn stated_costs_match_the_measured_ones() {
    let header = document::read("capi/include/dashpot.h");
    let stated = stated_instructions(&header, "dashpot_health_tick");
    assert_eq!(stated, [max_of_a_health_tick()], "dashpot_health_tick");
    let swapped = "step that meets another damper's state";
    for (function, rows) in [
        ("dashpot_step", &["C: `dashpot_step`"][..]),
        ("dashpot_damper_init", &["C: `dashpot_damper_init`"]),
        (
            "dashpot_check_slice",
            &["C: `dashpot_check_slice`, maximum over a round"],
        ),
        (
            "dashpot_damper_set_clearance",
            &["C: `dashpot_damper_set_clearance`", swapped],
        ),
    ] {
        let stated = stated_instructions(&header, function);
        let measured: Vec<f64> = rows.iter().map(|row| measured_instructions(row)).collect();
        assert_eq!(stated.len(), measured.len(), "{function}: {stated:?}");
        for (stated, measured) in stated.iter().zip(measured) {
            let error = (stated / measured - 1.0).abs();
            assert!(
                error <= 0.05,
                "{function}: {stated} is stated, {measured} measured"
            );
        }
    }
}
