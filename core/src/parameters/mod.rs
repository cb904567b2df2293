//! Parameters of a damper in SI units, from a damper file or from code.
//!
//! Signals of the element: `x` is the relative displacement of the two seats (m), positive in extension; `F` is the
//! force (N), positive when it resists extension.
//!
//! `new` creates a structure from its required parameters. Setters change the other parameters, also in a `const`:
//!
//! ```
//! use dashpot_core::parameters::{DamperParameters, Limits, Mount};
//!
//! const MOUNT: Mount = Mount::new(8e6).clearance_m(1e-3);
//! const WORN: DamperParameters =
//!     DamperParameters::reduced(60e3, 0.03, MOUNT).limits(Limits::DEFAULT.force_n(20e3));
//! assert_eq!((WORN.mount.clearance_m, WORN.limits.force_n), (1e-3, 20e3));
//! ```

mod hydraulics;
#[cfg(feature = "builder")]
mod numbers;
mod oil;
mod range;
mod shims;
#[cfg(feature = "serde")]
mod written;

#[cfg(feature = "builder")]
pub(crate) use hydraulics::circle_area;
pub use hydraulics::{
    Geometry, GeometryRanges, Hydraulics, Leakage, LeakageRanges, Orifice, OrificeRanges, Relief,
    ReliefRanges, Reservoir, ReservoirRanges, Seal, SealRanges, TwoChamber, TwoChamberRanges,
    Valve, ValveRanges, Valves,
};
#[cfg(feature = "builder")]
pub(crate) use numbers::Numbers;
pub use oil::{
    ATMOSPHERIC_PRESSURE_PA, DENSITY_TEMPERATURE_C, Oil, OilColumn, OilColumnRanges, OilRanges,
};
pub use range::Range;
#[cfg(feature = "builder")]
pub(crate) use range::require;
use range::{allowed, parameters};
pub use shims::{MAX_SHIMS, Shims};

/// Step sizes for which a damper can be built (s).
pub const STEP_RANGE_S: core::ops::RangeInclusive<f64> = 1e-6..=2e-2;

/// [`STEP_RANGE_S`] in words.
pub const STEP_ALLOWED: &str = "1e-6 to 2e-2 s";

/// Largest clearance 2a (m).
pub const MAX_CLEARANCE_M: f64 = Mount::RANGES.clearance_m.max;

/// Largest force limit (N). No step returns more, even if its damper or state is damaged.
pub const MAX_FORCE_N: f64 = Limits::RANGES.force_n.max;

/// Everything that defines one damper.
///
/// ```
/// use dashpot_core::parameters::{DamperParameters, Mount};
///
/// let mut parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
/// parameters.mount.clearance_m = 1e-3;
/// assert_eq!(parameters.limits.force_n, 50e3);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct DamperParameters {
    /// The force element: hydraulics or the reduced in-service law.
    pub element: Element,
    /// Seats, rubber and clearance in series with the element.
    pub mount: Mount,
    /// Bounds on force and input.
    pub limits: Limits,
}

/// The velocity law inside the series chain.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant)] // built once on the host, never in an array
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Element {
    /// Oil through orifice and shim-pack valves.
    Physical(Hydraulics),
    /// Damping coefficient and saturation velocity.
    Reduced(Reduced),
}

impl DamperParameters {
    /// A damper with this element and mount and the default limits.
    pub const fn new(element: Element, mount: Mount) -> Self {
        Self {
            element,
            mount,
            limits: Limits::DEFAULT,
        }
    }

    /// Sets the limits.
    #[must_use]
    pub const fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// A damper with the reduced element: damping coefficient C (N s/m), saturation velocity V_r (m/s).
    pub const fn reduced(
        damping_n_s_per_m: f64,
        saturation_velocity_m_per_s: f64,
        mount: Mount,
    ) -> Self {
        let reduced = Reduced::new(damping_n_s_per_m, saturation_velocity_m_per_s);
        Self::new(Element::Reduced(reduced), mount)
    }
}

parameters! {
    /// Seats of the damper: springs and clearance in series with it.
    #[derive(Copy)]
    pub struct Mount, MountRanges {
        /// Stiffness of the rubber bushes, or the total effective stiffness Ke (N/m).
        stiffness_n_per_m: f64, 1e4 to 1e12 "N/m";
        /// Stiffness of the seats (N/m); `None` for rigid seats.
        seat_stiffness_n_per_m: Option<f64>, 1e4 to 1e12 "N/m";
        /// Clearance 2a between damper and seats: the total play (m).
        clearance_m: f64 = 0, 0 to 0.1 "m";
    }
}

impl Mount {
    /// A mount with one spring (N/m), rigid seats and no clearance.
    pub const fn new(stiffness_n_per_m: f64) -> Self {
        Self {
            stiffness_n_per_m,
            seat_stiffness_n_per_m: None,
            clearance_m: const { Self::RANGES.clearance_m.default.unwrap() },
        }
    }

    /// Sets the stiffness of the seats (N/m), which are rigid by default.
    #[must_use]
    pub const fn seat_stiffness_n_per_m(mut self, stiffness_n_per_m: f64) -> Self {
        self.seat_stiffness_n_per_m = Some(stiffness_n_per_m);
        self
    }

    /// Compliance of rubber and seats in series, `1/K_rubber + 1/K_seat` (m/N).
    pub fn compliance_m_per_n(&self) -> f64 {
        let seats = self.seat_stiffness_n_per_m;
        1.0 / self.stiffness_n_per_m + seats.map_or(0.0, |stiffness| 1.0 / stiffness)
    }
}

parameters! {
    /// The reduced in-service element: `F = C v` up to the saturation force `C V_r`, flat beyond.
    #[derive(Copy)]
    pub struct Reduced, ReducedRanges {
        /// Damping coefficient C (N s/m).
        damping_n_s_per_m: f64, 1 to 1e9 "N s/m";
        /// Saturation velocity V_r (m/s).
        saturation_velocity_m_per_s: f64, 1e-6 to 100 "m/s";
    }
}

impl Reduced {
    /// An element with this damping coefficient (N s/m) and saturation velocity (m/s).
    pub const fn new(damping_n_s_per_m: f64, saturation_velocity_m_per_s: f64) -> Self {
        Self {
            damping_n_s_per_m,
            saturation_velocity_m_per_s,
        }
    }
}

parameters! {
    /// Bounds on force and input.
    #[derive(Copy)]
    pub struct Limits, LimitsRanges {
        /// Largest force magnitude (N); at this force the damper yields.
        force_n: f64 = 50e3, 1 to 1e7
            => "1 to 1e7 N, above twice seal.friction_n, at most half of oil.column.bulk_modulus_pa times the area \
             under pressure";
        /// Largest credible rate of the displacement input (m/s); a faster input is followed at this rate and flagged.
        rate_m_per_s: f64 = 2, 1e-3 to 100 "m/s";
        /// Largest credible displacement from zero in either direction (m): half the stroke plus the offset of the
        /// sensor's zero from mid-stroke. An input beyond it is held and flagged.
        displacement_m: f64 = 0.5, 1e-3 to 0.7 "m";
    }
}

impl Limits {
    /// Limits with every default.
    pub const DEFAULT: Self = Self {
        force_n: Self::RANGES.force_n.default.unwrap(),
        rate_m_per_s: Self::RANGES.rate_m_per_s.default.unwrap(),
        displacement_m: Self::RANGES.displacement_m.default.unwrap(),
    };
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Iterates over all parameters: for each, its table in a damper file and its range. The table `valves` is listed once
/// for the three valves.
///
/// ```
/// let mut all = dashpot_core::parameters::ranges();
/// let (table, clearance) = all.find(|(_, range)| range.key == "clearance_m").unwrap();
/// assert_eq!((table, clearance.allowed), ("mount", "0 to 0.1 m"));
/// ```
pub fn ranges() -> impl Iterator<Item = (&'static str, Range)> {
    fn table(
        name: &'static str,
        ranges: impl Iterator<Item = Range>,
    ) -> impl Iterator<Item = (&'static str, Range)> {
        ranges.map(move |range| (name, range))
    }
    table("geometry", Geometry::RANGES.all())
        .chain(table("orifice", Orifice::RANGES.all()))
        .chain(table("valves", Valve::RANGES.all()))
        .chain(table("leakage", Leakage::RANGES.all()))
        .chain(table("relief", Relief::RANGES.all()))
        .chain(table("reservoir", Reservoir::RANGES.all()))
        .chain(table("seal", Seal::RANGES.all()))
        .chain(table("two_chamber", TwoChamber::RANGES.all()))
        .chain(table("oil", Oil::RANGES.all()))
        .chain(table("oil.column", OilColumn::RANGES.all()))
        .chain(table("mount", Mount::RANGES.all()))
        .chain(table("reduced", Reduced::RANGES.all()))
        .chain(table("limits", Limits::RANGES.all()))
}
