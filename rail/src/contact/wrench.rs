//! Force and moment of a rail on its wheel.

use crate::math::each::Each;

/// Force, N, and moment about the wheelset's centre, N m, in track axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wrench<T> {
    pub force: [T; 3],
    pub moment: [T; 3],
}

impl<T: Copy> Wrench<T> {
    /// A wrench whose components are all `value`.
    #[inline(always)]
    pub fn splat(value: T) -> Self {
        Self {
            force: [value; 3],
            moment: [value; 3],
        }
    }

    /// Replaces each component by `sum(component, component of other)`.
    #[inline(always)]
    pub fn accumulate<U: Copy>(&mut self, other: &Wrench<U>, sum: impl Fn(T, U) -> T) {
        for (total, term) in self.force.iter_mut().zip(other.force) {
            *total = sum(*total, term);
        }
        for (total, term) in self.moment.iter_mut().zip(other.moment) {
            *total = sum(*total, term);
        }
    }

    /// Applies `function` to each component.
    #[inline(always)]
    pub fn map<U: Copy>(self, function: impl Fn(T) -> U) -> Wrench<U> {
        Wrench {
            force: self.force.each(&function),
            moment: self.moment.each(&function),
        }
    }
}
