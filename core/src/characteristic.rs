//! Static laws of a damper, for curves and checks outside the step.

use crate::build::{CheckedParameters, ElementLaws};
pub use crate::hydraulics::Corner;
use crate::hydraulics::{Corners, HydraulicSide, jet_velocity};
use crate::math::root::bracketed_root;

/// One of the three shim-pack valves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShimPackValve {
    /// Piston valve that works in extension.
    PistonExtension,
    /// Piston valve that works in compression.
    PistonCompression,
    /// Foot valve that works in compression against the reservoir.
    FootCompression,
}

/// Laws of a damper at constant velocity, when its springs have settled and its clearance is taken up.
#[derive(Clone, Debug)]
pub struct Characteristic {
    laws: ElementLaws,
    force_limit_n: f64,
}

impl Characteristic {
    /// Returns the static laws of a damper.
    pub fn new(parameters: &CheckedParameters) -> Self {
        Self {
            laws: parameters.laws.clone(),
            force_limit_n: parameters.limits.force_n,
        }
    }

    /// Returns the force (N) at a constant velocity (m/s). Both are positive in extension. The force is 0 at rest and
    /// never exceeds the yield force.
    pub fn force_n(&self, velocity_m_per_s: f64) -> f64 {
        if velocity_m_per_s == 0.0 {
            return 0.0;
        }
        let speed = velocity_m_per_s.abs();
        let force = match &self.laws {
            ElementLaws::Physical(laws) => {
                let side = HydraulicSide {
                    laws,
                    compression: velocity_m_per_s < 0.0,
                };
                bracketed_root(laws.friction_n, self.force_limit_n, |force| {
                    side.velocity(force) - speed
                })
            }
            ElementLaws::Reduced(reduced) => {
                let yields = reduced.saturation_velocity_m_per_s;
                (reduced.damping_n_s_per_m * speed.min(yields)).min(self.force_limit_n)
            }
        };
        if velocity_m_per_s < 0.0 {
            -force
        } else {
            force
        }
    }

    /// Iterates over the corners of the law and their forces (N), positive in extension and negative in compression.
    ///
    /// They are ordered by kind, not by force. Seal friction and clearance are not included.
    ///
    /// ```
    /// use dashpot_core::characteristic::{Characteristic, Corner};
    /// use dashpot_core::parameters::{DamperParameters, Mount};
    ///
    /// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
    /// let characteristic = Characteristic::new(&parameters.check()?);
    /// assert!(characteristic.corners().eq([(Corner::Yields, 3600.0), (Corner::Yields, -3600.0)]));
    /// # Ok::<(), dashpot_core::BuildError>(())
    /// ```
    pub fn corners(&self) -> impl Iterator<Item = (Corner, f64)> {
        [(false, 1.0), (true, -1.0)]
            .into_iter()
            .flat_map(|(compression, sign)| {
                let (opens, yields) = match &self.laws {
                    ElementLaws::Physical(laws) => {
                        let side = HydraulicSide { laws, compression };
                        (side.corners(self.force_limit_n), self.force_limit_n)
                    }
                    ElementLaws::Reduced(reduced) => {
                        let yields =
                            reduced.damping_n_s_per_m * reduced.saturation_velocity_m_per_s;
                        (Corners::new(), yields.min(self.force_limit_n))
                    }
                };
                let all = opens.into_iter().chain([(Corner::Yields, yields)]);
                all.map(move |(corner, force)| (corner, sign * force))
            })
    }

    /// Returns the flow (m^3/s) through a shim-pack valve under a gauge pressure (Pa).
    ///
    /// `Q = Cd 2 pi r_w k_w (P - P_0)+ sqrt(2 (P - P_b)+/rho)`, where `P_b` is the reservoir pressure for the foot
    /// valve and 0 for the piston valves.
    ///
    /// `None` for a reduced damper.
    ///
    /// ```
    /// use dashpot_core::characteristic::{Characteristic, ShimPackValve};
    /// use dashpot_core::parameters::{DamperParameters, Mount};
    ///
    /// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
    /// let characteristic = Characteristic::new(&parameters.check()?);
    /// assert_eq!(characteristic.force_n(0.01), 1200.0);
    /// assert_eq!(characteristic.force_n(-0.1), -3600.0);
    /// assert!(characteristic.valve_flow_m3_per_s(ShimPackValve::FootCompression, 1e6).is_none());
    /// # Ok::<(), dashpot_core::BuildError>(())
    /// ```
    pub fn valve_flow_m3_per_s(&self, valve: ShimPackValve, pressure_pa: f64) -> Option<f64> {
        let ElementLaws::Physical(laws) = &self.laws else {
            return None;
        };
        let (valve, back_pressure) = match valve {
            ShimPackValve::PistonExtension => (&laws.extension, 0.0),
            ShimPackValve::PistonCompression => (&laws.compression, 0.0),
            ShimPackValve::FootCompression => (&laws.foot, laws.back_pressure_pa),
        };
        let density = laws.density.at(pressure_pa);
        let jet = jet_velocity((pressure_pa - back_pressure).max(0.0), density);
        Some(valve.flow(pressure_pa, jet))
    }
}
