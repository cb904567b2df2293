//! The bench test: a harmonic motion, and the indices of one settled cycle.

use std::f64::consts::{PI, TAU};

use dashpot_core::parameters::Limits;
use dashpot_core::{Damper, DamperParameters};

/// A harmonic motion of the seats.
#[derive(Clone, Copy, Debug)]
pub struct Harmonic {
    /// Amplitude (m).
    pub amplitude_m: f64,
    /// Frequency (Hz).
    pub frequency_hz: f64,
}

/// Indices of a settled cycle; forces are positive when they resist extension.
#[derive(Clone, Copy, Debug)]
pub struct Indices {
    /// Largest force in extension (N).
    pub max_extension_force_n: f64,
    /// Largest force magnitude in compression (N).
    pub max_compression_force_n: f64,
    /// Work over the cycle, the integral of F dx (J).
    pub energy_per_cycle_j: f64,
    /// Storage stiffness K' (N/m): component of the force in phase with the displacement, over the amplitude.
    pub storage_stiffness_n_per_m: f64,
    /// Dynamic damping C_dyn (N s/m): component of the force in phase with the velocity, over the velocity amplitude.
    pub dynamic_damping_n_s_per_m: f64,
    /// Largest velocity of the motion (m/s).
    pub velocity_m_per_s: f64,
}

impl Indices {
    /// `(F_ext - F_comp)/(F_ext + F_comp)` (1), as in Table 5.
    pub fn asymmetry_rate(&self) -> f64 {
        (self.max_extension_force_n - self.max_compression_force_n)
            / (self.max_extension_force_n + self.max_compression_force_n)
    }

    /// Mean of the two largest forces over the largest velocity (N s/m).
    pub fn damping_coefficient_n_s_per_m(&self) -> f64 {
        0.5 * (self.max_extension_force_n + self.max_compression_force_n) / self.velocity_m_per_s
    }

    /// `E/(pi F x0)` (1), F the mean of the two largest forces; 1 for a linear damper.
    pub fn energy_factor(&self, amplitude_m: f64) -> f64 {
        let force = 0.5 * (self.max_extension_force_n + self.max_compression_force_n);
        self.energy_per_cycle_j / (PI * force * amplitude_m)
    }
}

/// Indices of a cycle computed by the step in `f64`, after at least four cycles and three seconds.
///
/// The cycle must be a whole number of ticks.
pub fn settled_cycle(parameters: &DamperParameters, motion: Harmonic, step_s: f64) -> Indices {
    let settling = (3.0 * motion.frequency_hz).ceil().max(4.0) as usize;
    let cycle = 1.0 / (motion.frequency_hz * step_s);
    assert!((cycle - cycle.round()).abs() < 1e-6 * cycle);
    let cycle = cycle.round() as usize;
    let phase = |tick: usize| TAU * (tick % cycle) as f64 / cycle as f64;
    let displacement = |tick: usize| motion.amplitude_m * libm::sin(phase(tick));

    let damper: Damper<f64> = parameters.build(step_s).expect("a valid damper");
    let mut state = damper.at_rest(displacement(0));
    let mut force = 0.0;
    for tick in 1..=settling * cycle {
        force = damper.step(&mut state, displacement(tick));
    }
    let (mut largest, mut smallest, mut energy) = (0.0_f64, 0.0_f64, 0.0);
    let (mut in_phase, mut in_quadrature) = (0.0, 0.0);
    for tick in settling * cycle + 1..=(settling + 1) * cycle {
        let before = force;
        force = damper.step(&mut state, displacement(tick));
        energy += 0.5 * (before + force) * (displacement(tick) - displacement(tick - 1));
        largest = largest.max(force);
        smallest = smallest.min(force);
        in_phase += force * libm::sin(phase(tick));
        in_quadrature += force * libm::cos(phase(tick));
    }
    let scale = 2.0 / (cycle as f64 * motion.amplitude_m);
    let angular = TAU * motion.frequency_hz;
    Indices {
        max_extension_force_n: largest,
        max_compression_force_n: -smallest,
        energy_per_cycle_j: energy,
        storage_stiffness_n_per_m: scale * in_phase,
        dynamic_damping_n_s_per_m: scale * in_quadrature / angular,
        velocity_m_per_s: angular * motion.amplitude_m,
    }
}

/// Settled force at a constant velocity (m/s), computed by the step in `f64` at 1 kHz.
pub fn settled_force(parameters: &DamperParameters, velocity_m_per_s: f64) -> f64 {
    const STEP_S: f64 = 1e-3;
    // The motion runs from one end of the maximum displacement range to the other, for at most 4 s.
    let mut parameters = parameters.clone();
    parameters.limits.displacement_m = Limits::RANGES.displacement_m.max;
    let start = -0.99 * parameters.limits.displacement_m * velocity_m_per_s.signum();
    let move_m = velocity_m_per_s * STEP_S;
    let ticks = (-2.0 * start / move_m).min(4000.0) as u32;
    let damper: Damper<f64> = parameters.build(STEP_S).expect("a valid damper");
    let mut state = damper.at_rest(start);
    let force = (1..=ticks).fold(0.0, |_, tick| {
        damper.step(&mut state, start + move_m * f64::from(tick))
    });
    assert_eq!(state.rejected_inputs(), 0);
    force
}
