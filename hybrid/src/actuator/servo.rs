//! A servo-hydraulic actuator, whose valve limits the velocity and whose pressure limits the force.

use dashpot_files::actuator::ServoHydraulic;
use nalgebra::Vector1;

use super::second_order::of_second_order;
use super::stopped;
use crate::linear::LinearSystem;

/// The actuator in motion.
#[derive(Clone, Debug)]
pub(super) struct MovingServo {
    law: ServoHydraulic,
    /// Opening of the valve (share of the full one) and its rate.
    valve: LinearSystem<2, 1>,
    /// Flow of the fully open valve without load, and that for which the controller is made (m^3/s).
    free_flow_m3_per_s: f64,
    nominal_flow_m3_per_s: f64,
    /// Pressure difference of the chambers (Pa).
    pressure_pa: f64,
    displacement_m: f64,
    /// Half a step behind the displacement, which lets mass and oil oscillate without gain or loss.
    velocity_m_per_s: f64,
    step_s: f64,
}

impl MovingServo {
    pub(super) fn new(law: &ServoHydraulic, step_s: f64) -> Self {
        let w = std::f64::consts::TAU * law.valve_hz;
        Self {
            law: *law,
            valve: of_second_order(w, law.valve_damping_ratio, step_s),
            free_flow_m3_per_s: law.free_flow_m3_per_s(),
            nominal_flow_m3_per_s: law.free_flow_m3_per_s(),
            pressure_pa: 0.0,
            displacement_m: 0.0,
            velocity_m_per_s: 0.0,
            step_s,
        }
    }

    /// Takes a step between the ends of the stroke (m); returns true if the valve was fully open or the pressure near
    /// that of the supply.
    pub(super) fn step(&mut self, command_m: f64, force_n: f64, stroke_m: f64) -> bool {
        let (law, h) = (&self.law, self.step_s);
        let area = law.piston_area_m2;
        let error_m = command_m - self.displacement_m;
        let wanted = law.loop_gain_per_s * area * error_m / self.nominal_flow_m3_per_s;
        self.valve.step(&Vector1::new(wanted.clamp(-1.0, 1.0)));
        let opening = self.valve.state[0].clamp(-1.0, 1.0);
        let resisting = self.pressure_pa / law.supply_pressure_pa * opening.signum();
        let drop = 1.0 - resisting;
        let flow = self.free_flow_m3_per_s * opening * libm::sqrt(drop.abs()).copysign(drop);
        self.velocity_m_per_s += h * (area * self.pressure_pa - force_n) / law.moving_mass_kg;
        self.displacement_m += h * self.velocity_m_per_s;
        let moved = [self.displacement_m, self.velocity_m_per_s];
        [self.displacement_m, self.velocity_m_per_s] = stopped(moved, stroke_m);
        let compressed =
            flow - area * self.velocity_m_per_s - law.leakage_m3_per_s_pa * self.pressure_pa;
        let pressure_pa =
            self.pressure_pa + h * 4.0 * law.bulk_modulus_pa / law.oil_volume_m3 * compressed;
        // Relief valves open a little above the supply pressure.
        let relief_pa = 1.1 * law.supply_pressure_pa;
        self.pressure_pa = pressure_pa.clamp(-relief_pa, relief_pa);
        wanted.abs() >= 1.0 || resisting > 0.95
    }

    /// Lets the supply fall to a share of its pressure.
    pub(super) fn weaken(&mut self, share: f64) {
        self.law.supply_pressure_pa *= share;
        self.free_flow_m3_per_s *= libm::sqrt(share);
    }

    pub(super) fn displacement_m(&self) -> f64 {
        self.displacement_m
    }
}
