//! Faults of a virtual rig.

use dashpot_core::CheckedParameters;

/// One of the two readings of a rig.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// The displacement.
    Displacement,
    /// The force.
    Force,
}

/// A fault of a virtual rig. Faults add up; none ends, except silence.
#[derive(Clone, Debug)]
pub enum RigFault {
    /// The specimen becomes this damper, such as the same with another clearance or colder oil. Its force goes on from
    /// the present one.
    Specimen(Box<CheckedParameters>),
    /// The specimen breaks: no force from now on.
    Broken,
    /// The supply of the actuator falls to this share of its pressure.
    Weak(f64),
    /// The noise of both sensors grows by this factor.
    Noisy(f64),
    /// A sensor repeats its last reading.
    Stuck(Reading),
    /// A sensor reads the opposite sign.
    Reversed(Reading),
    /// No readings for this number of ticks.
    Silent(u32),
}

/// Faults of both sensors, displacement first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SensorFaults {
    pub(super) stuck: [bool; 2],
    pub(super) reversed: [bool; 2],
    pub(super) silent_ticks: u32,
    last: [Option<f64>; 2],
}

impl SensorFaults {
    /// Returns what is left of the readings.
    pub(super) fn changed(&mut self, read: [Option<f64>; 2]) -> [Option<f64>; 2] {
        if self.silent_ticks > 0 {
            self.silent_ticks -= 1;
            return [None; 2];
        }
        let mut place = 0..;
        read.map(|read| {
            let place = place.next().unwrap_or_default();
            let last = &mut self.last[place];
            match *last {
                Some(repeated) if self.stuck[place] => Some(repeated),
                _ => {
                    let signed = read.map(|x| if self.reversed[place] { -x } else { x });
                    *last = signed.or(*last);
                    signed
                }
            }
        })
    }
}
