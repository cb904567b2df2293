//! Running conditions of a wheel and their shares of the distance.

/// Lateral position of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Position {
    /// Shift from the centred position, field side positive, m.
    ShiftM(f64),
    /// The shift at which the normal forces push the wheel towards the track centre with this force, N: a flange that
    /// is pressed against the rail, however worn it is.
    PressedN(f64),
}

/// One running condition of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Condition {
    /// Lateral position.
    pub position: Position,
    /// Yaw, nose to the field side positive, rad.
    pub yaw_rad: f64,
    /// Normal load, N.
    pub load_n: f64,
    /// Share of the distance, relative to the sum of all shares.
    pub share: f64,
}

/// Running conditions and their shares of the distance.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Collective {
    /// The conditions.
    pub conditions: Vec<Condition>,
}

/// Load of a wheel, N.
const LOAD_N: f64 = 100e3;

impl Collective {
    /// Adds a condition.
    pub fn with(mut self, position: Position, yaw_rad: f64, load_n: f64, share: f64) -> Self {
        self.conditions.push(Condition {
            position,
            yaw_rad,
            load_n,
            share,
        });
        self
    }

    /// Straight running: shifts of up to 4 mm, of a normal distribution with a standard deviation of 2 mm, at yaws of a
    /// hunting wheelset of up to 1 mrad, and loads that alternate by a tenth.
    pub fn straight() -> Self {
        (-12_i32..=12).fold(Self::default(), |collective, step| {
            let shift_m = 4e-3 / 12.0 * f64::from(step);
            let load_n = LOAD_N * if step % 2 == 0 { 0.95 } else { 1.05 };
            let yaw_rad = 1e-3 * f64::from(step.rem_euclid(3) - 1);
            let share = libm::exp(-0.5 * (shift_m / 2e-3).powi(2));
            collective.with(Position::ShiftM(shift_m), yaw_rad, load_n, share)
        })
    }

    /// Outer wheels of leading wheelsets in wide and sharp curves: the normal forces press the flange by 20 to 95 kN at
    /// yaws of 2 to 8 mrad. At 95 kN the flange carries most of the load.
    pub fn outer_wheel() -> Self {
        [
            (20e3, 2e-3, 0.3),
            (45e3, 4e-3, 0.3),
            (70e3, 6e-3, 0.25),
            (95e3, 8e-3, 0.15),
        ]
        .into_iter()
        .fold(
            Self::default(),
            |collective, (lateral_n, yaw_rad, share)| {
                let position = Position::PressedN(lateral_n);
                collective.with(position, yaw_rad, 1.1 * LOAD_N, share)
            },
        )
    }

    /// Inner wheels of the same curves, whose treads roll near the field side.
    pub fn inner_wheel() -> Self {
        [
            (-4e-3, 2e-3, 0.3),
            (-6e-3, 4e-3, 0.3),
            (-8e-3, 6e-3, 0.25),
            (-10e-3, 8e-3, 0.15),
        ]
        .into_iter()
        .fold(Self::default(), |collective, (shift_m, yaw_rad, share)| {
            collective.with(Position::ShiftM(shift_m), yaw_rad, 0.9 * LOAD_N, share)
        })
    }

    /// Shifts over the whole clearance at small yaws, which wears wheel and rail to each other's shape.
    pub fn conforming() -> Self {
        (-8_i32..=12).fold(Self::default(), |collective, step| {
            let shift_m = 0.5e-3 * f64::from(step);
            let yaw_rad = 2e-3 * f64::from(step.rem_euclid(2));
            collective.with(Position::ShiftM(shift_m), yaw_rad, LOAD_N, 1.0)
        })
    }

    /// This collective for `1 - share` of the distance, and `other` for the rest.
    pub fn mixed(self, other: Self, share: f64) -> Self {
        let scaled = |collective: Self, part: f64| {
            let total: f64 = collective.conditions.iter().map(|one| one.share).sum();
            collective.conditions.into_iter().map(move |one| Condition {
                share: part * one.share / total,
                ..one
            })
        };
        Self {
            conditions: scaled(self, 1.0 - share)
                .chain(scaled(other, share))
                .collect(),
        }
    }
}
