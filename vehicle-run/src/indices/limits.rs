//! Forces judged by their limits.

use serde::Serialize;

use super::{WheelIndices, WheelsetIndices};

/// The greatest value of a force over all wheels or wheelsets, relative to its limit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Judged {
    /// The force.
    pub quantity: &'static str,
    /// Wheel or wheelset with the greatest value.
    pub of: String,
    /// Value, N or dimensionless.
    pub value: f64,
    /// Limit, N or dimensionless.
    pub limit: f64,
    /// Value divided by the limit.
    pub ratio: f64,
}

impl Judged {
    fn new(quantity: &'static str, of: String, value: f64, ratio: f64) -> Self {
        Self {
            quantity,
            of,
            value,
            limit: value / ratio,
            ratio,
        }
    }

    /// True if the force is within its limit.
    pub fn is_kept(&self) -> bool {
        self.ratio <= 1.0
    }
}

/// Returns each force with its greatest ratio to the limit: lateral force of a wheelset (Prud'homme), load of a wheel
/// (EN 14363) and `Y/Q` (Nadal). A force without a limit, or always zero, is left out.
pub(super) fn judged(wheelsets: &[WheelsetIndices]) -> Vec<Judged> {
    let lateral = wheelsets.iter().filter_map(|wheelset| {
        Some(Judged::new(
            "lateral force",
            wheelset.wheelset.clone(),
            wheelset.lateral_force_greatest_n,
            wheelset.lateral_force_over_limit?,
        ))
    });
    let of_wheels = |judge: fn(&WheelIndices, String) -> Option<Judged>| {
        wheelsets.iter().flat_map(move |wheelset| {
            let wheels = wheelset.wheels.iter();
            wheels.filter_map(move |wheel| {
                judge(wheel, format!("{}, {}", wheelset.wheelset, wheel.side))
            })
        })
    };
    let load = of_wheels(|wheel, of| {
        let ratio = wheel.load_over_limit?;
        Some(Judged::new(
            "wheel load",
            of,
            wheel.filtered_load_greatest_n,
            ratio,
        ))
    });
    let climbing = of_wheels(|wheel, of| {
        let (value, ratio) = (wheel.derailment_climbing, wheel.derailment_over_nadal);
        Some(Judged::new("Y/Q", of, value, ratio))
    });
    let greatest = |judged: &mut dyn Iterator<Item = Judged>| {
        judged
            .filter(|judged| judged.ratio > 0.0)
            .max_by(|a, b| a.ratio.total_cmp(&b.ratio))
    };
    let (mut lateral, mut load, mut climbing) = (lateral, load, climbing);
    [
        greatest(&mut lateral),
        greatest(&mut load),
        greatest(&mut climbing),
    ]
    .into_iter()
    .flatten()
    .collect()
}
