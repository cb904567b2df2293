//! Extremes of a wheelset's contact within a tick.

use std::array::from_fn;

use crate::contact::WheelsetForces;

/// Extremes of a wheelset's contact over a time in which it is evaluated several times.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Extremes {
    /// Minimum load of the left and right wheel, N.
    pub least_loads_n: [f64; 2],
    /// Maximum load of the left and right wheel, N.
    pub greatest_loads_n: [f64; 2],
    /// Maximum power that creep dissipates on both wheels, W.
    pub greatest_dissipation_w: f64,
}

impl Extremes {
    /// Extremes of no contact at all, to which contacts are added.
    pub const NONE: Self = Self {
        least_loads_n: [f64::INFINITY; 2],
        greatest_loads_n: [0.0; 2],
        greatest_dissipation_w: 0.0,
    };

    /// Adds the contact at one time.
    ///
    /// ```
    /// use dashpot_rail::contact::WheelsetForces;
    /// use dashpot_rail::vehicle::Extremes;
    /// let mut contact = WheelsetForces::default();
    /// let mut extremes = Extremes::NONE;
    /// for load_n in [80e3, 120e3, 100e3] {
    ///     contact.wheels[0].force_n[2] = -load_n;
    ///     extremes.add(&contact);
    /// }
    /// assert_eq!((extremes.least_loads_n[0], extremes.greatest_loads_n[0]), (80e3, 120e3));
    /// ```
    #[inline(always)]
    pub fn add(&mut self, contact: &WheelsetForces) {
        let loads = self
            .least_loads_n
            .iter_mut()
            .zip(&mut self.greatest_loads_n);
        for ((least_n, greatest_n), wheel) in loads.zip(&contact.wheels) {
            let load_n = wheel.load_n();
            *least_n = least_n.min(load_n);
            *greatest_n = greatest_n.max(load_n);
        }
        self.greatest_dissipation_w = self.greatest_dissipation_w.max(contact.dissipation_w());
    }

    /// Adds the extremes of another time.
    pub fn merge(&mut self, other: &Self) {
        for side in 0..2 {
            self.least_loads_n[side] = self.least_loads_n[side].min(other.least_loads_n[side]);
            self.greatest_loads_n[side] =
                self.greatest_loads_n[side].max(other.greatest_loads_n[side]);
        }
        self.greatest_dissipation_w = self
            .greatest_dissipation_w
            .max(other.greatest_dissipation_w);
    }
}

/// Loads of the left and right wheel of a wheelset in the last two steps, N: a short impact may have its peak between
/// steps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct LastLoads([[f64; 2]; 2]);

impl LastLoads {
    /// Loads that have not changed.
    pub fn constant(contact: &WheelsetForces) -> Self {
        Self(from_fn(|side| [contact.wheels[side].load_n(); 2]))
    }

    /// Adds the loads of a step, and to `extremes` the vertex of the parabola through the last three loads if the one
    /// in the middle is the greatest. The vertex is above it by at most an eighth of the change over both steps.
    ///
    /// A least load is taken as it is: near the point where the wheel lifts, a parabola would go too far.
    #[inline(always)]
    pub fn add(&mut self, contact: &WheelsetForces, extremes: &mut Extremes) {
        for (side, (last, wheel)) in self.0.iter_mut().zip(&contact.wheels).enumerate() {
            let ([before, middle], after) = (*last, wheel.load_n());
            *last = [middle, after];
            let (rise, fall) = (middle - before, middle - after);
            if rise > 0.0 && fall >= 0.0 {
                let change = after - before;
                let vertex_n = middle + 0.125 * change * change / (rise + fall);
                let greatest_n = &mut extremes.greatest_loads_n[side];
                *greatest_n = greatest_n.max(vertex_n);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Extremes of a right wheel whose load is one of these after another.
    fn extremes(loads_n: impl IntoIterator<Item = f64>) -> Extremes {
        let mut contact = WheelsetForces::default();
        let mut last = None;
        let mut extremes = Extremes::NONE;
        for load_n in loads_n {
            contact.wheels[1].force_n[2] = -load_n;
            let last = last.get_or_insert_with(|| LastLoads::constant(&contact));
            extremes.add(&contact);
            last.add(&contact, &mut extremes);
        }
        extremes
    }

    /// A load of `100 + 50 cos(w t + phase)` kN in steps of `w h = 0.7`: the steps miss up to 3 kN, the parabola up
    /// to 270 N.
    #[test]
    fn a_peak_between_steps_is_found() {
        for phase in [0.0, 0.1, 0.2, 0.35, 0.5, 0.6] {
            let load_n = |step| 100e3 + 50e3 * (0.7 * f64::from(step) + phase).cos();
            let found = extremes((-5..5).map(load_n));
            let greatest_n = found.greatest_loads_n[1];
            assert!((greatest_n - 150e3).abs() < 280.0, "{greatest_n}");
        }
    }

    #[test]
    fn a_constant_load_and_the_least_load_are_taken_as_they_are() {
        let found = extremes([30e3, 30e3, 30e3]);
        assert_eq!(
            (found.least_loads_n[1], found.greatest_loads_n[1]),
            (30e3, 30e3)
        );
        assert_eq!(extremes([30e3, 1e3, 20e3]).least_loads_n[1], 1e3);
    }
}
