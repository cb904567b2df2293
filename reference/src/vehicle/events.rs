//! Events: a damper, stop or friction element leaves a range of its law.

use dashpot_rail::contact::PatchSource;
use dashpot_rail::creep::CreepLaw;

use super::equations::{Equations, N, Ranged, Situation};

impl<L: CreepLaw, S: PatchSource> Equations<'_, L, S> {
    /// Distances of each damper, stop and friction element to the two ends of its range.
    pub(super) fn margins(
        &self,
        situation: &mut Situation<'_>,
        time: f64,
        state: &[f64],
    ) -> Vec<f64> {
        situation.follow(time);
        let extensions = self.extensions(situation.following(), state);
        let margins = |number: usize| {
            let (range, at) = (situation.ranges[number], extensions[number]);
            match &self.ranged[number] {
                Ranged::Damper(damper, chain) => {
                    let from_piston = at.displacement - self.pistons(state)[*damper];
                    chain.margins(range, from_piston, at.velocity)
                }
                Ranged::Stop(stop) => stop.ranges.margins(range, at.displacement),
                Ranged::Friction(slider, friction) => {
                    friction.margins(range, &at, situation.sliders[*slider])
                }
            }
        };
        (0..self.ranged.len()).flat_map(margins).collect()
    }

    /// Updates the range of each damper, stop and friction element, and returns the number of changes. The piston of a
    /// damper that stops yielding is set to the position of the yield force, and the slider of an element that stops
    /// sliding to that of the limit.
    pub(super) fn settle(
        &self,
        situation: &mut Situation<'_>,
        time: f64,
        state: &mut [f64],
    ) -> usize {
        situation.follow(time);
        let extensions = self.extensions(situation.following(), state);
        let mut changes = 0;
        for (number, at) in extensions.into_iter().enumerate() {
            let before = situation.ranges[number];
            let now = match &self.ranged[number] {
                Ranged::Damper(damper, chain) => {
                    let piston = &mut state[2 * N * self.bodies() + damper];
                    let (range, from_piston) =
                        chain.settled(before, at.displacement - *piston, at.velocity);
                    if range != before {
                        *piston = at.displacement - from_piston;
                    }
                    range
                }
                Ranged::Stop(stop) => stop.ranges.settled(before, at.displacement),
                Ranged::Friction(slider, friction) => {
                    let slider = &mut situation.sliders[*slider];
                    let (range, position) = friction.settled(before, &at, *slider);
                    *slider = position;
                    range
                }
            };
            situation.ranges[number] = now;
            changes += usize::from(now != before);
        }
        changes
    }
}
