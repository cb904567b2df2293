//! What changes from tick to tick.

use crate::math::Real;
use crate::status::Status;

/// State of one damper: plain data, saved and restored by copying. 24 bytes in `f32`.
///
/// [`Damper::at_rest`](crate::Damper::at_rest) makes one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct DamperState<T> {
    /// Displacement used last (m).
    pub(crate) displacement: T,
    /// Stretch of clearance and series springs `x - x_r` (m).
    pub(crate) stretch: T,
    /// Flow potential at the stretch, times the step (m^2).
    pub(crate) potential: T,
    /// Force returned last (N).
    pub(crate) force: T,
    /// Revision of the damper that stepped last.
    pub(crate) revision: u32,
    pub(crate) status: Status,
    pub(crate) rejected_inputs: u16,
}

impl<T: Real> DamperState<T> {
    /// Displacement used last (m), positive in extension.
    pub fn displacement(&self) -> T {
        self.displacement
    }

    /// Piston displacement in the cylinder `x_r` (m).
    pub fn piston_displacement(&self) -> T {
        self.displacement - self.stretch
    }

    /// Force returned last (N), positive when it resists extension.
    pub fn force(&self) -> T {
        self.force
    }

    /// Bits latched since they were last cleared.
    pub fn status(&self) -> Status {
        self.status
    }

    /// Ticks whose displacement was held or limited, up to 65535.
    pub fn rejected_inputs(&self) -> u16 {
        self.rejected_inputs
    }

    /// The numbers of the step, in order of declaration.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [T; 4] {
        [self.displacement, self.stretch, self.potential, self.force]
    }

    /// Clears the status bits and the counter.
    pub fn clear_status(&mut self) {
        self.status = Status::empty();
        self.rejected_inputs = 0;
    }
}
