//! Processors that the core is proved on, and the boards of the emulator that have them.

/// A processor: how to compile for it, how to emulate it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processor {
    /// Name of columns and folders.
    pub name: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// Target of rustc.
    pub target: &'static str,
    /// Name for rustc's `target-cpu`; `None` for code of every processor of the target.
    pub target_cpu: Option<&'static str>,
    /// Options of GCC for code that runs there.
    pub gcc: [&'static str; 4],
    /// Board for `qemu-system-arm -M`.
    pub board: &'static str,
    /// Processor for `qemu-system-arm -cpu`.
    pub emulated_cpu: &'static str,
}

/// The one the firmware is for.
pub const CORTEX_M7: Processor = Processor {
    name: "cortex_m7",
    title: "Cortex-M7",
    target: "thumbv7em-none-eabihf",
    target_cpu: Some("cortex-m7"),
    gcc: [
        "-mcpu=cortex-m7",
        "-mthumb",
        "-mfpu=fpv5-sp-d16",
        "-mfloat-abi=hard",
    ],
    board: "mps2-an500",
    emulated_cpu: "cortex-m7",
};

/// With code that names no processor, so it also runs on a Cortex-M7.
pub const CORTEX_M4F: Processor = Processor {
    name: "cortex_m4f",
    title: "Cortex-M4F",
    target: "thumbv7em-none-eabihf",
    target_cpu: None,
    gcc: [
        "-mcpu=cortex-m4",
        "-mthumb",
        "-mfpu=fpv4-sp-d16",
        "-mfloat-abi=hard",
    ],
    board: "mps2-an386",
    emulated_cpu: "cortex-m4",
};

/// Armv8-M, as built for every processor of its target.
pub const CORTEX_M33: Processor = Processor {
    name: "cortex_m33",
    title: "Cortex-M33",
    target: "thumbv8m.main-none-eabihf",
    target_cpu: None,
    gcc: [
        "-mcpu=cortex-m33",
        "-mthumb",
        "-mfpu=fpv5-sp-d16",
        "-mfloat-abi=hard",
    ],
    board: "mps2-an505",
    emulated_cpu: "cortex-m33",
};

/// Target of the 64-bit Arm processor, whose user programs are emulated.
pub const AARCH64: &str = "aarch64-unknown-linux-gnu";

/// Every target that rustup installs for the tests.
pub const TARGETS: [&str; 3] = [CORTEX_M7.target, CORTEX_M33.target, AARCH64];
