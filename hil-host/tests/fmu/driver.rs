//! Driver written in C, compiled for one version of the interface.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use crate::{Unpacked, source};

pub struct Driver {
    folder: tempfile::TempDir,
}

impl Driver {
    pub fn new(fmi: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut compiler = Command::new("cc");
        compiler
            .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-O1", "-g"])
            .arg(format!("-DFMI={fmi}"))
            .arg("-I")
            .arg(source("../export/src/fmu/headers"))
            .arg(source("tests/fmu/driver.c"))
            .args(["-ldl", "-lm", "-o", "driver"])
            .current_dir(folder.path());
        let output = compiler.output().unwrap();
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        Self { folder }
    }

    fn program(&self) -> PathBuf {
        self.folder.path().join("driver")
    }

    /// Runs a task with `input` on standard input, which must succeed; returns the output.
    pub fn run(&self, fmu: &Unpacked, task: &[&str], input: &str) -> String {
        let output = self.output(&[], fmu, fmu.token(), task, input);
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(
            output.status.success(),
            "{text}{}",
            String::from_utf8_lossy(&output.stderr)
        );
        text
    }

    /// Like [`Self::run`], but runs the driver under the program `under` and with any token; the task may fail.
    pub fn output(
        &self,
        under: &[&str],
        fmu: &Unpacked,
        token: &str,
        task: &[&str],
        input: &str,
    ) -> Output {
        let resources = fmu.path("resources");
        let resources = match fmu.description.contains("fmiVersion=\"2.0\"") {
            true => format!("file://{}", resources.display()),
            false => resources.display().to_string(),
        };
        let program = self.program();
        let mut line: Vec<&std::ffi::OsStr> = under.iter().map(|word| (*word).as_ref()).collect();
        line.push(program.as_os_str());
        let mut driver = Command::new(line[0]);
        driver
            .args(&line[1..])
            .arg(fmu.library())
            .args([token, &resources])
            .args(task)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut driver = driver.spawn().unwrap();
        let mut to = driver.stdin.take().unwrap();
        let input = input.to_owned();
        let writer = std::thread::spawn(move || {
            // A driver that ends early does not read all of its input.
            let _ = to.write_all(input.as_bytes());
        });
        let output = driver.wait_with_output().unwrap();
        writer.join().unwrap();
        output
    }
}

/// Parses numbers printed by C with %a, one per line, between log messages.
pub fn hexadecimal(text: &str) -> Vec<f64> {
    let lines = text.lines().filter(|line| !line.starts_with("log "));
    lines.map(number).collect()
}

fn number(text: &str) -> f64 {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    let (mantissa, exponent) = digits
        .strip_prefix("0x")
        .and_then(|rest| rest.split_once('p'))
        .unwrap();
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = u64::from_str_radix(&format!("{whole}{fraction}"), 16).unwrap();
    let exponent: i32 = exponent.parse().unwrap();
    sign * digits as f64 * 2_f64.powi(exponent - 4 * fraction.len() as i32)
}
