//! Load and motion of the wheelset of `dashpot contact`.

use std::sync::Arc;

use dashpot_rail::contact::{ContactGeometry, Steel};
use dashpot_rail::indices::RollingRadiusDifference;
use dashpot_study::loaded_wheelset::{LoadedShift, LoadedWheelset, LoadedWheelsetError, Running};

use super::{Sides, failure};
use crate::commands::failure::{Failure, Outcome};

/// Load and motion of the wheelset.
#[derive(Debug, Clone, clap::Args)]
pub struct LoadArguments {
    /// Vertical load of each wheel, kN. With it, patches, pressures, creepages and forces are computed, and the
    /// equivalent conicity on elastic patches.
    #[arg(long)]
    pub load_kn: Option<f64>,
    /// Lateral shifts at which patches are computed, mm, positive to the right [default: 0 to 8; from -8 if the
    /// wheelset is yawed or its sides differ].
    #[arg(
        long,
        value_delimiter = ',',
        allow_hyphen_values = true,
        requires = "load_kn"
    )]
    pub lateral_mm: Vec<f64>,
    /// Yaw of the wheelset, mrad, nose to the right positive [default: 0].
    #[arg(long, requires = "load_kn")]
    pub yaw_mrad: Option<f64>,
    /// Speed, km/h [default: 100].
    #[arg(long, requires = "load_kn")]
    pub speed_km_h: Option<f64>,
    /// Friction coefficient [default: 0.4].
    #[arg(long, requires = "load_kn")]
    pub friction: Option<f64>,
}

/// Contact of the wheelset under its load.
pub(super) struct UnderLoad {
    pub running: Running,
    pub shifts: Vec<LoadedShift>,
    /// Rolling radius difference on elastic patches.
    pub rolling: RollingRadiusDifference,
}

impl LoadArguments {
    /// Computes the contact of the wheelset under its load; `None` without a load.
    ///
    /// # Errors
    /// An option is out of range, or the wheelset has no contact when centred.
    pub(super) fn compute(&self, sides: &Sides) -> Outcome<Option<UnderLoad>> {
        let Some(load_kn) = self.load_kn else {
            return Ok(None);
        };
        let usual = Running::default();
        let running = Running::default()
            .with_load_n(1e3 * load_kn)
            .with_speed_m_per_s(
                self.speed_km_h
                    .map_or(usual.speed_m_per_s, |speed| speed / 3.6),
            )
            .with_yaw_rad(1e-3 * self.yaw_mrad.unwrap_or(0.0))
            .with_friction(self.friction.unwrap_or(usual.friction));
        let geometry = |pair: &dashpot_rail::contact::Pair| {
            ContactGeometry::new(pair.clone(), Steel::default())
                .map(Arc::new)
                .map_err(failure)
        };
        let right = geometry(&sides.right)?;
        let left = if sides.are_equal {
            Arc::clone(&right)
        } else {
            geometry(&sides.left)?
        };
        let wheelset = LoadedWheelset::new([left, right], running).map_err(in_options)?;
        let shifts_m = if self.lateral_mm.is_empty() {
            wheelset.usual_shifts_m()
        } else {
            self.lateral_mm
                .iter()
                .map(|shift_mm| 1e-3 * shift_mm)
                .collect()
        };
        Ok(Some(UnderLoad {
            running,
            shifts: wheelset.at(&shifts_m).map_err(in_options)?,
            rolling: wheelset.rolling_radius_difference().map_err(failure)?,
        }))
    }
}

/// The error with the option and its unit.
fn in_options(error: LoadedWheelsetError) -> Failure {
    let LoadedWheelsetError::OutOfBounds {
        key,
        value,
        allowed,
    } = error
    else {
        return failure(error);
    };
    let (option, factor, unit) = match key {
        "load_n" => ("--load-kn", 1e-3, " kN"),
        "lateral_m" => ("--lateral-mm", 1e3, " mm"),
        "yaw_rad" => ("--yaw-mrad", 1e3, " mrad"),
        "speed_m_per_s" => ("--speed-km-h", 3.6, " km/h"),
        "friction" => ("--friction", 1.0, ""),
        _ => return failure(error),
    };
    let [value, low, high] =
        [value, allowed[0], allowed[1]].map(|number| shortest(number * factor));
    Failure::wrong_use(format!("{option}: {value}, allowed: {low} to {high}{unit}"))
}

/// `number` without the rounding errors of a conversion between units.
pub(super) fn shortest(number: f64) -> f64 {
    format!("{number:.9e}").parse().unwrap_or(number)
}
