//! Extremes of a wheelset's contact within a tick.

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
            // Subtracting from zero avoids -0.0 for a lifted wheel.
            let load_n = 0.0 - wheel.force_n[2];
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
