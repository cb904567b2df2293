//! A slave of XCP on an emulated Cortex-M7: the instructions of a tick and of a command have bounds.

use dashpot::document;
use dashpot::in_turn::images;
use dashpot::target::first_line;
use serde_json::Value;
use xtask::processor::CORTEX_M7;
use xtask::target_toolchain::TargetToolchain;

const DOCUMENT: &str = "docs/xcp.md";
/// Time of an instruction under `-icount shift=10` (s).
const INSTRUCTION_S: f64 = 1024e-9;
/// Maximum instructions of a tick with one list of the forces of twelve dampers, as one entry or as twelve.
const MAX_TICK: f64 = 1200.0;
/// Maximum instructions of a command of up to 8 bytes.
const MAX_COMMAND: f64 = 6000.0;

#[test]
fn a_tick_and_a_command_keep_their_bounds() {
    let Some(images) = images() else {
        return;
    };
    let line = first_line(&images.join("xcp-cost"), &CORTEX_M7, 10, &[]);
    let printed: Value =
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("`{line}`: {error}"));
    let number = |key: &str| printed[key].as_f64().unwrap();
    let instructions =
        |key: &str| (number(key) - number("call")) / (INSTRUCTION_S * number("clock_hz")) + 1.0;
    // Two bytes of identification, four of the time stamp, and the data.
    let bytes = ["one_bytes", "block_bytes", "twelve_bytes"].map(number);
    assert_eq!(bytes, [10.0, 54.0, 54.0]);
    for (bound, key) in [
        (MAX_TICK, "stopped"),
        (MAX_TICK, "one"),
        (MAX_TICK, "block"),
        (MAX_TICK, "twelve"),
        (MAX_COMMAND, "status"),
        (MAX_COMMAND, "upload"),
    ] {
        assert!(instructions(key) <= bound, "{key}: {}", instructions(key));
    }
    let compiler = TargetToolchain::find(CORTEX_M7.target).and_then(|found| found.version());
    let compiler = compiler.unwrap_or_else(|error| panic!("{error}"));
    let row = |words: &str, key: &str| format!("| {words} | {:.0} |\n", instructions(key));
    let table = format!(
        "| {compiler} | instructions |\n|---|---|\n{}{}{}{}{}{}\nThe slave takes {} bytes.\n",
        row("a tick while no list runs", "stopped"),
        row("a tick with one force", "one"),
        row("a tick with 12 forces that follow each other", "block"),
        row("a tick with 12 forces, each an entry of its own", "twelve"),
        row("GET_STATUS", "status"),
        row("SHORT_UPLOAD of 144 bytes", "upload"),
        number("slave_bytes")
    );
    // Another compiler must keep the bounds, but its figures may differ.
    if document::blessing() || document::part(DOCUMENT, "cost").contains(&compiler) {
        document::compare_part(DOCUMENT, "cost", &table);
    }
}
