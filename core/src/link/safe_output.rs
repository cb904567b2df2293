//! Safe outputs after the link is lost or memory is damaged while the device is free-running.

use serde::{Deserialize, Serialize};

/// Condition at which the link counts as lost, and the output from then on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LossOfLink {
    /// Number of ticks without new displacements before the link is lost, at least 1.
    pub after_ticks: u32,
    /// Output after the loss.
    pub output: SafeOutput,
}

impl Default for LossOfLink {
    /// The link is lost after 100 ticks, and the output then falls to zero in 100 ticks: 0.1 s each at 1 kHz.
    fn default() -> Self {
        Self {
            after_ticks: 100,
            output: SafeOutput::RampToZero { ticks: 100 },
        }
    }
}

/// Output of every damper after the loss of the link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum SafeOutput {
    /// Holds the last good force. For a damaged damper this is the force when a check last found it sound.
    Hold,
    /// Falls from the force of [`SafeOutput::Hold`] to zero in equal steps.
    RampToZero {
        /// Number of ticks from the loss to zero.
        ticks: u32,
    },
    /// Sets the output to zero immediately.
    Zero,
}

/// Counts silent ticks (without new displacements) and computes the outputs of each tick.
#[derive(Clone, Debug)]
pub(crate) struct Watch<const N: usize> {
    configuration: LossOfLink,
    silent_ticks: u32,
    /// Number of ticks with safe outputs so far.
    safe_ticks: u32,
    /// Last output before the safe output (N); for damaged dampers, the output before the damage.
    last_good: [f32; N],
}

impl<const N: usize> Watch<N> {
    /// A watch before its configuration: all bits are zero.
    pub(crate) const fn new() -> Self {
        Self {
            configuration: LossOfLink {
                after_ticks: 0,
                output: SafeOutput::Hold,
            },
            silent_ticks: 0,
            safe_ticks: 0,
            last_good: [0.0; N],
        }
    }

    /// Sets the configuration. The ticks that have been silent so far never cause an immediate loss of the link.
    pub(crate) fn configure(&mut self, configuration: LossOfLink) {
        self.silent_ticks = self.silent_ticks.min(configuration.after_ticks);
        self.configuration = configuration;
    }

    /// Records the arrival of new displacements.
    pub(crate) fn alive(&mut self) {
        self.silent_ticks = 0;
    }

    /// Starts again when the free-running tick starts or stops.
    pub(crate) fn restart(&mut self) {
        self.alive();
        self.safe_ticks = 0;
    }

    pub(crate) fn lost(&self) -> bool {
        self.silent_ticks > self.configuration.after_ticks
    }

    /// Forces (N) that the safe output holds or starts from; the guard replaces those of damaged dampers.
    pub(crate) fn last_good_mut(&mut self) -> &mut [f32; N] {
        &mut self.last_good
    }

    /// Returns the outputs of a tick with these forces (N), and true if the link was lost at this tick. Damaged memory
    /// also causes safe outputs.
    pub(crate) fn output(&mut self, forces: &[f32; N], damaged: bool) -> ([f32; N], bool) {
        let was_lost = self.lost();
        self.silent_ticks = self.silent_ticks.saturating_add(1);
        let lost = self.lost() && !was_lost;
        if !self.lost() && !damaged {
            self.last_good = *forces;
            return (*forces, false);
        }
        self.safe_ticks = self.safe_ticks.saturating_add(1);
        let since = self.safe_ticks;
        let share = match self.configuration.output {
            SafeOutput::Hold => 1.0,
            SafeOutput::Zero => 0.0,
            SafeOutput::RampToZero { ticks } if since < ticks => {
                (ticks - since) as f32 / ticks as f32
            }
            SafeOutput::RampToZero { .. } => 0.0,
        };
        (self.last_good.map(|force| force * share), lost)
    }
}

#[cfg(test)]
mod tests {
    use super::{LossOfLink, SafeOutput, Watch};

    fn outputs(output: SafeOutput) -> [f32; 8] {
        let mut watch = Watch::<1>::new();
        watch.configure(LossOfLink {
            after_ticks: 3,
            output,
        });
        core::array::from_fn(|tick| {
            let ([force], lost) = watch.output(&[100.0 + tick as f32], false);
            assert_eq!(lost, tick == 3);
            force
        })
    }

    #[test]
    fn hold_keeps_the_last_good_force() {
        let expected = [100.0, 101.0, 102.0, 102.0, 102.0, 102.0, 102.0, 102.0];
        assert_eq!(outputs(SafeOutput::Hold), expected);
    }

    #[test]
    fn zero_is_zero_at_once() {
        let expected = [100.0, 101.0, 102.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(outputs(SafeOutput::Zero), expected);
    }

    #[test]
    fn a_ramp_falls_in_equal_parts() {
        let expected = [100.0, 101.0, 102.0, 76.5, 51.0, 25.5, 0.0, 0.0];
        assert_eq!(outputs(SafeOutput::RampToZero { ticks: 4 }), expected);
        assert_eq!(outputs(SafeOutput::RampToZero { ticks: 0 })[3], 0.0);
    }

    #[test]
    fn a_stricter_configuration_loses_the_link_at_the_next_silent_tick() {
        let mut watch = Watch::<1>::new();
        watch.configure(LossOfLink::default());
        for _ in 0..50 {
            assert_eq!(watch.output(&[7.0], false), ([7.0], false));
        }
        watch.configure(LossOfLink {
            after_ticks: 1,
            output: SafeOutput::RampToZero { ticks: 100 },
        });
        assert!(!watch.lost());
        assert_eq!(watch.output(&[7.0], false), ([7.0 * 0.99], true));
    }

    #[test]
    fn a_displacement_in_time_keeps_the_link() {
        let mut watch = Watch::<1>::new();
        watch.configure(LossOfLink::default());
        for _ in 0..10_000 {
            watch.alive();
            for _ in 0..100 {
                assert_eq!(watch.output(&[7.0], false), ([7.0], false));
            }
        }
        assert_eq!(watch.output(&[7.0], false), ([7.0 * 0.99], true));
    }

    #[test]
    fn damage_starts_the_safe_output_and_a_lost_link_continues_it() {
        let mut watch = Watch::<1>::new();
        watch.configure(LossOfLink {
            after_ticks: 2,
            output: SafeOutput::RampToZero { ticks: 4 },
        });
        assert_eq!(watch.output(&[8.0], false), ([8.0], false));
        assert_eq!(watch.output(&[9.0], true), ([6.0], false));
        assert_eq!(watch.output(&[9.0], true), ([4.0], true));
        assert_eq!(watch.output(&[9.0], true), ([2.0], false));
        assert_eq!(watch.output(&[9.0], true), ([0.0], false));
        watch.restart();
        assert_eq!(watch.output(&[9.0], false), ([9.0], false));
    }
}
