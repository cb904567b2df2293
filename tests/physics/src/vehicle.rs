//! State of a vehicle after a run.

use dashpot_files::case::Case;
use dashpot_vehicle_run::Run;

use crate::bits;

/// Number of ticks of the run.
const TICKS: u32 = 4900;

/// Coordinates and velocities of all bodies, and forces of the dampers, of the locomotive on straight track.
pub(super) fn state() -> Vec<String> {
    let case = Case::load("straight-180").expect("the case ships");
    let mut run = Run::new(&case).expect("the case ships");
    for _ in 0..TICKS {
        let ending = run.step().expect("a run");
        assert_eq!(ending, None);
    }
    let state = run.state();
    let bodies = state.coordinates().iter().chain(state.velocities());
    let numbers = bodies.flatten().chain(state.damper_forces_n());
    numbers.map(|number| bits(*number)).collect()
}
