//! Inputs that an FMU and its export reject, with their messages.

use std::fs;
use std::process::Command;

use crate::common::{are_as_their_readme_says, command, dashpot, error_of};
use crate::driver::Driver;
use crate::{Unpacked, source};

const REFUSED: &str = "\
log it 3 logStatusError: fmi#DoStep is not allowed while the instance is instantiated
step before the start: 3
reset: 0
log it 3 logStatusError: fmi#ExitInitializationMode is not allowed while the instance is instantiated
end of no initialization: 3
log it 2 logStatusDiscard: a communication step of 0.0005 s, allowed: a multiple of the internal step of 0.001 s, up to 1e+09 of it
half a step: 2
log it 2 logStatusDiscard: a communication step of 0.0015 s, allowed: a multiple of the internal step of 0.001 s, up to 1e+09 of it
one and a half: 2
log it 2 logStatusDiscard: a communication step of 0 s, allowed: a multiple of the internal step of 0.001 s, up to 1e+09 of it
no step: 2
log it 2 logStatusDiscard: a communication step of -0.001 s, allowed: a multiple of the internal step of 0.001 s, up to 1e+09 of it
a step back: 2
log it 2 logStatusDiscard: a communication step of nan s, allowed: a multiple of the internal step of 0.001 s, up to 1e+09 of it
no number: 2
log it 2 logStatusDiscard: a step from 0.002 s, but the last one ended at 0.001 s
from elsewhere: 2
log it 2 logStatusDiscard: a communication step of 10000000 s, allowed: a multiple of the internal step of 0.001 s, up to 1e+09 of it
too many: 2
log it 2 logStatusDiscard: value reference 4: 0.2, allowed: a clearance of 0 to 0.1 m
clearance: 2
log it 2 logStatusDiscard: value reference 4: nan, allowed: a clearance of 0 to 0.1 m
clearance: 2
time still 0.001 s
clearance still 0.001000 m
log it 1 logStatusWarning: a displacement was not finite, beyond limits.displacement_m or too far away: the last one was held
NaN: 1
NaN again: 0
";

#[test]
fn invalid_calls_report_the_allowed_values_and_change_nothing() {
    for fmi in ["2", "3"] {
        let text = Driver::new(fmi).run(&Unpacked::new(fmi, &[]), &["refuse"], "");
        assert!(text.starts_with(&REFUSED.replace('#', fmi)), "{text}");
        for line in [
            "log it 1 logStatusWarning: a displacement moved faster",
            "status 3, rejected 4, force finite 1",
            "quiet: 2\nlog it 2 logStatusDiscard: a step from 9 s",
            "no log category logEvents",
            "no variable of this type has the value reference 77",
            "after an error: 3",
            "value reference 3 is an output and cannot be set",
            "allowed: times within 4.5e+09 s of 0\na start that no step can be told from: 3",
            "a start at NaN: 1\nstatus 1\n",
            "logStatusError: a step to 0.02 s, beyond the stop time of 0.01 s\nbeyond the end: 3",
            "some and one out of range: 2, displacement still 0\n",
        ] {
            assert!(text.contains(line), "{line} in {text}");
        }
    }
}

#[test]
fn a_description_of_another_fmu_makes_no_instance() {
    for fmi in ["2", "3"] {
        let fmu = Unpacked::new(fmi, &[]);
        let output = Driver::new(fmi).output(&[], &fmu, "{another}", &["run", "1"], "");
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(
            text.contains("its token is {another}") && text.contains("no instance"),
            "{text}"
        );
    }
}

#[test]
fn every_function_of_the_interface_is_there() {
    for (fmi, count) in [("2", 34), ("3", 75)] {
        let header = fs::read_to_string(source(&format!(
            "../export/src/fmu/headers/fmi{fmi}Functions.h"
        )))
        .unwrap();
        let parts = header
            .split("Functions for ")
            .filter(|part| fmi == "3" || !part.starts_with("FMI2 for Model Exchange"));
        let functions: Vec<String> = parts
            .flat_map(str::lines)
            .filter(|line| line.contains("TYPE ") && line.trim_end().ends_with(';'))
            .map(|line| {
                line.split_whitespace()
                    .last()
                    .unwrap()
                    .trim_end_matches(';')
                    .to_owned()
            })
            .collect();
        assert_eq!(functions.len(), count, "{functions:?}");
        let text = Driver::new(fmi).run(
            &Unpacked::new(fmi, &[]),
            &["functions"],
            &functions.join("\n"),
        );
        assert_eq!(text, "all there\n");
    }
}

#[test]
fn an_invalid_export_reports_the_allowed_values_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&[&str], i32, &str); 7] = [
        (&["--fmi", "4"], 2, "2, 3"),
        (&["--fmi", "3", "--lang", "c"], 2, "--lang"),
        (&["--lang", "c", "--also", "paper"], 2, "--fmi"),
        (&["--fmi", "3", "--also", "none.toml"], 1, "none.toml"),
        (
            &["--fmi", "3", "--name", "straße"],
            2,
            "not a valid constant name",
        ),
        (
            &["--fmi", "3", "--name", "9lives"],
            2,
            "not a valid constant name",
        ),
        (&["--fmi", "3", "--health"], 2, "--health"),
    ];
    for (more, code, expected) in cases {
        let line = [&["export", "--output", "it.fmu"], more].concat();
        let text = error_of(&dashpot(&line, folder.path()).code(code));
        assert!(text.contains(expected), "{text}");
    }
    for (compiler, expected) in [
        ("no-such-compiler", "cannot be started"),
        ("false", "failed: exit status: 1"),
    ] {
        let line = ["export", "--fmi", "3", "--output", "it.fmu"];
        let output = command(&line, folder.path())
            .env("CC", compiler)
            .output()
            .unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1));
        assert!(
            text.contains(expected) && text.contains("--sources-only"),
            "{text}"
        );
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// Outputs do not depend on inputs at the same communication point, so two coupled FMUs form no algebraic loop.
#[test]
fn outputs_do_not_depend_on_inputs_at_the_same_time() {
    for fmi in ["2", "3"] {
        let fmu = Unpacked::new(fmi, &["--step-us", "300"]);
        let (_, structure) = fmu.description.split_once("<ModelStructure>").unwrap();
        assert_eq!(structure.matches("dependencies=\"\"").count(), 6);
        assert!(
            fmu.description.contains("stopTime=\"0.9999\""),
            "{}",
            fmu.description
        );
        assert!(!fmu.path("sources/fmi3Functions.h").exists());
    }
}

/// Two FMUs of the same version can be linked into one program.
#[test]
fn two_sources_share_no_symbol() {
    let folder = tempfile::tempdir().unwrap();
    let mut linker = Command::new("cc");
    linker.args(["-std=c99", "-shared", "-fPIC", "-o", "both.so"]);
    for fmi in ["2", "3"] {
        for name in ["one", "another_model"] {
            let fmu = Unpacked::new(fmi, &["--name", name, "--sources-only", "--loadable"]);
            let mut compiler = Command::new("cc");
            compiler.args(["-std=c99", "-fPIC", "-r", "-o"]);
            let object = folder.path().join(format!("{name}{fmi}.o"));
            compiler
                .arg(&object)
                .arg("-I")
                .arg(source("../export/src/fmu/headers"));
            for file in fs::read_dir(fmu.path("sources")).unwrap() {
                let path = file.unwrap().path();
                if path.extension().is_some_and(|end| end == "c") {
                    compiler.arg(path);
                }
            }
            assert!(compiler.status().unwrap().success());
            if fmi == "3" {
                linker.arg(&object);
            }
        }
    }
    let linked = linker.current_dir(folder.path()).output().unwrap();
    assert!(
        linked.status.success(),
        "{}",
        String::from_utf8_lossy(&linked.stderr)
    );
}

#[test]
fn the_same_export_has_the_same_bytes() {
    let [a, b] = [(); 2].map(|()| Unpacked::new("3", &["--loadable"]));
    assert_eq!(
        fs::read(a.path("it.fmu")).unwrap(),
        fs::read(b.path("it.fmu")).unwrap()
    );
    let sources = Unpacked::new("3", &["--sources-only"]);
    assert!(!sources.path("binaries").exists());
    assert_ne!(sources.token(), a.token());
}

#[test]
fn the_headers_of_the_interface_are_what_their_readme_says() {
    are_as_their_readme_says(&source("../export/src/fmu/headers"));
}
