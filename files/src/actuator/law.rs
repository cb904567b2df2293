//! How an actuator follows its command.

use serde::Deserialize;

use super::bounds::{Bound, of_table};

/// Highest resonance of mass and oil (Hz): a virtual rig steps 16 times in a period of it.
const MAX_OIL_HZ: f64 = 1000.0;

/// Fastest change of pressure (1/s): a virtual rig steps at least three times in the time constant.
const MAX_FILLING_PER_S: f64 = 5000.0;

/// How an actuator follows its command: one table of the file.
#[derive(Debug, Clone, PartialEq)]
pub enum ActuatorLaw {
    /// A linear actuator that the force of the specimen slows down.
    Coupled(Coupled),
    /// A linear actuator that no force disturbs.
    SecondOrder(SecondOrder),
    /// A servo-hydraulic actuator with a valve of limited flow.
    ServoHydraulic(ServoHydraulic),
}

/// The five-parameter plant with control-structure interaction of the benchmark of Silva, Gomez, Maghareh, Dyke and
/// Spencer (Mechanical Systems and Signal Processing 135, 2020):
/// `f' = valve - a3 f - b v`, `valve'' = g (command - x) - beta1 valve' - beta2 valve`,
/// `m v' = f - k x - c v - force of the damper`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coupled {
    /// `g` (N/(m s^3)).
    pub valve_gain_n_per_m_s3: f64,
    /// `beta1` (1/s).
    pub valve_damping_per_s: f64,
    /// `beta2` (1/s^2).
    pub valve_stiffness_per_s2: f64,
    /// `a3` (1/s).
    pub leakage_per_s: f64,
    /// `b` (N/m): force that the flow of the motion takes.
    pub interaction_n_per_m: f64,
    /// `m`: piston, rod and clamp (kg).
    pub moving_mass_kg: f64,
    /// `k`: frame that moves with the piston (N/m).
    #[serde(default)]
    pub frame_stiffness_n_per_m: f64,
    /// `c`: damping of the frame (N s/m).
    #[serde(default)]
    pub frame_damping_n_s_per_m: f64,
    /// Measured displacement over real displacement.
    pub measured_gain: f64,
}

/// `x'' = w^2 (command(t - delay) - x) - 2 z w x'`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SecondOrder {
    /// `w / 2 pi` (Hz).
    pub frequency_hz: f64,
    /// `z`, as a share of critical damping.
    pub damping_ratio: f64,
    /// Delay of controller and converters (s).
    pub delay_s: f64,
}

/// A double-acting cylinder with a servo valve, a proportional controller of the position, and oil that gives way
/// (Merritt, Hydraulic Control Systems, 1967).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServoHydraulic {
    /// Area of the piston, the same on both sides (m^2).
    pub piston_area_m2: f64,
    /// Supply pressure above that of the return (Pa).
    pub supply_pressure_pa: f64,
    /// Flow of the fully open valve at the rated pressure drop over both edges (m^3/s).
    pub rated_flow_m3_per_s: f64,
    /// Rated pressure drop (Pa).
    pub rated_drop_pa: f64,
    /// Natural frequency of the valve (Hz).
    pub valve_hz: f64,
    /// Damping of the valve, as a share of critical damping.
    pub valve_damping_ratio: f64,
    /// Volume of oil in both chambers and pipes (m^3).
    pub oil_volume_m3: f64,
    /// Bulk modulus of the oil (Pa).
    pub bulk_modulus_pa: f64,
    /// Leakage between the chambers (m^3/(s Pa)).
    pub leakage_m3_per_s_pa: f64,
    /// Piston, rod and clamp (kg).
    pub moving_mass_kg: f64,
    /// Velocity without load per error of the position (1/s).
    pub loop_gain_per_s: f64,
    /// Delay of controller and converters (s).
    pub delay_s: f64,
}

impl Coupled {
    pub(super) fn bounds(&self) -> Vec<Bound> {
        of_table(
            "coupled",
            [
                (
                    "valve_gain_n_per_m_s3",
                    self.valve_gain_n_per_m_s3,
                    1e6,
                    1e18,
                ),
                ("valve_damping_per_s", self.valve_damping_per_s, 1.0, 5e3),
                (
                    "valve_stiffness_per_s2",
                    self.valve_stiffness_per_s2,
                    1e2,
                    4e6,
                ),
                ("leakage_per_s", self.leakage_per_s, 0.0, 1e3),
                ("interaction_n_per_m", self.interaction_n_per_m, 0.0, 1e9),
                ("moving_mass_kg", self.moving_mass_kg, 1.0, 1e4),
                (
                    "frame_stiffness_n_per_m",
                    self.frame_stiffness_n_per_m,
                    0.0,
                    1e9,
                ),
                (
                    "frame_damping_n_s_per_m",
                    self.frame_damping_n_s_per_m,
                    0.0,
                    1e7,
                ),
                ("measured_gain", self.measured_gain, 0.5, 2.0),
            ],
        )
    }
}

impl SecondOrder {
    pub(super) fn bounds(&self) -> Vec<Bound> {
        of_table(
            "second_order",
            [
                ("frequency_hz", self.frequency_hz, 0.5, 300.0),
                ("damping_ratio", self.damping_ratio, 0.05, 5.0),
                ("delay_s", self.delay_s, 0.0, 0.2),
            ],
        )
    }
}

impl ServoHydraulic {
    /// Stiffness of the oil in the middle of the stroke, `4 B A^2 / V` (N/m).
    pub fn oil_stiffness_n_per_m(&self) -> f64 {
        4.0 * self.bulk_modulus_pa * self.piston_area_m2 * self.piston_area_m2 / self.oil_volume_m3
    }

    /// Frequency of the moving mass on the oil (Hz).
    pub fn oil_hz(&self) -> f64 {
        libm::sqrt(self.oil_stiffness_n_per_m() / self.moving_mass_kg) / std::f64::consts::TAU
    }

    /// Flow of the fully open valve without load (m^3/s).
    pub fn free_flow_m3_per_s(&self) -> f64 {
        self.rated_flow_m3_per_s * libm::sqrt(self.supply_pressure_pa / self.rated_drop_pa)
    }

    /// Rate of the pressure (1/s) with a flow per pressure (m^3/(s Pa)), `4 B/V` times that.
    fn filling_per_s(&self, flow_m3_per_s_pa: f64) -> f64 {
        4.0 * self.bulk_modulus_pa / self.oil_volume_m3 * flow_m3_per_s_pa
    }

    pub(super) fn bounds(&self) -> Vec<Bound> {
        of_table(
            "servo_hydraulic",
            [
                ("piston_area_m2", self.piston_area_m2, 1e-5, 0.1),
                ("supply_pressure_pa", self.supply_pressure_pa, 1e5, 1e8),
                ("rated_flow_m3_per_s", self.rated_flow_m3_per_s, 1e-6, 0.1),
                ("rated_drop_pa", self.rated_drop_pa, 1e5, 1e8),
                ("valve_hz", self.valve_hz, 1.0, 300.0),
                ("valve_damping_ratio", self.valve_damping_ratio, 0.1, 5.0),
                ("oil_volume_m3", self.oil_volume_m3, 1e-6, 1.0),
                ("bulk_modulus_pa", self.bulk_modulus_pa, 1e7, 3e9),
                ("leakage_m3_per_s_pa", self.leakage_m3_per_s_pa, 0.0, 1e-8),
                ("moving_mass_kg", self.moving_mass_kg, 1.0, 1e4),
                ("loop_gain_per_s", self.loop_gain_per_s, 0.1, 1e3),
                ("delay_s", self.delay_s, 0.0, 0.2),
                (
                    "resonance of mass and oil, Hz",
                    self.oil_hz(),
                    1.0,
                    MAX_OIL_HZ,
                ),
                (
                    "rate at which the open valve fills the oil, 1/s",
                    self.filling_per_s(self.free_flow_m3_per_s() / self.supply_pressure_pa),
                    0.1,
                    MAX_FILLING_PER_S,
                ),
                (
                    "rate at which the leakage empties the oil, 1/s",
                    self.filling_per_s(self.leakage_m3_per_s_pa),
                    0.0,
                    MAX_FILLING_PER_S,
                ),
            ],
        )
    }
}
