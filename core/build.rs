//! Tells the square root what `cfg` cannot: stable compilers hide the floating-point features of Arm and
//! RISC-V processors.
//!
//! Sets `double_registers` where assembly may name an Arm processor's floating-point registers, which the
//! compiler allows where they are double. Warns where the root is software though the processor may have
//! the instruction.

/// Compiles where the feature `vfp2` is on, whether or not `cfg` shows it.
const PROBE: &str = r#"
#![no_std]
pub fn root(value: f64) -> f64 {
    let root;
    unsafe { core::arch::asm!("vsqrt.f64 {0}, {1}", out(dreg_low16) root, in(dreg_low16) value) };
    root
}"#;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(double_registers)");
    let variable = |name| std::env::var(name).unwrap_or_default();
    let features = variable("CARGO_CFG_TARGET_FEATURE");
    let has = |feature| features.split(',').any(|one| one == feature);
    // A build of `core` itself has nothing to probe with, but its compiler shows the feature.
    let double_registers = variable("CARGO_CFG_TARGET_ARCH") == "arm"
        && (has("vfp2") || autocfg::new().probe_raw(PROBE).is_ok());
    if double_registers {
        println!("cargo::rustc-cfg=double_registers");
    }
    let target = variable("TARGET");
    let in_hardware = double_registers || target.ends_with("eabihf") || has("sse2") || has("neon");
    if !in_hardware && !is_without_instruction(&target) {
        println!(
            "cargo::warning=dashpot-core takes square roots in software on {target}: the same bits, more \
             instructions. If the processor has a floating-point unit, prefer a target that uses it \
             (Arm: one that ends in eabihf)."
        );
    }
}

/// Whether no processor of this target has a square root instruction.
fn is_without_instruction(target: &str) -> bool {
    let architecture = target.split('-').next().unwrap_or_default();
    let riscv = architecture
        .strip_prefix("riscv32")
        .or(architecture.strip_prefix("riscv64"));
    match riscv {
        Some(extensions) => extensions.chars().all(|one| "iemac".contains(one)),
        None => matches!(architecture, "thumbv6m" | "thumbv7m" | "thumbv8m.base"),
    }
}
