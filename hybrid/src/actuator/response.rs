//! Response of an actuator to a small sine.

use dashpot_files::actuator::{ActuatorLaw, ActuatorParameters};
use nalgebra::Complex;

/// Returns measured displacement over command at `s` (rad/s), with a specimen of this dynamic stiffness (N/m) at `s`.
///
/// No limit holds, and the valve of a servo-hydraulic actuator is near its middle, where its flow does not depend on
/// the pressure.
///
/// ```
/// use dashpot_files::actuator::ActuatorParameters;
/// use dashpot_hybrid::actuator::response;
/// use nalgebra::Complex;
///
/// let servo = ActuatorParameters::load("servo")?;
/// let s = Complex::new(0.0, std::f64::consts::TAU);
/// let at_1_hz = response(&servo, s, Complex::new(0.0, 0.0));
/// assert!((-at_1_hz.arg() / s.im - 0.021).abs() < 1e-3); // s late
/// # Ok::<(), dashpot_files::actuator::ActuatorFileError>(())
/// ```
pub fn response(
    parameters: &ActuatorParameters,
    s: Complex<f64>,
    specimen_n_per_m: Complex<f64>,
) -> Complex<f64> {
    match &parameters.law {
        ActuatorLaw::Coupled(law) => {
            let valve = (s * (s + law.valve_damping_per_s) + law.valve_stiffness_per_s2).inv()
                * law.valve_gain_n_per_m_s3;
            let load = s * (s * law.moving_mass_kg + law.frame_damping_n_s_per_m)
                + law.frame_stiffness_n_per_m
                + specimen_n_per_m;
            let open = (s + law.leakage_per_s) * load + s * law.interaction_n_per_m;
            valve * law.measured_gain / (open + valve)
        }
        ActuatorLaw::SecondOrder(law) => {
            let w = std::f64::consts::TAU * law.frequency_hz;
            of_second_order(s, w, law.damping_ratio) * (-s * law.delay_s).exp()
        }
        ActuatorLaw::ServoHydraulic(law) => {
            let w = std::f64::consts::TAU * law.valve_hz;
            let valve = of_second_order(s, w, law.valve_damping_ratio);
            let area = law.piston_area_m2;
            let volume = law.oil_volume_m3 / (4.0 * law.bulk_modulus_pa);
            let load = s * s * law.moving_mass_kg + specimen_n_per_m;
            let open = (s * volume + law.leakage_m3_per_s_pa) * load / (area * area) + s;
            let closing = valve * law.loop_gain_per_s;
            closing / (open + closing) * (-s * law.delay_s).exp()
        }
    }
}

/// Measured displacement over real one.
pub(crate) fn measured_gain(parameters: &ActuatorParameters) -> f64 {
    match &parameters.law {
        ActuatorLaw::Coupled(law) => law.measured_gain,
        ActuatorLaw::SecondOrder(_) | ActuatorLaw::ServoHydraulic(_) => 1.0,
    }
}

/// `w^2/(s^2 + 2 z w s + w^2)`.
fn of_second_order(s: Complex<f64>, w: f64, z: f64) -> Complex<f64> {
    (s * (s + 2.0 * z * w) + w * w).inv() * (w * w)
}
