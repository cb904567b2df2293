//! Estimates from samples that the core's step did not compute: from the reference solution, and from a law that no
//! parameter describes.

use dashpot_core::DamperParameters;
use dashpot_core::health::{Health, HealthSettings, HealthStatus};
use dashpot_core::parameters::Mount;
use dashpot_reference::damper::Reference;
use dashpot_testbench::health::Noise;

use crate::synthetic::{Fault, PRESETS, STEP_S, errors, estimate, model, ride, varied};

#[test]
fn faults_in_forces_of_the_reference_are_known() {
    const TICKS: usize = 10_000;
    for preset in PRESETS {
        for (fault, seed) in Fault::ALL.into_iter().zip(200..) {
            let healthy = varied(preset, None);
            let faulty = fault.on(&healthy);
            let x = ride(seed, TICKS);
            let times: Vec<f64> = (0..TICKS).map(|tick| tick as f64 * STEP_S).collect();
            let force = Reference::new(&faulty).unwrap().forces(&times, &x).unwrap();
            let noise = Noise::from_rms(0.02, &x, &force);
            let (x, force) = noise.add_to(&x, &force, seed);
            let reading = estimate(&model(&healthy, &noise), &x, &force);
            let [flow, stiffness, clearance, ..] = errors(&reading, &faulty, fault);
            println!(
                "{preset}, {fault:?}: flow {:.2} %, Ke {:.2} %, 2a {:.3} mm",
                1e2 * flow,
                1e2 * stiffness,
                1e3 * clearance
            );
            assert!(flow.abs() < 0.03, "{preset}, {fault:?}: flow {flow}");
            assert!(
                stiffness.abs() < 0.10,
                "{preset}, {fault:?}: Ke {stiffness}"
            );
            assert!(
                clearance.abs() < 0.15e-3,
                "{preset}, {fault:?}: 2a {clearance}"
            );
        }
    }
}

/// A damper in series with its springs, with the law `F = C v (1 + 0.4 tanh(v/v_t))`, which bends unlike any preset's.
/// A flow fault scales the law.
struct Bent {
    flow: f64,
    stiffness_n_per_m: f64,
    clearance_m: f64,
}

impl Bent {
    const DAMPING: f64 = 80e3;
    const BEND_M_PER_S: f64 = 0.03;

    /// Velocity of the piston (m/s) under a force, by bisection.
    fn velocity(&self, force: f64) -> f64 {
        let law = |v: f64| Self::DAMPING * v * (1.0 + 0.4 * (v / Self::BEND_M_PER_S).tanh());
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if law(middle) < force.abs() {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.flow * low.copysign(force)
    }

    /// Forces (N) from rest, computed with explicit steps of a fiftieth of a tick.
    fn forces(&self, displacements: &[f64]) -> Vec<f64> {
        const PARTS: u32 = 50;
        let mut stretch = 0.0_f64;
        let force = |stretch: f64| {
            let beyond = (stretch.abs() - 0.5 * self.clearance_m).max(0.0);
            (self.stiffness_n_per_m * beyond).copysign(stretch)
        };
        let mut last = displacements[0];
        displacements
            .iter()
            .map(|x| {
                let travel = (x - last) / f64::from(PARTS);
                last = *x;
                for _ in 0..PARTS {
                    stretch += travel - self.velocity(force(stretch)) * STEP_S / f64::from(PARTS);
                }
                force(stretch)
            })
            .collect()
    }
}

/// The model assumes a linear law. It learns a baseline from the healthy damper and finds faults as changes from it.
#[test]
fn faults_of_another_law_are_known_against_its_baseline() {
    const TICKS: usize = 20_000;
    let nominal = DamperParameters::reduced(110e3, 1.0, Mount::new(8e6));
    let healthy = Bent {
        flow: 1.0,
        stiffness_n_per_m: 7e6,
        clearance_m: 0.4e-3,
    };
    let run = |bent: &Bent, seed: u64| {
        let x = ride(seed, TICKS);
        let force = bent.forces(&x);
        let noise = Noise::from_rms(0.02, &x, &force);
        (noise, noise.add_to(&x, &force, seed))
    };
    let (noise, (x, force)) = run(&healthy, 301);
    let settings = HealthSettings::new(noise.displacement_m, noise.force_n).law_deviation(0.2);
    let mut model = nominal
        .check()
        .unwrap()
        .health_model(&settings, STEP_S)
        .unwrap();
    let learned = estimate(&model, &x, &force);
    println!("learned {learned:?}");
    model.set_baseline(learned.as_baseline()).unwrap();
    let alarms = HealthStatus::FLOW | HealthStatus::STIFFNESS | HealthStatus::CLEARANCE;
    for (bent, expected) in [
        (Bent { ..healthy }, HealthStatus::empty()),
        (
            Bent {
                clearance_m: 1.4e-3,
                ..healthy
            },
            HealthStatus::CLEARANCE,
        ),
        (
            Bent {
                stiffness_n_per_m: 3.5e6,
                ..healthy
            },
            HealthStatus::STIFFNESS,
        ),
        (
            Bent {
                flow: 1.25,
                ..healthy
            },
            HealthStatus::FLOW,
        ),
    ] {
        for seed in 302..305 {
            let (_, (x, force)) = run(&bent, seed);
            let mut health = Health::new(&model);
            for (x, force) in x.iter().zip(&force) {
                health.tick(&model, *x as f32, *force as f32);
            }
            let reading = health.reading(&model);
            let (base, now) = (learned.as_baseline(), reading.as_baseline());
            let flow = now.flow_factor / base.flow_factor;
            let stiffness = base.compliance_m_per_n / now.compliance_m_per_n;
            let clearance = now.clearance_m - base.clearance_m;
            println!(
                "{expected:?}: flow x {flow:.3}, Ke x {stiffness:.3}, 2a + {:.3} mm",
                1e3 * clearance
            );
            assert_eq!(
                reading.status & alarms,
                expected,
                "seed {seed}: {reading:?}"
            );
        }
    }
}
