//! Programs of others that tests run: installed, or named with the tests that were skipped for them.

use std::ffi::OsString;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::processor::{CORTEX_M7, TARGETS};
use crate::python;
use crate::run::{Outcome, cargo, cargo_output};
use crate::target_toolchain::TargetToolchain;

/// A program, or a header that a C compiler must find, and the Debian package that has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tool {
    /// The program.
    pub program: &'static str,
    /// The header, where the program is a compiler that comes without.
    pub header: Option<&'static str>,
    /// Its package.
    pub package: &'static str,
}

/// C compiler of the host.
pub const GCC: Tool = program("gcc", "gcc");
/// Another C compiler of the host.
pub const CLANG: Tool = program("clang", "clang");
/// C++ compiler of the host.
pub const GXX: Tool = program("g++", "g++");
/// Memory checker.
pub const VALGRIND: Tool = program("valgrind", "valgrind");
/// C compiler and linker of the Cortex-M processors.
pub const ARM_GCC: Tool = program("arm-none-eabi-gcc", "gcc-arm-none-eabi");
/// Its C library: the compiler's package only recommends it.
pub const ARM_LIBC: Tool = header("arm-none-eabi-gcc", "string.h", "libnewlib-arm-none-eabi");
/// Emulator of the Cortex-M processors.
pub const QEMU: Tool = program("qemu-system-arm", "qemu-system-arm");
/// Linker of the 64-bit Arm processor.
pub const AARCH64_GCC: Tool = program("aarch64-linux-gnu-gcc", "gcc-aarch64-linux-gnu");
/// Its C library.
pub const AARCH64_LIBC: Tool = header("aarch64-linux-gnu-gcc", "stdio.h", "libc6-dev-arm64-cross");
/// Emulator of programs for the 64-bit Arm processor.
pub const QEMU_AARCH64: Tool = program("qemu-aarch64", "qemu-user");

/// Finds installed libraries for a compiler.
pub const PKG_CONFIG: Tool = program("pkg-config", "pkg-config");
/// Builds C programs, installed libraries found.
pub const CMAKE: Tool = program("cmake", "cmake");
/// What it runs, which its package only recommends.
pub const MAKE: Tool = program("make", "make");
/// Browser, for what a page looks like.
pub const CHROMIUM: Tool = program("chromium", "chromium");
/// What lets a test look and act in it.
pub const CHROMEDRIVER: Tool = program("chromedriver", "chromium-driver");

/// Finite elements of others, beside which shim packs are solved.
pub const CALCULIX: Tool = program("ccx", "calculix-ccx");

/// What the example client of the link is written for.
pub const PYTHON: Tool = program("python3", "python3");

/// Daemon that Slurm's daemons sign their messages with.
pub const MUNGED: Tool = program("munged", "munge");
/// Slurm's daemon that has the queue; the package brings that of a node and the users' commands too.
pub const SLURMCTLD: Tool = program("slurmctld", "slurm-wlm");
/// Slurm's daemon of a node.
pub const SLURMD: Tool = program("slurmd", "slurm-wlm");
/// Slurm's command that takes a job.
pub const SBATCH: Tool = program("sbatch", "slurm-wlm");
/// GNU parallel.
pub const PARALLEL: Tool = program("parallel", "parallel");

/// What tests need.
pub const TOOLS: [Tool; 17] = [
    GCC,
    CLANG,
    GXX,
    VALGRIND,
    ARM_GCC,
    ARM_LIBC,
    QEMU,
    AARCH64_GCC,
    AARCH64_LIBC,
    QEMU_AARCH64,
    PKG_CONFIG,
    CMAKE,
    MAKE,
    CHROMIUM,
    CHROMEDRIVER,
    CALCULIX,
    PYTHON,
];

/// A subcommand of cargo that is built from its source.
#[derive(Clone, Copy, Debug)]
pub struct Subcommand {
    name: &'static str,
    version: &'static str,
}

/// Runs cargo with each feature.
pub const CARGO_HACK: Subcommand = Subcommand {
    name: "hack",
    version: "0.6.46",
};
/// Builds and runs fuzz targets.
pub const CARGO_FUZZ: Subcommand = Subcommand {
    name: "fuzz",
    version: "0.13.2",
};

impl Subcommand {
    /// Builds and installs it where it is missing.
    ///
    /// # Errors
    /// It does not build.
    pub fn install(self) -> Outcome {
        let Self { name, version } = self;
        if cargo_output(&[name, "--version"]).is_ok() {
            return Ok(());
        }
        let package = format!("cargo-{name}");
        cargo(&["install", "--locked", &package, "--version", version])
    }
}

/// A compiler for the Cortex-M processors where there is no rustup: packages of Debian.
const TOOLCHAIN_PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];

/// Where daemons are, which is not on every user's path.
const DAEMONS: &str = "/usr/sbin";

/// Names the file that skipped tests are listed in.
pub const SKIPPED: &str = "DASHPOT_SKIPPED";

const fn program(program: &'static str, package: &'static str) -> Tool {
    Tool {
        program,
        header: None,
        package,
    }
}

const fn header(program: &'static str, header: &'static str, package: &'static str) -> Tool {
    Tool {
        program,
        header: Some(header),
        package,
    }
}

impl Tool {
    /// Whether the program is on the path, or with the daemons, and finds the header.
    pub fn is_there(self) -> bool {
        let path = std::env::var_os("PATH").unwrap_or_default();
        let mut folders = std::env::split_paths(&path).chain([DAEMONS.into()]);
        let on_path = folders.any(|folder| folder.join(self.program).is_file());
        on_path && self.header.is_none_or(|header| self.finds(header))
    }

    fn finds(self, header: &str) -> bool {
        let mut compiler = Command::new(self.program);
        compiler.args(["-E", "-include", header, "-x", "c", "-"]);
        let compiler = compiler.stdin(Stdio::null()).output();
        compiler.is_ok_and(|output| output.status.success())
    }
}

/// Packages of those of `tools` that are missing; tools of one package stand together.
pub fn missing(tools: &[Tool]) -> Vec<&'static str> {
    let missing = tools.iter().filter(|tool| !tool.is_there());
    let mut packages: Vec<&str> = missing.map(|tool| tool.package).collect();
    packages.dedup();
    packages
}

/// Whether all of `tools` are there. A test that gets `false` returns: what it leaves out is said at once
/// and in the summary of `cargo xtask test`.
///
/// # Panics
/// Something is missing and the variable `CI` is set: there nothing may be left out.
pub fn have(tools: &[Tool], skipped: &str) -> bool {
    let missing = missing(tools);
    if !missing.is_empty() {
        skip(
            skipped,
            &format!("sudo apt-get install {}", missing.join(" ")),
        );
    }
    missing.is_empty()
}

/// The toolchain of a target; `None` as [`have`] says `false`.
///
/// # Panics
/// As [`have`].
pub fn have_target(target: &str, skipped: &str) -> Option<TargetToolchain> {
    TargetToolchain::find(target)
        .inspect_err(|message| skip(skipped, message))
        .ok()
}

/// Whether the default compiler has the library of a target; else as [`have`].
///
/// # Panics
/// As [`have`].
pub fn have_library(target: &str, skipped: &str) -> bool {
    let there = TargetToolchain::installed(target).is_some();
    if !there {
        skip(skipped, &format!("rustup target add {target}"));
    }
    there
}

pub(crate) fn skip(skipped: &str, remedy: &str) {
    let thread = std::thread::current();
    let line = format!(
        "{} ({skipped}); to run it: {remedy}\n",
        thread.name().unwrap_or("a test")
    );
    refuse_in_ci(std::env::var_os("CI"), &line);
    // Past the test harness, which keeps what a passing test prints to itself.
    let _ = std::io::stderr()
        .lock()
        .write_all(format!("\n!!!! SKIPPED: {line}").as_bytes());
    if let Some(path) = std::env::var_os(SKIPPED) {
        let list = std::fs::File::options()
            .create(true)
            .append(true)
            .open(path);
        let _ = list.and_then(|mut list| list.write_all(line.as_bytes()));
    }
}

/// Ends the test where the variable `CI` has a value.
fn refuse_in_ci(ci: Option<OsString>, line: &str) {
    let ci = ci.is_some_and(|value| !value.is_empty());
    assert!(!ci, "in CI no test is skipped: {line}");
}

/// Installs through rustup and apt-get what is missing, as root; otherwise, or when that fails, prints the
/// commands and goes on: what needs the tools says that it was skipped.
pub fn install_missing() {
    install_targets();
    let mut packages = missing(&TOOLS);
    if TargetToolchain::find(CORTEX_M7.target).is_err() {
        packages.extend(TOOLCHAIN_PACKAGES);
    }
    if python::lacks_environments() {
        packages.push(python::ENVIRONMENTS);
    }
    let installed = match packages[..] {
        [] => Ok(()),
        _ => install(&packages),
    };
    for outcome in [installed, python::install()] {
        if let Err(message) = outcome {
            eprintln!("\n!!!! {message}; the tests of these tools will be skipped\n");
        }
    }
}

/// Installs packages of Debian, as root.
///
/// # Errors
/// The command to be run by hand: no root, no apt-get, or it failed.
pub fn install(packages: &[&str]) -> Outcome {
    let line = format!("apt-get install --yes {}", packages.join(" "));
    if !is_root() || !Path::new("/usr/bin/apt-get").exists() {
        return Err(format!("tools are missing; as root: {line}"));
    }
    let apt_get = |arguments: &[&str], packages: &[&str]| {
        let mut command = Command::new("apt-get");
        command.args(arguments).args(packages);
        command.env("DEBIAN_FRONTEND", "noninteractive");
        command.status().is_ok_and(|status| status.success())
    };
    // A list that cannot be brought up to date may still do.
    let _ = apt_get(&["update"], &[]);
    if apt_get(&["install", "--yes", "--no-install-recommends"], packages) {
        Ok(())
    } else {
        Err(format!("`{line}` failed"))
    }
}

/// The libraries of the targets, where rustup is.
fn install_targets() {
    let lacks = |target: &&str| TargetToolchain::installed(target).is_none();
    let missing: Vec<&str> = TARGETS.into_iter().filter(lacks).collect();
    if missing.is_empty() || Command::new("rustup").arg("--version").output().is_err() {
        return;
    }
    let added = Command::new("rustup")
        .args(["target", "add"])
        .args(&missing)
        .status();
    if !added.is_ok_and(|status| status.success()) {
        let line = missing.join(" ");
        eprintln!("\n!!!! `rustup target add {line}` failed; their tests will be skipped\n");
    }
}

fn is_root() -> bool {
    let id = Command::new("id").arg("-u").output();
    id.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

#[cfg(test)]
mod tests {
    use super::{header, missing, program, refuse_in_ci};

    #[test]
    fn what_is_missing_is_named_by_its_package() {
        // Cargo runs this test, so its folder is on the path of every developer's shell.
        let there = program("cargo", "cargo");
        assert_eq!(missing(&[there]), [""; 0]);
        let tools = [there, program("no-such-program", "its-package")];
        assert_eq!(missing(&tools), ["its-package"]);
    }

    #[test]
    #[should_panic(expected = "in CI no test is skipped: a (QEMU)")]
    fn in_ci_nothing_is_skipped() {
        refuse_in_ci(None, "a (QEMU)");
        refuse_in_ci(Some("".into()), "a (QEMU)");
        refuse_in_ci(Some("true".into()), "a (QEMU)");
    }

    #[test]
    fn a_compiler_without_the_header_lacks_the_headers_package() {
        let compiler = program("gcc", "gcc");
        let without = header("gcc", "no-such-header.h", "its-package");
        if compiler.is_there() {
            assert_eq!(missing(&[compiler, without]), ["its-package"]);
        }
    }
}
