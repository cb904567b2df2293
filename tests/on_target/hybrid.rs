//! A tick of a hybrid test on an emulated Cortex-M7: its bits are those of this machine, and its cost has a bound.

use dashpot::document;
use dashpot::in_turn::images;
use dashpot::target::first_line;
use dashpot_core::hybrid::HybridStatus;
use dashpot_experiment::transfer;
use serde_json::Value;
use xtask::processor::CORTEX_M7;
use xtask::target_toolchain::TargetToolchain;

const DOCUMENT: &str = "docs/hybrid.md";
/// Time of an instruction under `-icount shift=10` (s).
const INSTRUCTION_S: f64 = 1024e-9;
/// Maximum instructions of a tick, with any measurement.
const MAX_INSTRUCTIONS: f64 = 600.0;

#[test]
fn a_tick_keeps_its_bound_and_the_bits_of_this_machine() {
    let Some(images) = images() else {
        return;
    };
    let line = first_line(&images.join("hybrid-cost"), &CORTEX_M7, 10, &[]);
    let printed: Value =
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("`{line}`: {error}"));
    let number = |key: &str| printed[key].as_f64().unwrap();
    let instructions =
        |ticks: f64| (ticks - number("call")) / (INSTRUCTION_S * number("clock_hz")) + 1.0;
    let (least, most) = (instructions(number("least")), instructions(number("most")));
    let [running_least, running_most] =
        ["running_least", "running_most"].map(|key| instructions(number(key)));
    println!(
        "{least:.0} to {most:.0} instructions, {running_least:.0} to {running_most:.0} in a running test"
    );
    assert!(most.round() <= MAX_INSTRUCTIONS, "{most}");

    let mut system = transfer::system().unwrap();
    let (digest, noticed) = transfer::run(&mut system, |system, desired, measured| {
        system.tick(desired, *measured)
    });
    assert_eq!(printed["digest"], format!("{:016x}", digest.value()));
    for fault in [
        HybridStatus::AGE,
        HybridStatus::IMPLAUSIBLE,
        HybridStatus::SIGN,
        HybridStatus::TRACKING,
    ] {
        assert!(
            noticed.contains(fault),
            "{fault:?} did not happen: {noticed:?}"
        );
    }
    let compiler = TargetToolchain::find(CORTEX_M7.target).and_then(|found| found.version());
    let compiler = compiler.unwrap_or_else(|error| panic!("{error}"));
    let bytes = number("system_bytes");
    let table = format!(
        "| {compiler} | instructions |\n|---|---|\n\
         | a running test | {running_least:.0} to {running_most:.0} |\n\
         | any tick | {least:.0} to {most:.0} |\n\n\
         The system takes {bytes} bytes.\n"
    );
    // Another compiler must keep the bound, but its figures may differ.
    if document::blessing() || document::part(DOCUMENT, "cost").contains(&compiler) {
        document::compare_part(DOCUMENT, "cost", &table);
    }
}
