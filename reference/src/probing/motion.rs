//! A motion sampled at ticks, and the ticks at which forces are compared.

use std::fmt;

/// Number of ticks at the start of a rest that are all compared; after them, the gaps between compared ticks grow.
const CLOSE_TICKS: usize = 16;

/// Kind of a probing motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// Constant speed to and fro; the force settles in each direction.
    Saw,
    /// Constant speed, a sudden stop, rest, back.
    MoveAndStop,
    /// Constant speed to and fro, across the clearance and slightly beyond.
    Crossing,
    /// Sudden changes of speed after a few ticks, including reversals.
    ChangingSpeed,
    /// Random motion up to 20 Hz.
    Ride,
    /// Linearly rising and falling speed, out and back.
    Ramp,
    /// A one-minute rest under force.
    Hold,
    /// Supplied by the caller.
    Other,
}

impl Kind {
    /// Readable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Saw => "saw",
            Self::MoveAndStop => "move and stop",
            Self::Crossing => "crossing of the clearance",
            Self::ChangingSpeed => "changing speed",
            Self::Ride => "random ride",
            Self::Ramp => "speed ramp",
            Self::Hold => "hold",
            Self::Other => "other motion",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A motion sampled at ticks and linear between them. Each displacement is an `f32` value, so that steps in both
/// precisions and the reference follow the same motion.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Kind of the motion.
    pub kind: Kind,
    /// Largest or RMS speed (m/s).
    pub speed_m_per_s: f64,
    /// Displacement at each tick (m).
    pub displacements_m: Vec<f64>,
    /// Ticks at which forces are compared, increasing from 0; the motion is linear between successive ones.
    pub(super) compared: Vec<usize>,
    /// Ticks at which parts end, increasing. The NRMSE of the motion is the largest NRMSE of its parts.
    pub(super) part_ends: Vec<usize>,
}

impl Motion {
    /// Builds the motion through the displacements (m), each rounded to `f32`.
    pub fn new(kind: Kind, speed_m_per_s: f64, displacements_m: Vec<f64>) -> Self {
        let displacements_m: Vec<f64> = displacements_m
            .into_iter()
            .map(|x| f64::from(x as f32))
            .collect();
        Self {
            kind,
            speed_m_per_s,
            compared: compared(&displacements_m),
            part_ends: Vec::new(),
            displacements_m,
        }
    }
}

/// Ticks to compare: all, except that the gaps between them grow within a long rest.
fn compared(displacements_m: &[f64]) -> Vec<usize> {
    let mut compared = Vec::new();
    let (mut rested, mut next) = (0, 0);
    for (tick, x) in displacements_m.iter().enumerate() {
        let rests = |other: Option<&f64>| other == Some(x);
        let before = tick
            .checked_sub(1)
            .and_then(|tick| displacements_m.get(tick));
        if !rests(before) {
            (rested, next) = (0, 0);
        }
        if rested >= next || !rests(displacements_m.get(tick + 1)) {
            compared.push(tick);
            next = if rested < CLOSE_TICKS {
                rested + 1
            } else {
                rested + rested / 4
            };
        }
        rested += 1;
    }
    compared
}

/// Builder of a motion from pieces of constant speed.
pub(super) struct Path {
    step_s: f64,
    x: f64,
    displacements_m: Vec<f64>,
    part_ends: Vec<usize>,
}

impl Path {
    pub(super) fn new(step_s: f64) -> Self {
        Self {
            step_s,
            x: 0.0,
            displacements_m: vec![0.0],
            part_ends: Vec::new(),
        }
    }

    /// Current displacement (m).
    pub(super) fn x(&self) -> f64 {
        self.x
    }

    /// Adds a piece at a speed (m/s), 0 for a rest.
    pub(super) fn go(&mut self, speed_m_per_s: f64, ticks: usize) {
        for _ in 0..ticks {
            self.x += speed_m_per_s * self.step_s;
            self.displacements_m.push(self.x);
        }
    }

    /// Ends a part of the motion. Each part has its own NRMSE, because a motion may repeat it any number of times.
    pub(super) fn end_part(&mut self) {
        self.part_ends.push(self.displacements_m.len() - 1);
    }

    pub(super) fn end(self, kind: Kind, speed_m_per_s: f64) -> Motion {
        Motion {
            part_ends: self.part_ends,
            ..Motion::new(kind, speed_m_per_s, self.displacements_m)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_is_linear_between_the_ticks_compared() {
        let mut path = Path::new(1e-3);
        path.go(0.1, 7);
        path.go(0.0, 1000);
        path.go(-0.1, 3);
        let motion = path.end(Kind::Saw, 0.1);
        let x = &motion.displacements_m;
        assert!(motion.compared.len() < 60, "{}", motion.compared.len());
        assert_eq!(motion.compared[..10], [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
        assert_eq!(motion.compared.last(), Some(&(x.len() - 1)));
        for pair in motion.compared.windows(2) {
            let constant = x[pair[0]..=pair[1]].iter().all(|x_m| *x_m == x[pair[0]]);
            assert!(pair[1] == pair[0] + 1 || constant, "{pair:?}");
        }
    }
}
