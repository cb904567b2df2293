//! The yardstick of the benches: a plain two-stage implicit step of the paper's damper, solved by Newton's method.
//!
//! Alexander's SDIRK2 on `dx_r/dt = v_h(F)` with a linear spring; each stage finds `s = sqrt P` from
//! above in a fixed number of iterations of `s^2 A/K + gamma h v_h(s) = |x - x_r|`, where
//! `v_h(s) = (b s + c s^3)/A`. It has no clearance, no in-service terms and no table.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use dashpot_core::parameters::{DamperParameters, Element, Hydraulics, Valve};

const ITERATIONS: usize = 6;

/// Constants of one side.
#[derive(Clone, Copy)]
struct Side {
    /// Piston area A (m^2).
    area: f32,
    /// A/K (m/Pa).
    spring: f32,
    /// gamma h b/A (m/Pa^0.5) and gamma h c/A (m/Pa^1.5).
    orifice: f32,
    shim: f32,
}

/// A damper and its piston's position x_r (m).
pub struct NewtonDamper {
    sides: [Side; 2],
    piston: f32,
    last: f32,
}

impl NewtonDamper {
    /// The `paper` preset for a step (s); `None` for the reduced element.
    pub fn new(parameters: &DamperParameters, step_s: f64) -> Option<Self> {
        let Element::Physical(hydraulics) = &parameters.element else {
            return None;
        };
        let Hydraulics {
            geometry,
            orifice,
            valves,
            oil,
            ..
        } = hydraulics;
        let piston = 0.25 * PI * geometry.piston_diameter_m.powi(2);
        let rod = 0.25 * PI * geometry.rod_diameter_m.powi(2);
        let jet = (2.0 / oil.density_kg_per_m3).sqrt();
        let bore = 0.25 * PI * orifice.diameter_m.powi(2);
        let through_orifice = orifice.discharge_coefficient * bore * jet;
        let through = |valve: &Valve| {
            let lift = valve.edge_compliance_m_per_pa? * valve.equivalent_pressure_factor;
            Some(valve.discharge_coefficient * 2.0 * PI * valve.free_radius_m * lift * jet)
        };
        let side = |area: f64, shim: f64| {
            let stage_s = (1.0 - FRAC_1_SQRT_2) * step_s;
            Side {
                area: area as f32,
                spring: (area / parameters.mount.stiffness_n_per_m) as f32,
                orifice: (stage_s * through_orifice / area) as f32,
                shim: (stage_s * shim / area) as f32,
            }
        };
        let compression = through(&valves.piston_compression)? + through(&valves.foot_compression)?;
        Some(Self {
            sides: [
                side(piston - rod, through(&valves.piston_extension)?),
                side(piston, compression),
            ],
            piston: 0.0,
            last: 0.0,
        })
    }

    /// Force (N) at the displacement (m) of the tick, positive when it resists extension.
    pub fn step(&mut self, x: f32) -> f32 {
        const IMPLICIT: f32 = (1.0 - FRAC_1_SQRT_2) as f32;
        const EXPLICIT_RATIO: f32 = (FRAC_1_SQRT_2 / (1.0 - FRAC_1_SQRT_2)) as f32;
        let middle = self.last + IMPLICIT * (x - self.last);
        let (_, flow) = self.stage(middle - self.piston);
        let piston = self.piston + EXPLICIT_RATIO * flow;
        let (force, flow) = self.stage(x - piston);
        self.piston = piston + flow;
        self.last = x;
        force
    }

    /// Force (N) and flow (m) of the stage that starts from the stretch `reach` (m).
    fn stage(&self, reach: f32) -> (f32, f32) {
        let side = &self.sides[usize::from(reach < 0.0)];
        let target = reach.abs();
        let mut s = (target / side.spring).sqrt();
        for _ in 0..ITERATIONS {
            let square = s * s;
            let value = side.spring * square + s * (side.orifice + side.shim * square) - target;
            let slope = 2.0 * side.spring * s + side.orifice + 3.0 * side.shim * square;
            s -= value / slope;
        }
        let flow = s * (side.orifice + side.shim * s * s);
        ((s * s * side.area).copysign(reach), flow.copysign(reach))
    }
}
