//! The state of a damper, which changes from tick to tick.

use crate::real::Real;
use crate::status::Status;

/// Upper bits of the status word, which distinguish a state from uninitialised memory.
const MARK: u16 = 0x3940;
const MARK_BITS: u16 = 0xffc0;

/// State of one damper: plain data, saved and restored by copying. 24 bytes in `f32`.
///
/// Created by [`Damper::at_rest`](crate::Damper::at_rest).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DamperState<T> {
    /// Last displacement used (m).
    pub(crate) displacement: T,
    /// Stretch of clearance and series springs `x - x_r` (m).
    pub(crate) stretch: T,
    /// Flow potential at the stretch times the step (m^2).
    pub(crate) potential: T,
    /// Last force returned (N).
    pub(crate) force: T,
    /// Revision of the damper that stepped last.
    pub(crate) revision: u32,
    /// Mark and status bits.
    status_word: u16,
    pub(crate) rejected_inputs: u16,
}

#[cfg(feature = "link")]
impl DamperState<f32> {
    /// Placeholder before the first state: all bits are zero, so a static variable takes no flash.
    pub(crate) const UNWRITTEN: Self = Self {
        displacement: 0.0,
        stretch: 0.0,
        potential: 0.0,
        force: 0.0,
        revision: 0,
        status_word: 0,
        rejected_inputs: 0,
    };
}

impl<T: Real> Default for DamperState<T> {
    /// At rest at 0, without a damper. The first damper that steps this state adopts it.
    fn default() -> Self {
        Self::new([T::ZERO; 4], 0, Status::empty(), 0)
    }
}

impl<T: Real> DamperState<T> {
    /// Creates a state from its numbers in the order of the fields.
    pub(crate) fn new(
        [displacement, stretch, potential, force]: [T; 4],
        revision: u32,
        status: Status,
        rejected_inputs: u16,
    ) -> Self {
        Self {
            displacement,
            stretch,
            potential,
            force,
            revision,
            status_word: MARK | status.bits(),
            rejected_inputs,
        }
    }

    /// True for a state, false for uninitialised memory (with any usual fill pattern).
    ///
    /// For programs that get their states from elsewhere than [`Damper::at_rest`](crate::Damper::at_rest), for example
    /// in C.
    ///
    /// ```
    /// assert!(dashpot_core::DamperState::<f32>::default().is_marked());
    /// ```
    #[inline]
    pub fn is_marked(&self) -> bool {
        self.status_word & MARK_BITS == MARK
    }

    /// Last displacement used (m), positive in extension.
    pub fn displacement_m(&self) -> T {
        self.displacement
    }

    /// Displacement `x_r` of the piston in the cylinder (m), positive in extension.
    pub fn piston_displacement_m(&self) -> T {
        self.displacement - self.stretch
    }

    /// Last force returned (N), positive when it resists extension.
    pub fn force_n(&self) -> T {
        self.force
    }

    /// Revision of the damper that stepped last; 0 before the first step.
    #[inline]
    pub fn revision(&self) -> u32 {
        self.revision
    }

    /// Status bits latched since the last [`Self::clear_status`].
    pub fn status(&self) -> Status {
        Status::from_bits_truncate(self.status_word)
    }

    /// Number of ticks at which the displacement was held or limited, or at which the damper restarted; up to 65535.
    pub fn rejected_inputs(&self) -> u16 {
        self.rejected_inputs
    }

    /// Returns the numbers of the step in order of declaration.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [T; 4] {
        [self.displacement, self.stretch, self.potential, self.force]
    }

    /// True if every number of the step is finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.numbers().iter().all(|number| number.is_finite())
    }

    /// Counts a displacement that was held or limited.
    pub(crate) fn count_rejected_input(&mut self) {
        self.rejected_inputs = self.rejected_inputs.saturating_add(1);
    }

    /// Sets status bits.
    #[inline(always)]
    pub(crate) fn latch(&mut self, status: Status) {
        self.status_word |= status.bits();
    }

    /// Clears the status bits and the counter.
    pub fn clear_status(&mut self) {
        self.status_word &= MARK_BITS;
        self.rejected_inputs = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::{DamperState, MARK, MARK_BITS};
    use crate::status::Status;

    #[test]
    fn the_mark_and_the_status_share_no_bit() {
        assert_eq!(Status::from_bits_truncate(!MARK_BITS).bits(), !MARK_BITS);
        assert_eq!(MARK & !MARK_BITS, 0);
    }

    #[test]
    fn clearing_the_status_clears_the_count_and_nothing_else() {
        let numbers = [1.0, 2.0, 3.0, 4.0];
        let mut state = DamperState::new(numbers, 7, Status::SATURATED | Status::RESTARTED, 9);
        state.clear_status();
        assert_eq!(state, DamperState::new(numbers, 7, Status::empty(), 0));
        assert!(state.is_marked());
    }

    #[test]
    fn memory_that_was_never_written_has_no_mark() {
        let patterns = [
            0x0000, 0xffff, 0xa5a5, 0x5a5a, 0xaaaa, 0x5555, 0xcccc, 0xcdcd, 0xdead, 0xbeef, 0xfdfd,
            0xbaad, 0xf00d, 0xfeed, 0x0badu16,
        ];
        for pattern in patterns {
            let state = DamperState::<f32> {
                status_word: pattern,
                ..DamperState::default()
            };
            assert!(!state.is_marked(), "{pattern:#x}");
        }
        assert!(DamperState::<f32>::default().is_marked());
    }

    #[test]
    fn a_state_tells_its_numbers_and_the_damper_of_its_last_step() {
        let numbers = [0.75, 0.25, 3.0, -2400.0];
        let state = DamperState::new(numbers, 7, Status::SATURATED, 2);
        assert_eq!(state.displacement_m(), 0.75);
        assert_eq!(state.piston_displacement_m(), 0.5, "without the stretch");
        assert_eq!(state.force_n(), -2400.0);
        assert_eq!(state.revision(), 7);
        assert_eq!(state.status(), Status::SATURATED);
        assert_eq!(state.rejected_inputs(), 2);
        assert_eq!(DamperState::<f64>::default().revision(), 0, "no step yet");
    }

    #[test]
    fn a_state_is_finite_if_each_of_its_numbers_is() {
        assert!(DamperState::<f64>::default().is_finite());
        for index in 0..4 {
            for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut numbers = [0.0; 4];
                numbers[index] = number;
                let state = DamperState::new(numbers, 1, Status::empty(), 0);
                assert!(!state.is_finite(), "{number} at {index}");
            }
        }
    }
}
