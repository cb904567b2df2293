//! A command interrupted while writing leaves no temporary file behind.
#![cfg(target_os = "linux")]

use std::fs::File;
use std::io::Write;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};

use crate::common::{files_in, program};

const SIGHUP: i32 = 1;
const SIGINT: i32 = 2;
const SIGTERM: i32 = 15;

/// Replay from a pipe that stays open: once its temporary file exists, it waits for more rows.
struct Waiting {
    child: Child,
    pipe: File,
}

impl Waiting {
    /// Starts the command through `shell` in `folder`; the shell receives the command as `"$@"`.
    fn start(shell: &str, folder: &Path) -> Self {
        let pipe = folder.join("pipe");
        assert!(
            Command::new("mkfifo")
                .arg(&pipe)
                .status()
                .unwrap()
                .success()
        );
        let mut child = Command::new("sh")
            .args(["-c", shell, "sh"])
            .arg(program())
            .arg("replay")
            .args(["--input", "pipe", "--output", "out.csv"])
            .current_dir(folder)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // This open returns once the command has opened its end.
        let mut pipe = File::options().write(true).open(&pipe).unwrap();
        pipe.write_all(b"time_s,displacement_m\n0,0\n0.1,0\n")
            .unwrap();
        while !has_temporary(folder) {
            assert_eq!(child.try_wait().unwrap(), None, "ended by itself");
            std::thread::yield_now();
        }
        Self { child, pipe }
    }

    fn signal(&self, signal: i32) {
        let id = self.child.id().to_string();
        let status = Command::new("kill")
            .arg(format!("-{signal}"))
            .arg(id)
            .status();
        assert!(status.unwrap().success());
    }

    /// Ends the recording and waits for the command.
    fn end(mut self) -> ExitStatus {
        drop(self.pipe);
        self.child.wait().unwrap()
    }
}

fn has_temporary(folder: &Path) -> bool {
    files_in(folder)
        .iter()
        .any(|name| name.starts_with(".dashpot-"))
}

#[test]
fn an_interrupted_replay_ends_by_the_signal_and_keeps_existing_files() {
    for signal in [SIGHUP, SIGINT, SIGTERM] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("out.csv"), "precious").unwrap();
        // Resets signals that the test process ignores, as in the background of a shell.
        let mut waiting = Waiting::start("exec env --default-signal \"$@\"", folder.path());
        waiting.signal(signal);
        let status = waiting.child.wait().unwrap();
        assert_eq!(status.signal(), Some(signal), "{status}");
        assert_eq!(files_in(folder.path()), ["out.csv", "pipe"]);
        let kept = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
        assert_eq!(kept, "precious");
    }
}

/// As under `nohup`: the signal arrives before the end of the recording, and the command continues.
#[test]
fn a_signal_ignored_from_the_start_stays_ignored() {
    let folder = tempfile::tempdir().unwrap();
    let waiting = Waiting::start("trap '' HUP; exec \"$@\"", folder.path());
    waiting.signal(SIGHUP);
    let status = waiting.end();
    assert!(status.success(), "{status}");
    assert_eq!(files_in(folder.path()), ["out.csv", "pipe"]);
    let written = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert_eq!(written.lines().count(), 102);
}
