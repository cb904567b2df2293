//! Elastic energy of the contact.

use super::motion::{Motion, RailDisplacement};
use super::source::{PatchReader, PatchSource};
use super::wheelset::WheelsetContact;
use super::zones::ZONES;
use crate::creep::CreepLaw;
use crate::math::dispatch::dispatch;

/// Number of intervals of Simpson's rule, an even number.
const INTERVALS: usize = 64;

impl<L: CreepLaw, S: PatchSource> WheelsetContact<L, S> {
    /// Elastic energy of the contact of the left and the right wheel, J: the integral of the vertical force over the
    /// depth, from the first touch to the depth of the wheel.
    ///
    /// Not for real time: it reads the contact at many depths. Damping and friction store no energy.
    ///
    /// ```
    /// # use std::sync::Arc;
    /// # use dashpot_rail::contact::{
    /// #     ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact,
    /// # };
    /// # use dashpot_rail::creep::{Friction, Polach};
    /// # let pair = Pair::standard(Installation::default())?;
    /// # let tables = Tables::new(ContactGeometry::new(pair, Steel::default())?);
    /// # let contact = WheelsetContact::new(Arc::new(tables), Polach, Friction::default())?;
    /// let motion = Motion { lateral_m: -5e-3, vertical_m: 0.35e-3, ..Motion::default() };
    /// let rails = [RailDisplacement::default(); 2];
    /// let [_, right_j] = contact.elastic_energy_j(&motion, &rails);
    /// let patch = contact.forces(&motion, &rails).wheels[1].loaded_patches().next().copied().unwrap();
    /// // Hertz: 2/5 of the load times the penetration.
    /// assert!((right_j / (0.4 * patch.load_n * patch.penetration_m) - 1.0).abs() < 0.05);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn elastic_energy_j(&self, motion: &Motion, rails: &[RailDisplacement; 2]) -> [f64; 2] {
        if !(motion.is_accepted() && rails.iter().all(RailDisplacement::is_accepted)) {
            return [0.0; 2];
        }
        [0, 1].map(|side| {
            let moving = self.moving_wheel(side, motion, rails);
            let (pose, depth_m) = (moving.pose(), moving.depth.value());
            let source = self.sources[side].as_ref();
            let reader =
                |depth_m: f64| dispatch!(self.level, simd => source.locate(simd, &pose, depth_m));
            let approach_m = reader(depth_m).approach_m().max(0.0);
            // The force rises with the power 3/2 of the depth; over the root of the depth it is smooth.
            let term = |k: usize| {
                let root = k as f64 / INTERVALS as f64;
                let reader = reader(depth_m - approach_m * (1.0 - root * root));
                let loaded = reader.loaded_zones();
                let zones = (0..ZONES).filter(|zone| loaded >> zone & 1 == 1);
                let vertical = zones.map(|zone| {
                    let numbers = reader.numbers(zone);
                    numbers.load * (1.0 - numbers.sine * numbers.sine).max(0.0).sqrt()
                });
                let weight = match k {
                    0 | INTERVALS => 1.0,
                    _ if k % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                weight * 2.0 * root * vertical.sum::<f64>()
            };
            approach_m * (0..=INTERVALS).map(term).sum::<f64>() / (3.0 * INTERVALS as f64)
        })
    }
}
