//! Fixed bug: uninitialised memory was stepped as if it were a state.

use dashpot::damper;
use dashpot::memory::bytes;
use dashpot_core::integrity::Check;
use dashpot_core::{Damper, Status};

#[test]
fn an_uninitialised_state_starts_at_rest_and_reports_it() {
    let damper: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    for byte in [0x00, 0xff, 0xa5, 0xcd] {
        let mut state = damper.at_rest(0.0);
        bytes(&mut state).fill(byte);
        assert!(Check::state(&damper, &state).is_err(), "{byte:#x}");
        let force = damper.step(&mut state, 0.25);
        assert_eq!((force, state.displacement_m()), (0.0, 0.25), "{byte:#x}");
        assert_eq!(state.status(), Status::CORRUPTED, "{byte:#x}");
        assert_eq!(Check::state(&damper, &state), Ok(()));
    }
}
