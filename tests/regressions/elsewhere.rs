//! Fixed bugs whose tests need the support code of another test binary, with the location of each test.

use dashpot::document::read;

/// The bug, the file of its test, the test.
const BUGS: [(&str, &str, &str); 14] = [
    (
        "a flipped bit in the step of the first damper kept it from being loaded again",
        "tests/link/damage.rs",
        "a_damper_with_a_damaged_step_can_be_loaded_again",
    ),
    (
        "a target reset while its dampers were loaded stopped the run",
        "hil-host/tests/link/pil_bank.rs",
        "after_a_reset_each_slot_has_its_damper_again",
    ),
    (
        "C: a state that lies in its damper, or forces in the states, were written",
        "capi/tests/overlap.rs",
        "a_bank_refuses_overlap_but_for_forces_in_place",
    ),
    (
        "C: uninitialised memory was stepped as a state",
        "capi/tests/integrity.rs",
        "uninitialised_memory_is_refused_and_unchanged",
    ),
    (
        "a serial link waited for an answer before a long request had left",
        "hil-host/tests/link/pil_client.rs",
        "the_wait_allows_for_the_time_a_long_frame_takes",
    ),
    (
        "a refusal of a target was reported as a number",
        "hil-host/tests/link/pil_client.rs",
        "every_refusal_has_a_sentence",
    ),
    (
        "a tick over TCP took 44 ms, because the peer waited for acknowledgements",
        "hil-host/tests/link/pil_tcp.rs",
        "received_data_is_acknowledged_at_once",
    ),
    (
        "`pil` ended by a signal left its emulator running",
        "hil-host/tests/link/pil_interruption.rs",
        "the_emulator_ends_with_the_command",
    ),
    (
        "a command ended by a signal left its temporary file",
        "hil-host/tests/commands/interruption.rs",
        "an_interrupted_replay_ends_by_the_signal_and_keeps_existing_files",
    ),
    (
        "energy of a replay was that of the recorded motion instead of the followed one",
        "hil-host/tests/commands/replay.rs",
        "energy_is_that_of_the_motion_followed",
    ),
    (
        "lines of recordings that end in CRLF were counted twice",
        "recording/tests/recordings/header.rs",
        "line_numbers_match_those_of_an_editor",
    ),
    (
        "the displacement of a tick at a sample depended on earlier samples",
        "hil-host/tests/commands/verify.rs",
        "the_reference_on_the_recording_is_that_on_a_grid_that_holds_all_stamps",
    ),
    (
        "the table blurred the corners of a law",
        "tests/damper/random_dampers.rs",
        "the_promise_holds_for_random_dampers_and_motions",
    ),
    (
        "a stretch far out was lost in the rounding of its position",
        "tests/damper/contract.rs",
        "a_start_far_out_does_not_stretch_a_damper_at_rest",
    ),
];

#[test]
fn every_test_named_is_there() {
    for (bug, path, test) in BUGS {
        let text = read(path);
        let test = format!("#[test]\nfn {test}()");
        assert!(text.contains(&test), "{bug}: {path} has no {test}");
    }
}
