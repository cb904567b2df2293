//! Stability of an actuator with its specimen, without a vehicle.

use dashpot_files::actuator::{ActuatorLaw, ActuatorParameters};

use crate::specimen::Specimen;

/// True if the actuator with its controller is stable while it moves a specimen, by Routh's criterion.
///
/// A plan of a hybrid test needs a stable actuator; a gain that is too high makes it oscillate by itself.
///
/// ```
/// use dashpot_files::actuator::{ActuatorLaw, ActuatorParameters};
/// use dashpot_hybrid::{Specimen, actuator::is_stable};
///
/// let mut servo = ActuatorParameters::load("servo")?;
/// let specimen = Specimen { damping_n_s_per_m: 1.3e6, stiffness_n_per_m: 12e6 };
/// assert!(is_stable(&servo, &specimen));
/// let ActuatorLaw::ServoHydraulic(law) = &mut servo.law else { panic!() };
/// law.loop_gain_per_s = 800.0;
/// assert!(!is_stable(&servo, &specimen));
/// # Ok::<(), dashpot_files::actuator::ActuatorFileError>(())
/// ```
pub fn is_stable(parameters: &ActuatorParameters, specimen: &Specimen) -> bool {
    let Specimen {
        damping_n_s_per_m: c,
        stiffness_n_per_m: k,
    } = *specimen;
    // The dynamic stiffness of the specimen is k c s over this polynomial.
    let below = Polynomial::new(&[k, c]);
    let specimen = Polynomial::new(&[0.0, k * c]);
    let characteristic = match &parameters.law {
        // Its damping is positive.
        ActuatorLaw::SecondOrder(_) => return true,
        ActuatorLaw::Coupled(law) => {
            let load = Polynomial::new(&[
                law.frame_stiffness_n_per_m,
                law.frame_damping_n_s_per_m,
                law.moving_mass_kg,
            ]);
            let loaded = &(&load * &below) + &specimen;
            let force = &Polynomial::new(&[law.leakage_per_s, 1.0]) * &loaded;
            let taken = &Polynomial::new(&[0.0, law.interaction_n_per_m]) * &below;
            let valve =
                Polynomial::new(&[law.valve_stiffness_per_s2, law.valve_damping_per_s, 1.0]);
            let closing = &Polynomial::new(&[law.valve_gain_n_per_m_s3]) * &below;
            &(&(&force + &taken) * &valve) + &closing
        }
        ActuatorLaw::ServoHydraulic(law) => {
            let w = std::f64::consts::TAU * law.valve_hz;
            let area = law.piston_area_m2;
            let volume = law.oil_volume_m3 / (4.0 * law.bulk_modulus_pa);
            let mass = Polynomial::new(&[0.0, 0.0, law.moving_mass_kg]);
            let loaded = &(&mass * &below) + &specimen;
            let oil = Polynomial::new(&[law.leakage_m3_per_s_pa, volume]);
            let compressed = &(&oil * &loaded) * &Polynomial::new(&[1.0 / (area * area)]);
            let moved = &Polynomial::new(&[0.0, 1.0]) * &below;
            let valve = Polynomial::new(&[w * w, 2.0 * law.valve_damping_ratio * w, 1.0]);
            let closing = &Polynomial::new(&[w * w * law.loop_gain_per_s]) * &below;
            &(&(&compressed + &moved) * &valve) + &closing
        }
    };
    characteristic.has_decaying_roots_only()
}

/// A polynomial in `s`, lowest power first.
#[derive(Clone, Debug, PartialEq)]
struct Polynomial(Vec<f64>);

impl Polynomial {
    fn new(coefficients: &[f64]) -> Self {
        Self(coefficients.to_vec())
    }

    /// Routh's criterion. A polynomial on the limit counts as unstable.
    fn has_decaying_roots_only(&self) -> bool {
        let mut highest_first: Vec<f64> = self.0.iter().rev().copied().collect();
        let leading = highest_first.iter().position(|value| *value != 0.0);
        highest_first.drain(..leading.unwrap_or(0));
        let every = |start: usize| -> Vec<f64> {
            highest_first
                .iter()
                .skip(start)
                .step_by(2)
                .copied()
                .collect()
        };
        let (mut before, mut row) = (every(0), every(1));
        let sign = before.first().copied().unwrap_or(0.0).signum();
        let at = |row: &[f64], place: usize| row.get(place).copied().unwrap_or(0.0);
        for _ in 1..highest_first.len() {
            let pivot = at(&row, 0);
            let has_same_sign = pivot * sign > 0.0;
            if !has_same_sign {
                return false;
            }
            let ratio = at(&before, 0) / pivot;
            let next =
                (1..before.len().max(1)).map(|place| at(&before, place) - ratio * at(&row, place));
            let next: Vec<f64> = next.collect();
            (before, row) = (row, next);
        }
        true
    }
}

impl std::ops::Add for &Polynomial {
    type Output = Polynomial;

    fn add(self, other: Self) -> Polynomial {
        let count = self.0.len().max(other.0.len());
        let at = |all: &[f64], power: usize| all.get(power).copied().unwrap_or(0.0);
        Polynomial(
            (0..count)
                .map(|power| at(&self.0, power) + at(&other.0, power))
                .collect(),
        )
    }
}

impl std::ops::Mul for &Polynomial {
    type Output = Polynomial;

    fn mul(self, other: Self) -> Polynomial {
        let mut product = vec![0.0; self.0.len() + other.0.len() - 1];
        for (power, a) in self.0.iter().enumerate() {
            for (more, b) in other.0.iter().enumerate() {
                product[power + more] += a * b;
            }
        }
        Polynomial(product)
    }
}

#[cfg(test)]
mod tests {
    use super::Polynomial;

    #[test]
    fn polynomials_of_known_roots_are_judged_by_them() {
        let from = |pairs: &[[f64; 2]]| {
            let mut all = Polynomial::new(&[1.0]);
            for [re, im] in pairs {
                let pair = match *im == 0.0 {
                    true => Polynomial::new(&[-re, 1.0]),
                    false => Polynomial::new(&[re * re + im * im, -2.0 * re, 1.0]),
                };
                all = &all * &pair;
            }
            all
        };
        for (roots, is_stable) in [
            (&[[-1.0, 0.0], [-2.0, 5.0], [-0.01, 30.0]][..], true),
            (&[[-1.0, 0.0], [-2.0, 5.0], [0.01, 30.0]], false),
            (&[[1.0, 0.0], [-2.0, 5.0], [-0.5, 3.0]], false),
            (&[[-1e3, 2e3], [-20.0, 0.0], [-300.0, 400.0]], true),
            (&[[-1e3, 2e3], [20.0, 100.0], [-300.0, 400.0]], false),
        ] {
            assert_eq!(
                from(roots).has_decaying_roots_only(),
                is_stable,
                "{roots:?}"
            );
        }
    }
}
