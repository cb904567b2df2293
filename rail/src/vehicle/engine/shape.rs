//! Lengths of the lists of a state, which may be wrong in a deserialised state.

use super::guidance::Guidance;
use super::state::{VehicleState, Work};
use super::structure::Blocks;

/// Number of bodies of a state, and the lengths of all its lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Shape {
    bodies: usize,
    coordinates: usize,
    velocities: usize,
    accelerations: usize,
    last_accelerations: usize,
    forces: usize,
    inertia: usize,
    pose: usize,
    contacts: usize,
    last_loads: usize,
    dampers: usize,
    damper_displacements: usize,
    damper_velocities: usize,
    damper_forces: usize,
    outside_forces: usize,
    stop_forces: usize,
    applied: usize,
    friction_forces: usize,
    sliders: usize,
    work: WorkShape,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct WorkShape {
    guidance: GuidanceShape,
    system: BlocksShape,
    rails: usize,
    residual: usize,
    in_middle: usize,
    rates_in_middle: usize,
    tick_forces: usize,
    tick_changes: usize,
    target_damper_forces: usize,
    target_stop_forces: usize,
    target_friction_forces: usize,
    extremes: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct GuidanceShape {
    pose: usize,
    pose_rate: usize,
    relative: usize,
    relative_rate: usize,
    acceleration: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct BlocksShape {
    diagonal: usize,
    couplings: usize,
    carried: usize,
}

impl VehicleState {
    /// Number of bodies, and lengths of all lists. In a deserialised state these may have any value.
    #[inline(always)]
    pub(super) fn shape(&self) -> Shape {
        let state = self;
        Shape {
            bodies: state.bodies,
            coordinates: state.coordinates.len(),
            velocities: state.velocities.len(),
            accelerations: state.accelerations.len(),
            last_accelerations: state.last_accelerations.len(),
            forces: state.forces.len(),
            inertia: state.inertia.len(),
            pose: state.pose.len(),
            contacts: state.contacts.len(),
            last_loads: state.last_loads.len(),
            dampers: state.dampers.len(),
            damper_displacements: state.damper_displacements_m.len(),
            damper_velocities: state.damper_velocities_m_per_s.len(),
            damper_forces: state.damper_forces_n.len(),
            outside_forces: state.outside_forces_n.len(),
            stop_forces: state.stop_forces_n.len(),
            applied: state.applied.len(),
            friction_forces: state.friction_forces_n.len(),
            sliders: state.sliders_m.len(),
            work: WorkShape::new(&state.work),
        }
    }
}

impl WorkShape {
    #[inline(always)]
    fn new(work: &Work) -> Self {
        Self {
            guidance: GuidanceShape::new(&work.guidance),
            system: BlocksShape::new(&work.system),
            rails: work.rails.len(),
            residual: work.residual.len(),
            in_middle: work.in_middle.len(),
            rates_in_middle: work.rates_in_middle.len(),
            tick_forces: work.tick_forces.len(),
            tick_changes: work.tick_changes.len(),
            target_damper_forces: work.target_damper_forces_n.len(),
            target_stop_forces: work.target_stop_forces_n.len(),
            target_friction_forces: work.target_friction_forces_n.len(),
            extremes: work.extremes.len(),
        }
    }
}

impl GuidanceShape {
    #[inline(always)]
    fn new(guidance: &Guidance) -> Self {
        Self {
            pose: guidance.pose.len(),
            pose_rate: guidance.pose_rate.len(),
            relative: guidance.relative.len(),
            relative_rate: guidance.relative_rate.len(),
            acceleration: guidance.acceleration.len(),
        }
    }
}

impl BlocksShape {
    #[inline(always)]
    fn new(blocks: &Blocks) -> Self {
        Self {
            diagonal: blocks.diagonal.len(),
            couplings: blocks.couplings.len(),
            carried: blocks.carried.len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, OnceLock};

    use super::*;
    use crate::contact::{ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact};
    use crate::creep::{Friction, KalkerBook};
    use crate::track::Track;
    use crate::vehicle::{Body, Element, End, Law, Stop, Vehicle, VehicleParameters, Wheelset};

    /// A body on a wheelset.
    fn vehicle() -> Vehicle<KalkerBook> {
        static CONTACT: OnceLock<Arc<WheelsetContact<KalkerBook>>> = OnceLock::new();
        let contact = CONTACT.get_or_init(|| {
            let pair = Pair::standard(Installation::default()).unwrap();
            let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
            let tables = Arc::new(Tables::new(geometry));
            let friction = Friction::default();
            Arc::new(WheelsetContact::new(tables, KalkerBook::new(), friction).unwrap())
        });
        let at = [0.0, 0.0, 0.46];
        let law = Law::Bush {
            stiffness_n_per_m: [1e6; 3],
            damping_n_s_per_m: [0.0; 3],
            stiffness_n_m_per_rad: [1e6; 3],
            damping_n_m_s_per_rad: [0.0; 3],
        };
        let ends = [End::body("wheelset", at), End::body("body", at)];
        let parameters = VehicleParameters::new("small")
            .with_bodies([Body::new("body", 13e3, [20e3; 3], 0.5)])
            .with_wheelsets([Wheelset::new("wheelset", 2e3, [800.0, 100.0, 800.0], 0.46)])
            .with_elements([Element::new("bush", ends, law)]);
        Vehicle::new(&parameters, Arc::clone(contact), 1e-3).unwrap()
    }

    #[test]
    fn a_state_with_a_list_of_another_length_is_not_stepped() {
        type Change = fn(&mut VehicleState);
        let (vehicle, track) = (vehicle(), Track::default());
        let state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
        assert!(vehicle.can_step(&state));
        let changes: [Change; 9] = [
            |state| state.bodies += 1,
            |state| state.coordinates.clear(),
            |state| state.forces.push([0.0; 5]),
            |state| state.contacts.clear(),
            |state| state.damper_forces_n.push(0.0),
            |state| state.sliders_m.push(0.0),
            |state| state.work.residual.clear(),
            |state| state.work.guidance.pose_rate.clear(),
            |state| state.work.system.diagonal.clear(),
        ];
        for (number, change) in changes.iter().enumerate() {
            let mut damaged = state.clone();
            change(&mut damaged);
            assert!(!vehicle.can_step(&damaged), "{number}");
            vehicle.step(&mut damaged, &track);
            assert_eq!(damaged.stop(), Some(Stop::OtherVehicle), "{number}");
        }
    }

    /// Creep drives a wheelset that runs backward in a damaged state, so the equations of a step are not positive
    /// definite.
    #[test]
    fn a_state_that_creep_drives_has_diverged() {
        let (vehicle, track) = (vehicle(), Track::default());
        let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
        state.speed_m_per_s = -1.0;
        vehicle.step(&mut state, &track);
        assert_eq!(state.stop(), Some(Stop::Diverged));
    }
}
