//! Programs of others that tests run: installed, or named loudly.

use std::path::Path;
use std::process::Command;

use crate::target_toolchain::TargetToolchain;

/// A program and the Debian package that has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tool {
    /// The program, or a whole path for what is no program.
    pub program: &'static str,
    /// Its package.
    pub package: &'static str,
}

/// C compiler of the host.
pub const GCC: Tool = tool("gcc", "gcc");
/// C++ compiler of the host.
pub const GXX: Tool = tool("g++", "g++");
/// Memory checker.
pub const VALGRIND: Tool = tool("valgrind", "valgrind");
/// C compiler and linker of the target.
pub const ARM_GCC: Tool = tool("arm-none-eabi-gcc", "gcc-arm-none-eabi");
/// Emulator of the target.
pub const QEMU: Tool = tool("qemu-system-arm", "qemu-system-arm");

/// Browser, for what a page looks like.
pub const CHROMIUM: Tool = tool("chromium", "chromium");

/// All of them.
pub const TOOLS: [Tool; 6] = [GCC, GXX, VALGRIND, ARM_GCC, QEMU, CHROMIUM];

/// A compiler for the target where rustup has none: packages of Debian.
const TOOLCHAIN_PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];

const fn tool(program: &'static str, package: &'static str) -> Tool {
    Tool { program, package }
}

impl Tool {
    /// Whether the program is on the path.
    pub fn is_there(self) -> bool {
        std::env::var_os("PATH").is_some_and(|path| {
            std::env::split_paths(&path).any(|folder| folder.join(self.program).is_file())
        })
    }
}

/// The command that installs what is missing of `tools`, for someone who is not root; none when all
/// are there.
pub fn command_for(tools: &[Tool]) -> Option<String> {
    let missing: Vec<&str> = tools
        .iter()
        .filter(|tool| !tool.is_there())
        .map(|tool| tool.package)
        .collect();
    (!missing.is_empty()).then(|| format!("sudo apt-get install {}", missing.join(" ")))
}

/// Whether all of `tools` are there; if not, says on standard error what is skipped and the command
/// that helps. A test that gets `false` returns.
pub fn have(tools: &[Tool], skipped: &str) -> bool {
    match command_for(tools) {
        None => true,
        Some(command) => {
            say_skipped(skipped, &command);
            false
        }
    }
}

/// The toolchain of the target; if there is none, says so like [`have`].
pub fn have_target(skipped: &str) -> Option<TargetToolchain> {
    TargetToolchain::find()
        .inspect_err(|message| say_skipped(skipped, message))
        .ok()
}

/// Past the test harness, which keeps what a passing test prints to itself.
fn say_skipped(skipped: &str, remedy: &str) {
    use std::io::Write;
    let line = format!("\n!!!! SKIPPED: {skipped}\n!!!! to run it: {remedy}\n");
    // A closed standard error must not fail a test.
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}

/// Installs through apt-get what is missing, as root; otherwise, or when that fails, prints the command
/// and goes on: what needs the tools says that it was skipped.
pub fn install_missing() {
    let mut packages: Vec<&str> = TOOLS
        .iter()
        .filter(|tool| !tool.is_there())
        .map(|tool| tool.package)
        .collect();
    let no_target = TargetToolchain::find().is_err();
    let rustup = Command::new("rustup").arg("--version").output().is_ok();
    if no_target && rustup && add_target() {
        println!("installed the target's library through rustup");
    } else if no_target {
        packages.extend(TOOLCHAIN_PACKAGES);
    }
    if packages.is_empty() {
        return;
    }
    let line = format!("apt-get install --yes {}", packages.join(" "));
    if !is_root() || !Path::new("/usr/bin/apt-get").exists() {
        eprintln!("\n!!!! tools are missing; their tests will be skipped. As root: {line}\n");
        return;
    }
    let apt_get = |arguments: &[&str], packages: &[&str]| {
        let mut command = Command::new("apt-get");
        command.args(arguments).args(packages);
        command.env("DEBIAN_FRONTEND", "noninteractive");
        command.status().is_ok_and(|status| status.success())
    };
    // A list that cannot be brought up to date may still do.
    let _ = apt_get(&["update"], &[]);
    if !apt_get(&["install", "--yes", "--no-install-recommends"], &packages) {
        eprintln!("\n!!!! `{line}` failed; the tests of these tools will be skipped\n");
    }
}

fn add_target() -> bool {
    let mut words = crate::target_toolchain::INSTALL.split(' ');
    let program = words.next().unwrap_or_default();
    Command::new(program)
        .args(words)
        .status()
        .is_ok_and(|status| status.success())
}

fn is_root() -> bool {
    let id = Command::new("id").arg("-u").output();
    id.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

#[cfg(test)]
mod tests {
    use super::{command_for, tool};

    #[test]
    fn what_is_missing_is_named_with_its_package() {
        // Cargo runs this test, so its folder is on the path of every developer's shell.
        let (there, missing) = (
            tool("cargo", "cargo"),
            tool("no-such-program", "its-package"),
        );
        assert_eq!(command_for(&[there]), None);
        let command = command_for(&[there, missing]);
        assert_eq!(command.as_deref(), Some("sudo apt-get install its-package"));
    }
}
