//! Processors that the core is tested on, and the emulated boards that have them.

/// A processor, with how to compile for it and how to emulate it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processor {
    /// Name in columns and folders.
    pub name: &'static str,
    /// Name in text.
    pub title: &'static str,
    /// Compiler target.
    pub target: &'static str,
    /// Value of rustc's `target-cpu`; `None` for code that runs on every processor of the target.
    pub target_cpu: Option<&'static str>,
    /// GCC options.
    pub gcc: [&'static str; 4],
    /// Board for `qemu-system-arm -M`.
    pub board: &'static str,
    /// Processor for `qemu-system-arm -cpu`.
    pub emulated_cpu: &'static str,
}

/// The firmware's processor.
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

/// The code is compiled for every processor of the target, so it also runs on a Cortex-M7.
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

/// Armv8-M, with code for every processor of the target.
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

/// Target of the 64-bit Arm processor, whose Linux programs are emulated.
pub const AARCH64: &str = "aarch64-unknown-linux-gnu";

/// Targets that the tests need.
pub const TARGETS: [&str; 3] = [CORTEX_M7.target, CORTEX_M33.target, AARCH64];
