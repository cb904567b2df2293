//! Rigs behind UDP: `dashpot hybrid rig`, and the programs of docs/rig-protocol.md as they stand there.
#![cfg(target_os = "linux")]

use std::fs;
use std::io::{BufRead, BufReader};
use std::net::UdpSocket;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use predicates::str::contains;
use serde_json::Value;
use xtask::run::repository;
use xtask::tools::{GCC, PYTHON, have};

use crate::common::page::blocks;
use crate::common::{command, dashpot, error_of, json_of};

const PAGE: &str = "docs/rig-protocol.md";
const DAMPER: &str = "front lateral damper 1";

/// A rig in a process of its own, which is killed at the end.
struct Rig {
    process: Child,
    port: u16,
}

impl Drop for Rig {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// A port that nobody uses.
fn free_port() -> u16 {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    socket.local_addr().unwrap().port()
}

/// Starts a rig and waits until it listens: its first line on standard output or error says so.
fn start(mut rig: Command, port: u16) -> Rig {
    let mut process = rig
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    let is_dashpot = rig.get_program().to_string_lossy().contains("dashpot");
    match is_dashpot {
        true => BufReader::new(process.stderr.take().unwrap()).read_line(&mut line),
        false => BufReader::new(process.stdout.take().unwrap()).read_line(&mut line),
    }
    .unwrap();
    assert!(
        line.contains("ready") || line.contains("listening"),
        "{line}"
    );
    Rig { process, port }
}

fn virtual_rig(folder: &Path, arguments: &[&str]) -> Rig {
    let port = free_port();
    let listen = format!("127.0.0.1:{port}");
    let fixed = [
        "hybrid",
        "rig",
        "--listen",
        &listen,
        "--damper",
        "reduced-lateral",
    ];
    start(command(&[&fixed, arguments].concat(), folder), port)
}

/// The vehicle with its damper at `end` for `seconds`; extra options at the end.
fn vehicle(folder: &Path, end: &str, seconds: &str, more: &[&str]) -> assert_cmd::assert::Assert {
    let outside = format!("{DAMPER}={end}");
    let fixed = [
        "vehicle",
        "--case",
        "straight-180",
        "--duration-s",
        seconds,
        "--no-page",
        "--outside",
        &outside,
        "--format",
        "json",
    ];
    dashpot(&[&fixed, more].concat(), folder)
}

#[test]
fn a_rig_in_step_gives_the_bits_of_the_desk() {
    let folder = tempfile::tempdir().unwrap();
    let rig = virtual_rig(folder.path(), &["--actuator", "servo", "--in-step"]);
    let servo = ["--actuator", "servo"];
    let end = format!("udp:127.0.0.1:{}", rig.port);
    let of = |folder: &'static str| [&servo[..], &["--output", folder]].concat();
    vehicle(folder.path(), "desk", "2", &of("desk")).success();
    let over_udp = json_of(&vehicle(folder.path(), &end, "2", &of("udp")).success());
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("desk/hybrid.csv"), read("udp/hybrid.csv"));
    assert_eq!(read("desk/history.csv"), read("udp/history.csv"));
    let datagrams = &over_udp["outside"]["rigs"][0]["datagrams"];
    assert_eq!(
        [&datagrams["lost"], &datagrams["foreign"]],
        [&Value::from(0); 2]
    );
    // The session is over, so the next vehicle gets the rig.
    vehicle(folder.path(), &end, "0.1", &of("again")).success();
}

/// Writes the program of the page to the folder; returns the command that runs it.
fn of_page(name: &str, folder: &Path) -> Command {
    let page = fs::read_to_string(repository().join(PAGE)).unwrap();
    let blocks = blocks(&page);
    let block = blocks
        .iter()
        .find(|block| block.file == Some(name))
        .unwrap();
    let path = folder.join(name);
    fs::write(&path, &block.content).unwrap();
    if name.ends_with(".py") {
        let mut python = Command::new("python3");
        python.arg(path);
        return python;
    }
    let program = folder.join("rig");
    let line = "cc -std=c99 -O2 -o rig rig.c -lm";
    assert!(page.contains(line));
    let strict = ["-Wall", "-Wextra", "-Werror", "-pedantic"];
    let mut compiler = Command::new("gcc");
    let built = compiler
        .args(line.split(' ').skip(1))
        .args(strict)
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    Command::new(program)
}

/// A second-order actuator about as late as the programs of the page.
const LIKE_THE_PAGE: &str = "name = \"lag of 20 ms\"
limits = { stroke_m = 0.1, velocity_m_per_s = 1, force_n = 60e3 }
second_order = { frequency_hz = 25, damping_ratio = 1.57, delay_s = 0 }
";

#[test]
fn the_programs_of_the_page_are_rigs() {
    if !have(&[GCC, PYTHON], "the rigs of docs/rig-protocol.md") {
        return;
    }
    for name in ["rig.py", "rig.c"] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("lag.toml"), LIKE_THE_PAGE).unwrap();
        let port = free_port();
        let mut program = of_page(name, folder.path());
        program.arg(port.to_string());
        let rig = start(program, port);
        let end = format!("udp:127.0.0.1:{}", rig.port);
        let report =
            json_of(&vehicle(folder.path(), &end, "4", &["--actuator", "lag.toml"]).success());
        let found = &report["outside"]["rigs"][0];
        assert!(
            found["relative_error"].as_f64().unwrap() < 0.02,
            "{name}: {found}"
        );
        assert!(
            found["missing_readings"].as_u64().unwrap() <= 1,
            "{name}: {found}"
        );
        assert_eq!(found["datagrams"]["lost"], 0, "{name}: {found}");
    }
}

#[test]
fn a_rig_that_leaves_ends_the_run_without_a_jump() {
    if !have(&[PYTHON], "the rig of docs/rig-protocol.md") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("lag.toml"), LIKE_THE_PAGE).unwrap();
    let port = free_port();
    let mut program = of_page("rig.py", folder.path());
    program.args([port.to_string(), "2000".into()]);
    let rig = start(program, port);
    let end = format!("udp:127.0.0.1:{}", rig.port);
    let ended = vehicle(
        folder.path(),
        &end,
        "10",
        &["--actuator", "lag.toml", "--output", "out"],
    )
    .failure();
    assert!(
        error_of(&ended).contains("no reading came for too long"),
        "{}",
        error_of(&ended)
    );
    let text = fs::read_to_string(folder.path().join("out/hybrid.csv")).unwrap();
    let commands = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(3).unwrap().parse::<f64>().unwrap());
    let commands: Vec<f64> = commands.collect();
    let fastest = commands
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs() / 1e-3)
        .fold(0.0, f64::max);
    assert!(fastest < 1.0, "{fastest} m/s");
    let [.., before, last] = commands[..] else {
        panic!()
    };
    assert!((last - before).abs() < 1e-6, "the command has come to rest");
}

/// Regression: a vehicle sent another first command every 2 ms until the rig answered. A rig in step made a tick for
/// each, so a run depended on the speed of the machine.
#[test]
fn the_first_command_is_repeated_and_moves_a_rig_by_one_tick() {
    let folder = tempfile::tempdir().unwrap();
    let rig = UdpSocket::bind("127.0.0.1:0").unwrap();
    let end = format!("udp:{}", rig.local_addr().unwrap());
    vehicle(folder.path(), &end, "0.1", &["--actuator", "servo"])
        .failure()
        .stderr(contains("no answer within 5 s; is the rig running"));
    rig.set_nonblocking(true).unwrap();
    let mut bytes = [0; 64];
    let mut commands = Vec::new();
    let mut count = 0;
    while let Ok(length) = rig.recv(&mut bytes) {
        count += 1;
        commands.push(bytes[..length].to_vec());
        commands.dedup();
    }
    // At most another one each second, as its answer may be lost, and five that end the session.
    assert!(
        commands.len() <= 10 && commands.len() < count,
        "{} of {count}",
        commands.len()
    );
}

#[test]
fn a_missing_rig_and_wrong_ends_are_named() {
    let folder = tempfile::tempdir().unwrap();
    for (end, more, message) in [
        ("udp:127.0.0.1:1", &[][..], "a rig needs --actuator"),
        (
            "udp:nowhere",
            &["--actuator", "servo"],
            "allowed: udp:HOST:PORT",
        ),
        ("qemu", &["--actuator", "servo"], "allowed with --actuator"),
        ("desk", &["--actuator", "serwo"], "did you mean `servo`?"),
        (
            "desk",
            &["--actuator", "slow", "--compensate", "none"],
            "no margin (UNSTABLE)",
        ),
    ] {
        vehicle(folder.path(), end, "0.1", more)
            .failure()
            .stderr(contains(message));
    }
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let listen = taken.local_addr().unwrap().to_string();
    let rig = [
        "hybrid",
        "rig",
        "--actuator",
        "servo",
        "--damper",
        "paper",
        "--listen",
        &listen,
    ];
    dashpot(&rig, folder.path())
        .failure()
        .stderr(contains(format!("--listen {listen}: ")));
}
