//! pyXCP as the master of a running vehicle: it measures and calibrates, and does what no master should.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crate::common::program;
use dashpot_core::parameters::{DamperParameters, Mount};
use dashpot_host_link::{Desk, Link};
use xtask::python::have_packages;

/// Runs a test file of `xcp/`, which must contain at least one test.
fn suite(name: &str) {
    let Some(python) = have_packages("pyXCP as the master of a running vehicle") else {
        return;
    };
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/xcp");
    let mut command = Command::new(python);
    command.args(["-m", "unittest", name]).current_dir(tests);
    command.env("DASHPOT", program());
    command.env("DASHPOT_TARGET", target());
    // Contact tables are kept in the target folder, and no compiled Python beside the sources.
    command.env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"));
    command.env("PYTHONDONTWRITEBYTECODE", "1");
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    assert!(!text.contains("Ran 0 tests"), "{text}");
}

/// Serves a simulated target with three slots to one host; returns its address.
fn target() -> String {
    let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
    let mut desk = Desk::new([parameters.build(1e-3).unwrap(); 3]).unwrap();
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let address = listener.local_addr().unwrap();
    std::thread::spawn(move || {
        let (mut line, _) = listener.accept().unwrap();
        let mut buffer = [0; 1024];
        while let Ok(received @ 1..) = line.read(&mut buffer) {
            desk.send(&buffer[..received]).unwrap();
            let answered = desk.receive(&mut buffer, Duration::ZERO).unwrap();
            line.write_all(&buffer[..answered]).unwrap();
        }
    });
    format!("tcp:{address}")
}

#[test]
fn it_measures_every_tick() {
    suite("test_measure");
}

#[test]
fn it_calibrates_dampers() {
    suite("test_calibrate");
}

#[test]
fn wrong_use_is_answered_with_the_codes_of_the_standard() {
    suite("test_wrong_use");
}

#[test]
fn the_example_of_the_page_runs() {
    suite("test_example");
}
