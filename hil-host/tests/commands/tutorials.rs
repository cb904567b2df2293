//! Follows each page of docs/tutorials literally: writes its files and runs its commands in order, in an empty folder,
//! and compares what they print with what the page shows. `...` on a page stands for any text. The quick start of
//! README.md is followed in the same way.
#![cfg(unix)]

use std::path::Path;
use std::process::Command;

use xtask::run::repository;
use xtask::tools::{QEMU, have, have_library};

use crate::common::page::blocks;
use crate::common::program;

/// The checkout as the pages name it.
const CHECKOUT: &str = "../dashpot";

/// Runs a block of the shell and returns what it wrote to standard output.
fn run(script: &str, folder: &Path) -> String {
    let programs = program().parent().unwrap().display();
    let output = Command::new("sh")
        .args(["-euc", script])
        .env(
            "PATH",
            format!("{programs}:{}", std::env::var("PATH").unwrap()),
        )
        // Contact tables are kept in the target folder, not in the home folder of whoever runs the tests.
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
        // The page builds for its own target, into its own folder.
        .env_remove("CARGO_TARGET_DIR")
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{script}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

/// Where `printed` differs from `shown`, in which `...` stands for any text.
fn difference(printed: &str, shown: &str) -> Option<String> {
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    let printed = printed.join("\n");
    let mut rest = printed.as_str();
    for (number, part) in shown.trim_end().split("...").enumerate() {
        let part = part.trim_matches('\n');
        let at = match number {
            0 => rest.starts_with(part).then_some(0),
            _ => rest.find(part),
        };
        let Some(at) = at else {
            return Some(format!("does not print\n{part}\nbut\n{rest}"));
        };
        rest = &rest[at + part.len()..];
    }
    let ends = shown.trim_end().ends_with("...") || rest.trim().is_empty();
    (!ends).then(|| format!("prints more than the page shows:\n{rest}"))
}

fn follow(page: &str) {
    let path = repository().join("docs/tutorials").join(page);
    let text = std::fs::read_to_string(path).unwrap();
    let folder = tempfile::tempdir().unwrap();
    // Packages that a page compiles are kept, so that only the first run compiles them.
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tutorials");
    std::fs::create_dir_all(&kept).unwrap();
    std::os::unix::fs::symlink(kept, folder.path().join("target")).unwrap();
    let (mut commands, mut printed) = (0, String::new());
    for block in blocks(&text) {
        let content = block
            .content
            .replace(CHECKOUT, repository().to_str().unwrap());
        match (block.language, block.file) {
            ("sh", _) => {
                printed = run(&content, folder.path());
                commands += 1;
            }
            ("text", _) => {
                if let Some(difference) = difference(&printed, &content) {
                    panic!("docs/tutorials/{page}: the block before\n{content}{difference}");
                }
            }
            (_, Some(file)) => std::fs::write(folder.path().join(file), content).unwrap(),
            (language, None) => {
                panic!("{page}: a block of {language} without the name of its file")
            }
        }
    }
    assert!(commands > 2, "{page}: {commands} commands");
}

/// Runs the commands of README.md after `$`, except the installation, and compares their output.
#[test]
fn the_quick_start() {
    let text = std::fs::read_to_string(repository().join("README.md")).unwrap();
    let blocks = blocks(&text);
    let console = blocks.iter().find(|block| block.language == "console");
    let folder = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink(repository().join("data"), folder.path().join("data")).unwrap();
    let content = format!("\n{}", console.unwrap().content);
    let mut followed = 0;
    for part in content.split("\n$ ").skip(1) {
        let (line, shown) = part.split_once('\n').unwrap_or((part, ""));
        if line.starts_with("cargo install") {
            continue;
        }
        let line = line.replace("cargo run --release", "dashpot");
        let printed = run(&format!("{line} 2>&1"), folder.path());
        assert_eq!(difference(&printed, shown), None, "README.md: {line}");
        followed += 1;
    }
    assert_eq!(followed, 2);
}

#[test]
fn my_first_damper() {
    follow("first-damper.md");
}

#[test]
fn my_recording() {
    follow("recording.md");
}

#[test]
fn my_vehicle() {
    follow("vehicle.md");
}

#[test]
fn my_first_study() {
    follow("study.md");
}

#[test]
fn a_hybrid_test() {
    follow("hybrid-test.md");
}

#[test]
fn a_damper_on_a_cortex_m7() {
    let what = "the tutorial about a Cortex-M7";
    if !have(&[QEMU], what) || !have_library("thumbv7em-none-eabihf", what) {
        return;
    }
    follow("cortex-m7.md");
}

#[test]
fn every_tutorial_is_followed() {
    let mut pages: Vec<String> = std::fs::read_dir(repository().join("docs/tutorials"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    pages.sort();
    let code = std::fs::read_to_string(repository().join("hil-host/tests/commands/tutorials.rs"));
    let code = code.unwrap();
    let left_out = |page: &&String| !code.contains(&format!("follow(\"{page}\")"));
    let left_out: Vec<_> = pages.iter().filter(left_out).collect();
    assert!(left_out.is_empty(), "{left_out:?}");
}

#[test]
fn other_output_than_shown_is_found() {
    let printed = "a 1 \nb 2\nc 3\n";
    for same in [
        "a 1\nb 2\nc 3\n",
        "a 1\n...\n",
        "...\nb 2\n...",
        "a ...\nc 3",
        "a 1\n...\nc ...",
    ] {
        assert_eq!(difference(printed, same), None, "{same}");
    }
    for other in [
        "b 2\n...",
        "a 1\n",
        "a 1\n...\nb 3\n...",
        "...\nc 3\nb 2",
        "...\nc",
    ] {
        assert!(difference(printed, other).is_some(), "{other}");
    }
}
