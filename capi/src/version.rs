//! Version of the library, and a check of the header that a program was compiled with.

use crate::error::DashpotError;
use crate::types::{DASHPOT_DAMPER_SIZE, DASHPOT_STATE_SIZE};

const MAJOR: u32 = number(env!("CARGO_PKG_VERSION_MAJOR"));
const MINOR: u32 = number(env!("CARGO_PKG_VERSION_MINOR"));
const PATCH: u32 = number(env!("CARGO_PKG_VERSION_PATCH"));

const fn number(digits: &str) -> u32 {
    match u32::from_str_radix(digits, 10) {
        Ok(number) => number,
        Err(_) => panic!("cargo sets the version numbers"),
    }
}

/// Returns the version of the library: 10000 major + 100 minor + patch. `DASHPOT_VERSION` is the version of the header.
#[unsafe(no_mangle)]
pub extern "C" fn dashpot_version() -> u32 {
    10_000 * MAJOR + 100 * MINOR + PATCH
}

/// Checks that the program and the library are compatible: equal major and minor version, equal sizes. Call it once at
/// the start through `DASHPOT_CHECK_HEADER()`.
///
/// @param version      `DASHPOT_VERSION`
/// @param damper_size  `sizeof(dashpot_damper)`
/// @param state_size   `sizeof(dashpot_state)`
#[unsafe(no_mangle)]
pub extern "C" fn dashpot_check_header(
    version: u32,
    damper_size: usize,
    state_size: usize,
) -> DashpotError {
    let compatible = version / 100 == dashpot_version() / 100;
    if compatible && damper_size == DASHPOT_DAMPER_SIZE && state_size == DASHPOT_STATE_SIZE {
        DashpotError::None
    } else {
        DashpotError::Header
    }
}
