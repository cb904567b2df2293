//! Copies of a state without allocation.

use super::guidance::Guidance;
use super::state::{VehicleState, Work};
use super::structure::Blocks;

/// Implements [`Clone`] field by field, because the derived [`Clone::clone_from`] allocates.
macro_rules! clone_by_field {
    ($type:ident { $($field:ident),* $(,)? }) => {
        impl Clone for $type {
            fn clone(&self) -> Self {
                Self { $($field: self.$field.clone()),* }
            }

            fn clone_from(&mut self, source: &Self) {
                let Self { $($field),* } = source;
                $(self.$field.clone_from($field);)*
            }
        }
    };
}

clone_by_field!(VehicleState {
    identity,
    bodies,
    ticks,
    distance_m,
    speed_m_per_s,
    coordinates,
    velocities,
    accelerations,
    last_accelerations,
    forces,
    inertia,
    pose,
    contacts,
    last_loads,
    dampers,
    damper_displacements_m,
    damper_velocities_m_per_s,
    damper_forces_n,
    outside_forces_n,
    stop_forces_n,
    friction_factor,
    applied,
    friction_forces_n,
    sliders_m,
    is_diverged,
    met_other_vehicle,
    work,
});
clone_by_field!(Work {
    guidance,
    system,
    rails,
    residual,
    in_middle,
    rates_in_middle,
    tick_forces,
    tick_changes,
    target_damper_forces_n,
    target_stop_forces_n,
    target_friction_forces_n,
    extremes,
});
clone_by_field!(Guidance {
    pose,
    pose_rate,
    relative,
    relative_rate,
    acceleration,
});
clone_by_field!(Blocks {
    diagonal,
    couplings,
    carried,
});
