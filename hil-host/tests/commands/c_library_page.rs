//! Follows capi/README.md literally: writes its files and runs its commands in order, in an empty folder.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use std::fmt::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use xtask::run::repository;
use xtask::tools::{ARM_GCC, ARM_LIBC, CMAKE, GCC, GXX, MAKE, PKG_CONFIG, QEMU, have, have_target};

use crate::common::page::blocks;
use crate::common::program;

/// Writes a stand-in for `cargo` whose `cargo run --release --` runs the command under test, which is already built.
fn stand_in_for_cargo(folder: &Path) {
    let path = folder.join("cargo");
    let script = format!(
        "#!/bin/sh\nif [ \"$1\" = run ]; then shift 3; exec '{}' \"$@\"; fi\nexec '{}' \"$@\"\n",
        program().display(),
        env!("CARGO"),
    );
    std::fs::write(&path, script).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
}

#[test]
fn the_page_about_the_c_library_works_word_for_word() {
    let what = "the page about the C library";
    let tools = [GCC, GXX, PKG_CONFIG, CMAKE, MAKE, ARM_GCC, ARM_LIBC, QEMU];
    if !have(&tools, what) || have_target("thumbv7em-none-eabihf", what).is_none() {
        return;
    }
    let page = std::fs::read_to_string(repository().join("capi/README.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let programs = tempfile::tempdir().unwrap();
    stand_in_for_cargo(programs.path());

    const MARK: &str = "==== end of block ====";
    let blocks = blocks(&page);
    let mut script = "set -eu\n".to_owned();
    for block in &blocks {
        match (block.language, block.file) {
            ("sh", _) => writeln!(script, "{}echo '{MARK}'", block.content).unwrap(),
            ("text", _) => {}
            (_, Some(file)) => std::fs::write(folder.path().join(file), &block.content).unwrap(),
            (language, None) => panic!("a block of {language} without the name of its file"),
        }
    }
    let repository = repository().to_str().unwrap();
    let place = "/where/the/repository/is";
    assert!(
        script.contains(place),
        "the page says where the repository is"
    );
    let output = Command::new("sh")
        .args(["-c", &script.replace(place, repository)])
        .env(
            "PATH",
            format!(
                "{}:{}",
                programs.path().display(),
                std::env::var("PATH").unwrap()
            ),
        )
        .current_dir(folder.path())
        .output()
        .unwrap();
    let printed = String::from_utf8_lossy(&output.stdout);
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{printed}\n{messages}");

    let mut outputs = printed.split(MARK);
    let mut last = "";
    let mut compared = 0;
    for block in &blocks {
        match block.language {
            "sh" => last = outputs.next().unwrap(),
            "text" => {
                let end = format!("\n{}", block.content);
                assert!(last.ends_with(&end), "{last}\nshould end in{end}");
                compared += 1;
            }
            _ => {}
        }
    }
    assert_eq!(
        compared, 6,
        "compiler alone, pkg-config, CMake, C++, health, hybrid test"
    );
    // QEMU's semihosting prints to standard error.
    assert!(
        messages.contains("\nforces "),
        "the controller's digest: {messages}"
    );
}
