//! Synthetic data: rides of any length, faults, and the estimates from them.

use std::f64::consts::TAU;

use dashpot::damper;
use dashpot_core::health::{Health, HealthModel, HealthReading, HealthSettings, HealthStatus};
use dashpot_core::parameters::Element;
use dashpot_core::{Damper, DamperParameters};
use dashpot_testbench::health::Noise;
use fastrand::Rng;

/// Step of all samples (s).
pub const STEP_S: f64 = 1e-3;
/// Every preset.
pub const PRESETS: [&str; 4] = ["paper", "in-service", "reduced-vertical", "reduced-lateral"];

/// Status bits that report wear.
pub const WEAR: HealthStatus = HealthStatus::FLOW
    .union(HealthStatus::STIFFNESS)
    .union(HealthStatus::CLEARANCE);

/// Displacements (m) of the ride of `Excitation::Ride` (98 harmonics from 0.4 to 20 Hz, v_rms 0.04 m/s) with
/// frequencies and phases from a seed.
pub fn ride(seed: u64, ticks: usize) -> Vec<f64> {
    const VELOCITY_RMS: f64 = 0.04;
    let mut rng = Rng::with_seed(seed);
    let lines: Vec<(f64, f64, f64)> = (0..98)
        .map(|line| {
            let frequency = 0.4 + 0.2 * (f64::from(line) + rng.f64());
            let ratio = frequency / 1.4;
            let mode = ((1.0 - ratio * ratio).powi(2) + (0.6 * ratio).powi(2)).sqrt();
            (1.0 / mode, TAU * frequency, TAU * rng.f64())
        })
        .collect();
    let square: f64 = lines.iter().map(|(a, w, _)| (a * w).powi(2) / 2.0).sum();
    let scale = VELOCITY_RMS / square.sqrt();
    let mut displacements = vec![0.0; ticks];
    for (amplitude, frequency, phase) in lines {
        let (turn_sine, turn_cosine) =
            (libm::sin(frequency * STEP_S), libm::cos(frequency * STEP_S));
        let (mut sine, mut cosine) = (libm::sin(phase), libm::cos(phase));
        let start = sine;
        for x in &mut displacements {
            *x += scale * amplitude * (sine - start);
            (sine, cosine) = (
                sine * turn_cosine + cosine * turn_sine,
                cosine * turn_cosine - sine * turn_sine,
            );
        }
    }
    displacements
}

/// Fault of a damper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    None,
    /// 2a increased by 1 mm.
    Clearance,
    /// Ke halved: rubber and seats.
    Stiffness,
    /// Every discharge coefficient increased by 25 %; for the reduced element, the velocity at the same force.
    Flow,
}

impl Fault {
    pub const ALL: [Self; 4] = [Self::None, Self::Clearance, Self::Stiffness, Self::Flow];

    pub fn on(self, parameters: &DamperParameters) -> DamperParameters {
        let mut faulty = parameters.clone();
        let mount = &mut faulty.mount;
        match self {
            Self::None => {}
            Self::Clearance => mount.clearance_m += 1e-3,
            Self::Stiffness => {
                mount.stiffness_n_per_m *= 0.5;
                mount.seat_stiffness_n_per_m = mount.seat_stiffness_n_per_m.map(|seat| 0.5 * seat);
            }
            Self::Flow => match &mut faulty.element {
                Element::Reduced(reduced) => {
                    reduced.damping_n_s_per_m /= 1.25;
                    reduced.saturation_velocity_m_per_s *= 1.25;
                }
                Element::Physical(hydraulics) => {
                    hydraulics.orifice.discharge_coefficient *= 1.25;
                    let valves = &mut hydraulics.valves;
                    for valve in [
                        &mut valves.piston_extension,
                        &mut valves.piston_compression,
                        &mut valves.foot_compression,
                    ] {
                        valve.discharge_coefficient *= 1.25;
                    }
                    if let Some(relief) = &mut hydraulics.relief {
                        relief.discharge_coefficient *= 1.25;
                    }
                }
                other => panic!("no flow of {other:?}"),
            },
        }
        faulty
    }

    /// Flow factor that the fault causes.
    pub fn flow_factor(self) -> f64 {
        if self == Self::Flow { 1.25 } else { 1.0 }
    }
}

/// A preset, or a random damper near it if there is a seed.
pub fn varied(preset: &str, seed: Option<u64>) -> DamperParameters {
    let mut parameters = damper(preset, &[]);
    let Some(seed) = seed else {
        return parameters;
    };
    let mut rng = Rng::with_seed(seed ^ 0xd4a9);
    let mut factor = |least: f64, most: f64| least * (most / least).powf(rng.f64());
    let stiffness = factor(0.7, 1.4);
    parameters.mount.stiffness_n_per_m *= stiffness;
    parameters.mount.clearance_m = 1e-3 * (factor(0.5, 2.5) - 0.5);
    match &mut parameters.element {
        Element::Reduced(reduced) => {
            reduced.damping_n_s_per_m *= factor(0.7, 1.4);
            reduced.saturation_velocity_m_per_s *= factor(1.0, 1.5);
        }
        Element::Physical(hydraulics) => hydraulics.orifice.diameter_m *= factor(0.8, 1.25),
        other => panic!("no variation of {other:?}"),
    }
    parameters
}

/// Forces (N) of a damper that is replaced by another at a tick, keeping its force.
pub fn forces(
    before: &DamperParameters,
    after: &DamperParameters,
    change: usize,
    displacements_m: &[f64],
) -> Vec<f64> {
    let [before, after]: [Damper<f64>; 2] =
        [before, after].map(|parameters| parameters.build(STEP_S).unwrap());
    let mut state = before.at_rest(displacements_m[0]);
    let ticks = displacements_m.iter().enumerate();
    ticks
        .map(|(tick, x)| if tick < change { &before } else { &after }.step(&mut state, *x))
        .collect()
}

/// A model that knows the actual noise.
pub fn model(parameters: &DamperParameters, noise: &Noise) -> HealthModel {
    let settings = HealthSettings::new(noise.displacement_m, noise.force_n);
    let checked = parameters.check().unwrap();
    checked.health_model(&settings, STEP_S).unwrap()
}

/// Estimate after the samples.
pub fn estimate(model: &HealthModel, displacements_m: &[f64], forces_n: &[f64]) -> HealthReading {
    let mut health = Health::new(model);
    for (x, force) in displacements_m.iter().zip(forces_n) {
        health.tick(model, *x as f32, *force as f32);
    }
    health.reading(model)
}

/// Errors of an estimate: flow factor (relative), stiffness (relative) and clearance (m), then each error divided by
/// its standard deviation.
pub fn errors(reading: &HealthReading, truth: &DamperParameters, fault: Fault) -> [f64; 6] {
    let part = |value: f32, truth: f64| f64::from(value) / truth - 1.0;
    let compliance = truth.mount.compliance_m_per_n();
    let flow = part(reading.flow_factor.value, fault.flow_factor());
    let clearance = f64::from(reading.clearance_m.value) - truth.mount.clearance_m;
    let compliance_error = f64::from(reading.compliance_m_per_n.value) - compliance;
    [
        flow,
        part(reading.stiffness_n_per_m.value, 1.0 / compliance),
        clearance,
        flow * fault.flow_factor() / f64::from(reading.flow_factor.sd),
        compliance_error / f64::from(reading.compliance_m_per_n.sd),
        clearance / f64::from(reading.clearance_m.sd),
    ]
}

/// Largest and mean magnitude.
pub fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| most.max(value.abs()))
}
