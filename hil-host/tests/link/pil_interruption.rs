//! An interrupted `dashpot pil` leaves neither its emulator nor a file behind.
#![cfg(target_os = "linux")]

use std::fs::File;
use std::io::{Read, Write};
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use crate::common::files_in;
use crate::pil_common::{desk, serve_tcp};

const SIGTERM: i32 = 15;

fn make_pipe(path: &Path) {
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.unwrap().success());
}

/// Sends SIGTERM, waits for the process to end, and checks that the signal ended it.
fn terminate(child: &mut Child) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-TERM", &id]).status();
    assert!(sent.unwrap().success());
    assert_eq!(child.wait().unwrap().signal(), Some(SIGTERM));
}

/// Emulator that never opens its serial line: it announces that it is running, waits for a line from its parent, and
/// reports if it outlives the command.
const EMULATOR: &str =
    "#!/bin/sh\nexec 3>alive\necho started >&3\nread line <wait\necho outlived >&3\n";

#[test]
fn the_emulator_ends_with_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("qemu-system-arm"), EMULATOR).unwrap();
    let executable = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(at("qemu-system-arm"), executable).unwrap();
    let mut image = [0; 20];
    image[..6].copy_from_slice(b"\x7fELF\x01\x01");
    image[18] = 40;
    std::fs::write(at("image"), image).unwrap();
    std::fs::write(at("in.csv"), "time_s,displacement_m\n0,0\n1,0\n").unwrap();
    make_pipe(&at("alive"));
    make_pipe(&at("wait"));
    // Open the pipe for reading and writing, so that opening does not wait for the other end.
    let mut wait = File::options()
        .read(true)
        .write(true)
        .open(at("wait"))
        .unwrap();
    let mut command = crate::common::command(
        &["pil", "--link", "qemu:image", "--input", "in.csv"],
        folder.path(),
    );
    let path = std::env::var("PATH").unwrap();
    command.env("PATH", format!("{}:{path}", folder.path().display()));
    let mut command = command.stderr(Stdio::null()).spawn().unwrap();
    let mut alive = File::open(at("alive")).unwrap();
    let mut reported = [0; 8];
    alive.read_exact(&mut reported).unwrap();
    assert_eq!(&reported, b"started\n");
    terminate(&mut command);
    wait.write_all(b"\n").unwrap();
    // The read ends when all writers have closed the pipe.
    let mut rest = String::new();
    alive.read_to_string(&mut rest).unwrap();
    assert_eq!(rest, "");
}

#[test]
fn no_partial_file_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    make_pipe(&at("in.csv"));
    std::fs::write(at("run.html"), "precious").unwrap();
    let link = format!("tcp:{}", serve_tcp(|| Box::new(desk())));
    let files = ["--output", "out.csv", "--page", "run.html"];
    let arguments = [&["pil", "--input", "in.csv", "--link", &link], &files[..]].concat();
    let mut command = crate::common::command(&arguments, folder.path())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // The pipe stays open: once its output files exist, the command waits for more rows.
    let mut pipe = File::options().write(true).open(at("in.csv")).unwrap();
    pipe.write_all(b"time_s,displacement_m\n0,0\n0.1,0\n")
        .unwrap();
    let begun = || {
        let names = files_in(folder.path());
        names
            .iter()
            .filter(|name| name.starts_with(".dashpot-"))
            .count()
    };
    while begun() < 2 {
        assert_eq!(command.try_wait().unwrap(), None, "ended by itself");
        std::thread::yield_now();
    }
    terminate(&mut command);
    assert_eq!(files_in(folder.path()), ["in.csv", "run.html"]);
    assert_eq!(std::fs::read_to_string(at("run.html")).unwrap(), "precious");
}
