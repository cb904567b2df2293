//! `dashpot link` against a simulated target that runs its own ticks.

// Each test binary uses only some of these functions.
#![allow(dead_code)]

use std::process::Command;
use std::time::Duration;

use assert_cmd::assert::{Assert, OutputAssertExt};
use dashpot_host_link::{Desk, Link, LinkError};
use serde_json::Value;
use tempfile::TempDir;

use crate::common::live::Live;
use crate::common::{command, error_of, json_of, text_of};
use crate::pil_common::{desk, serve_tcp};

/// Number of free-running ticks before each request; every action sends a hello and its own request.
pub const TICKS: u32 = 20;

/// Simulated target whose time advances with requests: when it runs free, by this number of ticks before each.
struct Ticking(Desk<3>, u32);

impl Link for Ticking {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        // A zero byte ends a frame.
        for _ in bytes.iter().filter(|byte| **byte == 0) {
            for _ in 0..self.1 {
                self.0.device().tick(1);
            }
        }
        self.0.send(bytes)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        self.0.receive(buffer, timeout)
    }
}

/// Target with three dampers behind a TCP port, and a folder for files.
pub struct Rig {
    address: String,
    pub folder: TempDir,
}

impl Rig {
    pub fn new() -> Self {
        Self::with_ticks(TICKS)
    }

    /// A target with this number of free-running ticks before each request.
    pub fn with_ticks(ticks: u32) -> Self {
        Self {
            address: serve_tcp(move || Box::new(Ticking(desk(), ticks))),
            folder: tempfile::tempdir().unwrap(),
        }
    }

    /// Lets the target run free without ever losing its link.
    pub fn run_free(&self) {
        let after = ["loss-of-link", "--after-ticks", "1000000"];
        self.text(&[&after[..], &["--output", "hold"]].concat());
        self.text(&["run", "--displacement-m", "0"]);
    }

    /// `dashpot live` with this target.
    pub fn live(&self, options: &[&str]) -> Live {
        let link = format!("tcp:{}", self.address);
        let line = ["--link", &link, "--timeout-ms", "60000"];
        Live::start(&[&line[..], options].concat(), self.folder.path())
    }

    /// `dashpot link` with an action, not started yet.
    pub fn command(&self, action: &[&str]) -> Command {
        let link = format!("tcp:{}", self.address);
        // On a busy machine an answer may be slow, but it always arrives.
        let line = ["link", "--link", &link, "--timeout-ms", "60000"];
        command(&[&line[..], action].concat(), self.folder.path())
    }

    /// Output and exit status of an action.
    pub fn output(&self, action: &[&str]) -> Assert {
        self.command(action).assert()
    }

    /// Text printed by an action that succeeds.
    pub fn text(&self, action: &[&str]) -> String {
        text_of(&self.output(action).success())
    }

    /// JSON printed by an action that succeeds.
    pub fn json(&self, action: &[&str]) -> Value {
        let arguments = [action, &["--format", "json"]].concat();
        json_of(&self.output(&arguments).success())
    }

    /// Error of an action that exits with `code` and writes nothing else.
    pub fn error(&self, action: &[&str], code: i32) -> String {
        error_of(&self.output(action).code(code).stdout(""))
    }

    /// Text of a file in the folder.
    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder.path().join(name)).unwrap()
    }

    /// Writes a file in the folder.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.folder.path().join(name), bytes).unwrap();
    }
}
