//! Tells the step which instructions its processor has, because a stable compiler does not report those of Arm.

use std::env;

/// Processors with maximum and minimum in one instruction (FPv5), other than those of Armv8-M.
const WITH_MAXIMUM: [&str; 1] = ["cortex-m7"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(has_maximum)");
    if has_maximum() {
        println!("cargo::rustc-cfg=has_maximum");
    }
}

/// True if the compiler was given a 32-bit Arm processor that computes the maximum of two numbers in one instruction.
fn has_maximum() -> bool {
    let variable = |name| env::var(name).unwrap_or_default();
    let flags = variable("CARGO_ENCODED_RUSTFLAGS");
    let processor = flags
        .split('\x1f')
        .rev()
        .find_map(|flag| flag.split_once("target-cpu="));
    let named = processor.is_some_and(|(_, name)| WITH_MAXIMUM.contains(&name));
    variable("CARGO_CFG_TARGET_ARCH") == "arm"
        && (named || variable("TARGET").starts_with("thumbv8m.main"))
}
