//! Parameters of the hydraulics: geometry, flow paths, valves.

use super::range::{allowed, parameters};
use super::{Oil, Shims};

/// The physical damper: geometry, flow paths and oil.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Hydraulics {
    /// Piston and rod.
    pub geometry: Geometry,
    /// Constant orifice in the piston, open both ways.
    pub orifice: Orifice,
    /// The three shim-pack valves.
    pub valves: Valves,
    /// Annular gap between piston and cylinder; `None` for no leakage.
    pub leakage: Option<Leakage>,
    /// Blow-off valve with one law for both directions; `None` for no valve.
    pub relief: Option<Relief>,
    /// Gas-loaded reservoir behind the foot valve; `None` for zero back pressure.
    pub reservoir: Option<Reservoir>,
    /// Seal friction; `None` for no friction.
    pub seal: Option<Seal>,
    /// Compression with two chamber pressures; `None` applies one pressure to piston and foot valve.
    pub two_chamber: Option<TwoChamber>,
    /// The oil.
    pub oil: Oil,
}

impl Hydraulics {
    /// Hydraulics of piston, orifice, valves and oil, with every other effect off.
    pub const fn new(geometry: Geometry, orifice: Orifice, valves: Valves, oil: Oil) -> Self {
        Self {
            geometry,
            orifice,
            valves,
            leakage: None,
            relief: None,
            reservoir: None,
            seal: None,
            two_chamber: None,
            oil,
        }
    }

    /// Adds leakage past the piston.
    #[must_use]
    pub const fn leakage(mut self, leakage: Leakage) -> Self {
        self.leakage = Some(leakage);
        self
    }

    /// Adds a relief valve.
    #[must_use]
    pub const fn relief(mut self, relief: Relief) -> Self {
        self.relief = Some(relief);
        self
    }

    /// Adds a reservoir.
    #[must_use]
    pub const fn reservoir(mut self, reservoir: Reservoir) -> Self {
        self.reservoir = Some(reservoir);
        self
    }

    /// Adds seal friction.
    #[must_use]
    pub const fn seal(mut self, seal: Seal) -> Self {
        self.seal = Some(seal);
        self
    }

    /// Computes compression with the pressures of both chambers.
    #[must_use]
    pub const fn two_chamber(mut self, two_chamber: TwoChamber) -> Self {
        self.two_chamber = Some(two_chamber);
        self
    }
}

parameters! {
    /// Piston and rod.
    #[derive(Copy)]
    pub struct Geometry, GeometryRanges {
        /// Rod diameter (m).
        rod_diameter_m: f64, 0 to 0.95 => "0 to 0.95 of piston_diameter_m, above 0 with two_chamber";
        /// Piston diameter (m).
        piston_diameter_m: f64, 1e-3 to 1 "m";
    }
}

impl Geometry {
    /// A rod and a piston with these diameters (m).
    pub const fn new(rod_diameter_m: f64, piston_diameter_m: f64) -> Self {
        Self {
            rod_diameter_m,
            piston_diameter_m,
        }
    }
}

/// Area (m^2) of a circle of this diameter (m).
#[cfg(feature = "builder")]
pub(crate) fn circle_area(diameter_m: f64) -> f64 {
    0.25 * core::f64::consts::PI * diameter_m * diameter_m
}

#[cfg(feature = "builder")]
impl Geometry {
    /// Area of the piston (m^2).
    pub(crate) fn piston_area(&self) -> f64 {
        circle_area(self.piston_diameter_m)
    }

    /// Area of the rod (m^2).
    pub(crate) fn rod_area(&self) -> f64 {
        circle_area(self.rod_diameter_m)
    }
}

parameters! {
    /// Constant orifice: `Q = Cd pi d^2/4 sqrt(2 P/rho)` in turbulent flow.
    #[derive(Copy)]
    pub struct Orifice, OrificeRanges {
        /// Orifice diameter (m); 0 closes it.
        diameter_m: f64, 0 to 1 => "at least 0 and below piston_diameter_m";
        /// Turbulent discharge coefficient (1).
        discharge_coefficient: f64, 0 to 1;
        /// Reynolds number `Re = u d/nu` (u is the mean velocity in the bore) at which the laminar and the turbulent
        /// part of the pressure drop are equal; 0 means turbulent at any flow.
        ///
        /// The law with this transition: `P = R_t Q^2 + R_l Q`, `R_t = rho/(2 (Cd A)^2)`, `R_l = R_t Q_t`,
        /// `Q_t = Re nu A/d`.
        transition_reynolds: f64 = 0, 0 to 1e5;
    }
}

impl Orifice {
    /// An orifice with this diameter (m) and turbulent discharge coefficient (1), without a laminar part.
    pub const fn new(diameter_m: f64, discharge_coefficient: f64) -> Self {
        Self {
            diameter_m,
            discharge_coefficient,
            transition_reynolds: const { Self::RANGES.transition_reynolds.default.unwrap() },
        }
    }
}

/// The three shim-pack valves.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Valves {
    /// Piston valve that works in extension.
    pub piston_extension: Valve,
    /// Piston valve that works in compression.
    pub piston_compression: Valve,
    /// Foot valve that works in compression.
    pub foot_compression: Valve,
}

impl Valves {
    /// The two piston valves and the foot valve.
    pub const fn new(
        piston_extension: Valve,
        piston_compression: Valve,
        foot_compression: Valve,
    ) -> Self {
        Self {
            piston_extension,
            piston_compression,
            foot_compression,
        }
    }
}

parameters! {
    /// A shim-pack valve: edge lift `w = k_w (P - P_0)+`, flow `Q = Cd 2 pi r_w w sqrt(2 P/rho)`.
    ///
    /// If `edge_compliance_m_per_pa` is given, the edge compliance `k_w` (m/Pa) is
    /// `edge_compliance_m_per_pa * equivalent_pressure_factor`. Otherwise it is
    /// `Cw(r_w) equivalent_pressure_factor / h_e^3` of the pack.
    pub struct Valve, ValveRanges {
        /// Clamping radius r_n of the discs (m).
        clamp_radius_m: f64, 0 to 1 => "above 0 and below free_radius_m";
        /// Free (outer) radius r_w of the discs (m).
        free_radius_m: f64, 0 to 1 => "above 0 and at most 1 m";
        /// Thickness of each shim (m); may be empty if the edge compliance is given.
        shims_m: Shims, 1e-5 to 1e-2 "m each";
        /// Edge lift per uniform pressure (m/Pa); `None` to compute it from the shims.
        edge_compliance_m_per_pa: Option<f64>, 0 to 1e-6 "m/Pa";
        /// Equivalent-pressure correction factor Ce (1).
        equivalent_pressure_factor: f64 = 1, 0 to 10;
        /// Discharge coefficient of the lifted edge (1).
        discharge_coefficient: f64, 0 to 1;
        /// Opening pressure P_0 (Pa).
        preload_pa: f64 = 0, 0 to 1e8 "Pa";
        /// Elastic modulus of the shims (Pa); the default is from Table 1 of the source paper.
        elastic_modulus_pa: f64 = 2e11, 1e3 to 1e15 "Pa";
        /// Poisson's ratio of the shims (1); the default is from Table 1 of the source paper.
        poisson_ratio: f64 = 0.3, 0 to 0.5;
    }
}

impl Valve {
    /// A valve with shims of spring steel and no preload: radii (m), thicknesses (m), discharge coefficient (1).
    pub const fn with_shims(
        clamp_radius_m: f64,
        free_radius_m: f64,
        shims_m: Shims,
        discharge_coefficient: f64,
    ) -> Self {
        Self {
            clamp_radius_m,
            free_radius_m,
            shims_m,
            edge_compliance_m_per_pa: None,
            equivalent_pressure_factor: const {
                Self::RANGES.equivalent_pressure_factor.default.unwrap()
            },
            discharge_coefficient,
            preload_pa: const { Self::RANGES.preload_pa.default.unwrap() },
            elastic_modulus_pa: const { Self::RANGES.elastic_modulus_pa.default.unwrap() },
            poisson_ratio: const { Self::RANGES.poisson_ratio.default.unwrap() },
        }
    }

    /// A valve without shims or preload: radii (m), edge lift per uniform pressure (m/Pa), discharge coefficient (1).
    pub const fn with_edge_compliance(
        clamp_radius_m: f64,
        free_radius_m: f64,
        edge_compliance_m_per_pa: f64,
        discharge_coefficient: f64,
    ) -> Self {
        let mut valve = Self::with_shims(
            clamp_radius_m,
            free_radius_m,
            Shims::EMPTY,
            discharge_coefficient,
        );
        valve.edge_compliance_m_per_pa = Some(edge_compliance_m_per_pa);
        valve
    }
}

parameters! {
    /// Laminar leakage past the piston: `Q = pi R c^3 (1 + 1.5 e^2) P/(6 mu L)`, where R is the piston radius.
    #[derive(Copy)]
    pub struct Leakage, LeakageRanges {
        /// Radial clearance c between piston and cylinder (m).
        radial_clearance_m: f64, 0 to 1e-3 "m";
        /// Length L of the gap (m).
        length_m: f64, 1e-4 to 1 "m";
        /// Ratio e of the eccentricity to the clearance (1): 0 is concentric, 1 is touching.
        eccentricity_ratio: f64 = 0, 0 to 1;
    }
}

impl Leakage {
    /// A concentric gap with this radial clearance (m) and length (m).
    pub const fn new(radial_clearance_m: f64, length_m: f64) -> Self {
        Self {
            radial_clearance_m,
            length_m,
            eccentricity_ratio: const { Self::RANGES.eccentricity_ratio.default.unwrap() },
        }
    }
}

parameters! {
    /// Relief valve: `Q = Cd g (P - P_open)+ sqrt(2 P/rho)`, where g is the area gradient.
    #[derive(Copy)]
    pub struct Relief, ReliefRanges {
        /// Pressure at which it opens (Pa).
        opening_pressure_pa: f64, 0 to 1e8 "Pa";
        /// Flow area per pressure above opening (m^2/Pa).
        area_gradient_m2_per_pa: f64, 0 to 1e-6 "m2/Pa";
        /// Discharge coefficient (1).
        discharge_coefficient: f64, 0 to 1;
    }
}

impl Relief {
    /// A relief valve with this opening pressure (Pa), area gradient (m^2/Pa) and discharge coefficient (1).
    pub const fn new(
        opening_pressure_pa: f64,
        area_gradient_m2_per_pa: f64,
        discharge_coefficient: f64,
    ) -> Self {
        Self {
            opening_pressure_pa,
            area_gradient_m2_per_pa,
            discharge_coefficient,
        }
    }
}

parameters! {
    /// Gas above the oil in the reservoir. Back pressure (gauge) at the operating point:
    /// `P_b = (p_fill + p_a) (V_fill/V) (T/T_fill) - p_a` with `V = V_fill - A_rod x_rod`. The gas is isothermal while
    /// the mean rod position slowly changes. Within a stroke `P_b` is taken as constant, because a stroke changes it by
    /// a fraction of less than `A_rod stroke/V`.
    #[derive(Copy)]
    pub struct Reservoir, ReservoirRanges {
        /// Gauge pressure when filled (Pa).
        fill_pressure_pa: f64, 0 to 1e7 "Pa";
        /// Gas volume when filled (m^3).
        gas_volume_m3: f64, 1e-6 to 1 "m3";
        /// Oil and gas temperature when filled (degC).
        fill_temperature_c: f64, -60 to 150 "degC";
        /// Mean rod insertion beyond the position at filling (m), positive in compression.
        rod_insertion_m: f64 = 0, -1 to 1 => "-1 to 1 m, so that a tenth of gas_volume_m3 remains";
    }
}

impl Reservoir {
    /// A reservoir filled to this gauge pressure (Pa) and gas volume (m^3) at this temperature (degC).
    pub const fn new(fill_pressure_pa: f64, gas_volume_m3: f64, fill_temperature_c: f64) -> Self {
        Self {
            fill_pressure_pa,
            gas_volume_m3,
            fill_temperature_c,
            rod_insertion_m: const { Self::RANGES.rod_insertion_m.default.unwrap() },
        }
    }
}

#[cfg(feature = "builder")]
impl Reservoir {
    /// Gas volume (m^3) with the rod inserted.
    pub(crate) fn volume_m3(&self, rod_area_m2: f64) -> f64 {
        self.gas_volume_m3 - rod_area_m2 * self.rod_insertion_m
    }
}

parameters! {
    /// Coulomb friction of seals and guide: `P = (|F| - F_c)+ / A`.
    #[derive(Copy)]
    pub struct Seal, SealRanges {
        /// Friction force F_c (N).
        friction_n: f64, 0 to 1e4 "N";
    }
}

impl Seal {
    /// A seal with this friction force (N).
    pub const fn new(friction_n: f64) -> Self {
        Self { friction_n }
    }
}

parameters! {
    /// Compression with the pressures of both chambers:
    /// `A_ext v = Q_piston(P1 - P2)`, `A_rod v = Q_foot(P1 - P_b)`, `F = P1 A_comp - P2 A_ext`.
    #[derive(Copy)]
    pub struct TwoChamber, TwoChamberRanges {
        /// Lowest gauge pressure the rod-side chamber can reach (Pa), about -1e5.
        vapour_pressure_pa: f64, -101325 to 0 "Pa (gauge)";
    }
}

impl TwoChamber {
    /// Two chambers with oil that has this vapour pressure (gauge, Pa).
    pub const fn new(vapour_pressure_pa: f64) -> Self {
        Self { vapour_pressure_pa }
    }
}
