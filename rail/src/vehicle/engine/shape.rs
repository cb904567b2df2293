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
    dampers: usize,
    damper_displacements: usize,
    damper_forces: usize,
    outside_forces: usize,
    stop_forces: usize,
    work: WorkShape,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct WorkShape {
    guidance: GuidanceShape,
    system: BlocksShape,
    residual: usize,
    in_middle: usize,
    rates_in_middle: usize,
    tick_forces: usize,
    tick_changes: usize,
    target_damper_forces: usize,
    target_stop_forces: usize,
    greatest_loads: usize,
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
    /// Number of bodies and lengths of all lists. A deserialised state may have any.
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
            dampers: state.dampers.len(),
            damper_displacements: state.damper_displacements_m.len(),
            damper_forces: state.damper_forces_n.len(),
            outside_forces: state.outside_forces_n.len(),
            stop_forces: state.stop_forces_n.len(),
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
            residual: work.residual.len(),
            in_middle: work.in_middle.len(),
            rates_in_middle: work.rates_in_middle.len(),
            tick_forces: work.tick_forces.len(),
            tick_changes: work.tick_changes.len(),
            target_damper_forces: work.target_damper_forces_n.len(),
            target_stop_forces: work.target_stop_forces_n.len(),
            greatest_loads: work.greatest_loads_n.len(),
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
