//! Different versions or sizes of header and library return a code.

use dashpot::{
    DASHPOT_DAMPER_SIZE, DASHPOT_STATE_SIZE, DashpotError, dashpot_check_header, dashpot_version,
};

#[test]
fn a_header_of_another_version_or_size_is_refused() {
    let (damper, state) = (DASHPOT_DAMPER_SIZE, DASHPOT_STATE_SIZE);
    let here = dashpot_version();
    assert_eq!(
        dashpot_check_header(here, damper, state),
        DashpotError::None
    );
    // Another patch version has the same interface.
    let patched = here / 100 * 100 + (here + 1) % 100;
    assert_eq!(
        dashpot_check_header(patched, damper, state),
        DashpotError::None
    );
    for (version, damper, state) in [
        (here + 100, damper, state),
        (here + 10_000, damper, state),
        (0, damper, state),
        (u32::MAX, damper, state),
        (here, damper - 4, state),
        (here, damper + 4, state),
        (here, damper, state + 4),
        (here, 0, 0),
    ] {
        let refused = dashpot_check_header(version, damper, state);
        assert_eq!(
            refused,
            DashpotError::Header,
            "{version}, {damper}, {state}"
        );
    }
}

#[test]
fn the_version_is_the_packages() {
    let number = dashpot_version();
    let (major, minor, patch) = (number / 10_000, number / 100 % 100, number % 100);
    assert_eq!(
        format!("{major}.{minor}.{patch}"),
        env!("CARGO_PKG_VERSION")
    );
}
