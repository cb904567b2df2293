//! Programs that come in Debian packages.

use std::process::{Command, Stdio};

/// A program, or a header that a C compiler must find, and its Debian package.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tool {
    /// Name of the program.
    pub program: &'static str,
    /// Header that the compiler must find, if the compiler's own package lacks it.
    pub header: Option<&'static str>,
    /// Debian package with the program or the header.
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
/// Static checker of C, with an addon for the rules of MISRA.
pub const CPPCHECK: Tool = program("cppcheck", "cppcheck");
/// C compiler and linker for the Cortex-M processors.
pub const ARM_GCC: Tool = program("arm-none-eabi-gcc", "gcc-arm-none-eabi");
/// Linker for the Cortex-M processors, which links the firmware without a C compiler.
pub const ARM_LD: Tool = program("arm-none-eabi-ld", "binutils-arm-none-eabi");
/// Lists the instructions of a program for the Cortex-M processors.
pub const ARM_OBJDUMP: Tool = program("arm-none-eabi-objdump", "binutils-arm-none-eabi");
/// C library for the Cortex-M processors, which the compiler's package only recommends.
pub const ARM_LIBC: Tool = header("arm-none-eabi-gcc", "string.h", "libnewlib-arm-none-eabi");
/// Emulator of the Cortex-M processors.
pub const QEMU: Tool = program("qemu-system-arm", "qemu-system-arm");
/// Linker for the 64-bit Arm processor.
pub const AARCH64_GCC: Tool = program("aarch64-linux-gnu-gcc", "gcc-aarch64-linux-gnu");
/// C library for the 64-bit Arm processor.
pub const AARCH64_LIBC: Tool = header("aarch64-linux-gnu-gcc", "stdio.h", "libc6-dev-arm64-cross");
/// Emulator of programs for the 64-bit Arm processor.
pub const QEMU_AARCH64: Tool = program("qemu-aarch64", "qemu-user");

/// C compiler for 64-bit Windows.
pub const MINGW_GCC: Tool = program("x86_64-w64-mingw32-gcc", "gcc-mingw-w64-x86-64-win32");
/// Lists the libraries that a Windows library imports.
pub const MINGW_OBJDUMP: Tool = program("x86_64-w64-mingw32-objdump", "binutils-mingw-w64-x86-64");

/// Finds installed libraries for a compiler.
pub const PKG_CONFIG: Tool = program("pkg-config", "pkg-config");
/// Builds C programs with installed libraries.
pub const CMAKE: Tool = program("cmake", "cmake");
/// `make`, a recommended dependency of cmake.
pub const MAKE: Tool = program("make", "make");
/// Browser in which tests open pages.
pub const CHROMIUM: Tool = program("chromium", "chromium");
/// Controls the browser for a test.
pub const CHROMEDRIVER: Tool = program("chromedriver", "chromium-driver");

/// Finite-element solver, with which shim packs are compared.
pub const CALCULIX: Tool = program("ccx", "calculix-ccx");

/// Python, for the link's example client and the tests of the package `dashpot`.
pub const PYTHON: Tool = program("python3", "python3");

/// Daemon that signs the messages of Slurm's daemons.
pub const MUNGED: Tool = program("munged", "munge");
/// Slurm's controller, which keeps the queue. The package also contains the daemon of a node and the users' commands.
pub const SLURMCTLD: Tool = program("slurmctld", "slurm-wlm");
/// Slurm's daemon on a compute node.
pub const SLURMD: Tool = program("slurmd", "slurm-wlm");
/// Slurm's command that submits a job.
pub const SBATCH: Tool = program("sbatch", "slurm-wlm");
/// GNU parallel.
pub const PARALLEL: Tool = program("parallel", "parallel");

/// Tools that tests need.
pub const TEST_TOOLS: [Tool; 22] = [
    GCC,
    CLANG,
    GXX,
    VALGRIND,
    CPPCHECK,
    ARM_GCC,
    ARM_LD,
    ARM_OBJDUMP,
    ARM_LIBC,
    QEMU,
    AARCH64_GCC,
    AARCH64_LIBC,
    QEMU_AARCH64,
    MINGW_GCC,
    MINGW_OBJDUMP,
    PKG_CONFIG,
    CMAKE,
    MAKE,
    CHROMIUM,
    CHROMEDRIVER,
    CALCULIX,
    PYTHON,
];

/// Folder with daemons, which is not on every user's path.
const DAEMONS: &str = "/usr/sbin";

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
    /// True if the program is on the path or among the daemons and, if a header is required, finds it.
    pub fn is_installed(self) -> bool {
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

/// Returns the packages of the missing tools. Tools of one package must follow one another in `tools`.
pub fn missing(tools: &[Tool]) -> Vec<&'static str> {
    let missing = tools.iter().filter(|tool| !tool.is_installed());
    let mut packages: Vec<&str> = missing.map(|tool| tool.package).collect();
    packages.dedup();
    packages
}

#[cfg(test)]
mod tests {
    use super::{header, missing, program};

    #[test]
    fn missing_tools_are_named_by_their_packages() {
        // Cargo runs this test, so cargo is on the path.
        let installed = program("cargo", "cargo");
        assert_eq!(missing(&[installed]), [""; 0]);
        let tools = [installed, program("no-such-program", "its-package")];
        assert_eq!(missing(&tools), ["its-package"]);
    }

    #[test]
    fn a_missing_header_is_named_by_its_package() {
        let compiler = program("gcc", "gcc");
        let without = header("gcc", "no-such-header.h", "its-package");
        if compiler.is_installed() {
            assert_eq!(missing(&[compiler, without]), ["its-package"]);
        }
    }
}
