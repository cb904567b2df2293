//! What a damper is: parameters in SI units, as a damper file or a literal gives them.
//!
//! Signals of the element: `x` relative displacement of the two seats, positive in
//! extension (m); `F` force (N), positive when it resists extension.

use heapless::Vec;

#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};

/// Most shims a pack may hold.
pub const MAX_SHIMS: usize = 16;

/// Largest clearance 2a (m).
pub const LARGEST_CLEARANCE_M: f64 = 0.1;

/// Largest force limit (N). No step returns more, whatever bits its damper and state have.
pub const LARGEST_FORCE_N: f64 = 1e7;

/// Everything that defines one damper.
#[derive(Clone, Debug, PartialEq)]
pub struct DamperParameters {
    /// What makes the force: hydraulics or the reduced in-service law.
    pub element: Element,
    /// Seats, rubber and clearance in series with the element.
    pub mount: Mount,
    /// Bounds on force and input that hold whatever the input is.
    pub limits: Limits,
}

/// The velocity law inside the series chain.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant)] // built once on the host, never in an array
pub enum Element {
    /// Oil through orifice and shim-pack valves.
    Physical(Hydraulics),
    /// Damping coefficient and saturation velocity.
    Reduced(Reduced),
}

/// The physical damper: geometry, flow paths and oil.
#[derive(Clone, Debug, PartialEq)]
pub struct Hydraulics {
    /// Piston and rod.
    pub geometry: Geometry,
    /// Constant orifice in the piston, open both ways.
    pub orifice: Orifice,
    /// The three shim-pack valves.
    pub valves: Valves,
    /// Annular gap between piston and cylinder; `None` is off.
    pub leakage: Option<Leakage>,
    /// Blow-off valve, one law for both directions; `None` is off.
    pub relief: Option<Relief>,
    /// Gas-loaded reservoir behind the foot valve; `None` is zero back pressure.
    pub reservoir: Option<Reservoir>,
    /// Seal friction; `None` is off.
    pub seal: Option<Seal>,
    /// Compression with two chamber pressures; `None` lumps piston and foot valve.
    pub two_chamber: Option<TwoChamber>,
    /// The oil.
    pub oil: Oil,
}

/// Piston and rod.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Geometry {
    /// Rod diameter (m).
    pub rod_diameter_m: f64,
    /// Piston diameter (m).
    pub piston_diameter_m: f64,
}

/// Constant orifice: `Q = Cd pi d^2/4 sqrt(2 P/rho)` when turbulent.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Orifice {
    /// Orifice diameter (m); 0 closes it.
    pub diameter_m: f64,
    /// Turbulent discharge coefficient (1).
    pub discharge_coefficient: f64,
    /// Reynolds number `Re = u d/nu` (u mean velocity in the bore) at which the laminar and the
    /// turbulent part of the pressure drop are equal; 0 is always turbulent.
    ///
    /// Law with the transition: `P = R_t Q^2 + R_l Q`, `R_t = rho/(2 (Cd A)^2)`, `R_l = R_t Q_t`,
    /// `Q_t = Re nu A/d`.
    #[cfg_attr(feature = "serde", serde(default))]
    pub transition_reynolds: f64,
}

/// The three shim-pack valves.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Valves {
    /// Piston valve that works in extension.
    pub piston_extension: Valve,
    /// Piston valve that works in compression.
    pub piston_compression: Valve,
    /// Foot valve that works in compression.
    pub foot_compression: Valve,
}

/// A shim-pack valve: edge lift `w = k_w (P - P_0)+`, flow `Q = Cd 2 pi r_w w sqrt(2 P/rho)`.
///
/// The edge compliance `k_w` (m/Pa) is `edge_compliance_m_per_pa * equivalent_pressure_factor`
/// when the former is given, else `Cw(r_w) equivalent_pressure_factor / h_e^3` of the pack.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Valve {
    /// Clamping radius r_n of the discs (m).
    pub clamp_radius_m: f64,
    /// Free (outer) radius r_w of the discs (m).
    pub free_radius_m: f64,
    /// Thickness of each shim (m); may be empty when the edge compliance is given.
    #[cfg_attr(feature = "serde", serde(default))]
    pub shims_m: Vec<f64, MAX_SHIMS>,
    /// Edge lift per uniform pressure (m/Pa), in place of the pack's theory.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub edge_compliance_m_per_pa: Option<f64>,
    /// Equivalent-pressure correction factor Ce (1).
    #[cfg_attr(feature = "serde", serde(default = "one"))]
    pub equivalent_pressure_factor: f64,
    /// Discharge coefficient of the lifted edge (1).
    pub discharge_coefficient: f64,
    /// Opening pressure P_0 (Pa).
    #[cfg_attr(feature = "serde", serde(default))]
    pub preload_pa: f64,
    /// Elastic modulus of the shims (Pa).
    #[cfg_attr(feature = "serde", serde(default = "spring_steel_modulus_pa"))]
    pub elastic_modulus_pa: f64,
    /// Poisson's ratio of the shims (1).
    #[cfg_attr(feature = "serde", serde(default = "spring_steel_poisson_ratio"))]
    pub poisson_ratio: f64,
}

/// Laminar leakage past the piston: `Q = pi R c^3 (1 + 1.5 e^2) P/(6 mu L)`, R the piston radius.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Leakage {
    /// Radial clearance c between piston and cylinder (m).
    pub radial_clearance_m: f64,
    /// Length L of the gap (m).
    pub length_m: f64,
    /// Eccentricity e over clearance (1), 0 concentric to 1 touching.
    #[cfg_attr(feature = "serde", serde(default))]
    pub eccentricity_ratio: f64,
}

/// Relief valve: `Q = Cd g (P - P_open)+ sqrt(2 P/rho)`, g the area gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Relief {
    /// Pressure at which it opens (Pa).
    pub opening_pressure_pa: f64,
    /// Flow area per pressure above opening (m^2/Pa).
    pub area_gradient_m2_per_pa: f64,
    /// Discharge coefficient (1).
    pub discharge_coefficient: f64,
}

/// Gas above the oil in the reservoir. Back pressure (gauge) at the operating point:
/// `P_b = (p_fill + p_a) (V_fill/V) (T/T_fill) - p_a` with `V = V_fill - A_rod x_rod`, isothermal
/// over the slow change of mean rod position; constant over a stroke, which moves it by less than
/// `A_rod stroke/V`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Reservoir {
    /// Gauge pressure when filled (Pa).
    pub fill_pressure_pa: f64,
    /// Gas volume when filled (m^3).
    pub gas_volume_m3: f64,
    /// Oil and gas temperature when filled (degC).
    pub fill_temperature_c: f64,
    /// Mean rod insertion beyond the position at filling (m), positive in compression.
    #[cfg_attr(feature = "serde", serde(default))]
    pub rod_insertion_m: f64,
}

/// Coulomb friction of seals and guide: `P = (|F| - F_c)+ / A`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Seal {
    /// Friction force F_c (N).
    pub friction_n: f64,
}

/// Compression with the pressures of both chambers:
/// `A_ext v = Q_piston(P1 - P2)`, `A_rod v = Q_foot(P1 - P_b)`, `F = P1 A_comp - P2 A_ext`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct TwoChamber {
    /// Lowest gauge pressure the rod-side chamber can reach (Pa), about -1e5.
    pub vapour_pressure_pa: f64,
}

/// Oil at its working temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Oil {
    /// Density at 15 degC without air (kg/m^3).
    pub density_kg_per_m3: f64,
    /// Volumetric thermal expansion (1/K).
    #[cfg_attr(feature = "serde", serde(default))]
    pub thermal_expansion_per_k: f64,
    /// Working temperature (degC).
    #[cfg_attr(feature = "serde", serde(default = "reference_temperature_c"))]
    pub temperature_c: f64,
    /// Kinematic viscosity at 40 degC (m^2/s).
    #[cfg_attr(feature = "serde", serde(default = "viscosity_40c_m2_per_s"))]
    pub viscosity_40c_m2_per_s: f64,
    /// Kinematic viscosity at 100 degC (m^2/s).
    #[cfg_attr(feature = "serde", serde(default = "viscosity_100c_m2_per_s"))]
    pub viscosity_100c_m2_per_s: f64,
    /// The oil columns as springs; `None` is rigid oil.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub column: Option<OilColumn>,
}

/// Compressibility of the oil column under the working pressure, with entrained air:
/// `delta_oil(P) = (V/A) [ (1 - alpha) P/E_l + alpha (1 - (p_a/(p_a + P))^(1/n)) ]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct OilColumn {
    /// Bulk modulus E_l of the oil without air (Pa).
    pub bulk_modulus_pa: f64,
    /// Volume of the chamber under pressure in extension (m^3).
    pub rod_side_volume_m3: f64,
    /// Volume of the chamber under pressure in compression (m^3).
    pub piston_side_volume_m3: f64,
    /// Volume ratio alpha of entrained air at atmospheric pressure (1).
    #[cfg_attr(feature = "serde", serde(default))]
    pub air_fraction: f64,
    /// Polytropic exponent n of the air (1).
    #[cfg_attr(feature = "serde", serde(default = "one"))]
    pub polytropic_exponent: f64,
}

/// Seats of the damper: springs and clearance in series with it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Mount {
    /// Stiffness of the rubber bushes, or the whole effective stiffness Ke (N/m).
    pub stiffness_n_per_m: f64,
    /// Stiffness of the seats (N/m); `None` is rigid.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub seat_stiffness_n_per_m: Option<f64>,
    /// Clearance 2a between damper and seats, the whole play (m).
    #[cfg_attr(feature = "serde", serde(default))]
    pub clearance_m: f64,
}

/// The reduced in-service element: `F = C v` up to the saturation force `C V_r`, flat beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Reduced {
    /// Damping coefficient C (N s/m).
    pub damping_n_s_per_m: f64,
    /// Saturation velocity V_r (m/s).
    pub saturation_velocity_m_per_s: f64,
}

/// Bounds that hold whatever the input is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(deny_unknown_fields, default)
)]
pub struct Limits {
    /// Largest force magnitude (N); beyond it the damper yields at constant force.
    pub force_n: f64,
    /// Largest credible rate of the displacement input (m/s); a faster input is followed at
    /// this rate and flagged.
    pub rate_m_per_s: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            force_n: 50e3,
            rate_m_per_s: 2.0,
        }
    }
}

/// Absolute atmospheric pressure p_a (Pa), ISO 2533.
pub const ATMOSPHERIC_PRESSURE_PA: f64 = 101_325.0;

/// Temperature at which the oil density is given (degC), as on data sheets (ISO 3675).
pub const DENSITY_TEMPERATURE_C: f64 = 15.0;

#[cfg(feature = "serde")]
mod defaults {
    pub(super) fn one() -> f64 {
        1.0
    }
    /// Table 1 of the source paper.
    pub(super) fn spring_steel_modulus_pa() -> f64 {
        2.0e11
    }
    /// Table 1 of the source paper.
    pub(super) fn spring_steel_poisson_ratio() -> f64 {
        0.3
    }
    /// Bench test condition of the source paper.
    pub(super) fn reference_temperature_c() -> f64 {
        45.0
    }
    /// ISO VG 15 damper oil.
    pub(super) fn viscosity_40c_m2_per_s() -> f64 {
        15e-6
    }
    /// ISO VG 15 damper oil, viscosity index about 150.
    pub(super) fn viscosity_100c_m2_per_s() -> f64 {
        3.8e-6
    }
}
#[cfg(feature = "serde")]
use defaults::*;
