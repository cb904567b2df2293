//! A motion at ticks, and the ticks at which the reference is solved for it.

use std::fmt;

/// Ticks of a rest that are all compared; beyond them the gaps grow.
const CLOSE_TICKS: usize = 16;

/// What a probing motion does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// Constant speed to and fro, the force settling each way.
    Saw,
    /// Constant speed, a sudden stop, rest, back.
    MoveAndStop,
    /// Constant speed across the clearance and little beyond, to and fro.
    Crossing,
    /// Speeds that change suddenly, after a few ticks each: reversals among them.
    ChangingSpeed,
    /// Random to 20 Hz.
    Ride,
    /// Speed rising and falling evenly, out and back.
    Ramp,
    /// A rest of a minute under force.
    Hold,
    /// Given from outside.
    Other,
}

impl Kind {
    /// Its name in words.
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

/// A motion at ticks, linear between them, every displacement a number of `f32`: step in either scalar and reference
/// follow the same motion.
#[derive(Clone, Debug)]
pub struct Motion {
    /// What it does.
    pub kind: Kind,
    /// Its largest or effective speed (m/s).
    pub speed_m_per_s: f64,
    /// Displacement at each tick (m).
    pub displacements_m: Vec<f64>,
    /// Ticks at which forces are compared, rising from 0; between two of them the motion is linear.
    pub(super) compared: Vec<usize>,
    /// Ticks at which parts end that have an NRMSE each, rising; the motion's is the largest of them.
    pub(super) part_ends: Vec<usize>,
}

impl Motion {
    /// The motion through these displacements (m), each rounded to `f32`.
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

/// Every tick, but of a long rest only some: there the reference needs no more of them, and a minute has many.
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

/// Pieces of constant speed, one after the other.
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

    /// Where it has come to (m).
    pub(super) fn x(&self) -> f64 {
        self.x
    }

    /// Goes on at a speed (m/s), 0 for a rest.
    pub(super) fn go(&mut self, speed_m_per_s: f64, ticks: usize) {
        for _ in 0..ticks {
            self.x += speed_m_per_s * self.step_s;
            self.displacements_m.push(self.x);
        }
    }

    /// Ends a part that might be repeated for as long as one likes: its NRMSE counts by itself.
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
