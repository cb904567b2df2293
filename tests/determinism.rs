//! The force bits are the same on every machine, so every damper and motion has one digest.

use std::fmt::Write;
use std::process::Command;

use dashpot::digest::Digest;
use dashpot::golden::{MOTIONS, STEP_S, TICKS};
use dashpot::target::{BANK_STEPS, STEPS, experiments};
use dashpot::{damper, document};
use dashpot_core::{Damper, DamperParameters, Real};
use dashpot_experiment::BANK;
use xtask::run::{cargo, repository};

/// Digest of the bits of the forces.
fn digest<T: Real>(parameters: &DamperParameters, motion: fn(f64) -> f64) -> u64 {
    let damper: Damper<T> = parameters.build(STEP_S).expect("a valid damper");
    let mut state = damper.at_rest(T::from_f64(motion(0.0)));
    let mut digest = Digest::default();
    for tick in 0..=TICKS {
        let force = damper.step(&mut state, T::from_f64(motion(STEP_S * f64::from(tick))));
        // Positive and negative zero count as the same force.
        let bits = if force == T::ZERO {
            0
        } else {
            force.to_bits_u64()
        };
        digest.add(bits.to_le_bytes());
    }
    assert!(
        state.rejected_inputs() == 0,
        "the motion is within the rate limit"
    );
    digest.value()
}

#[test]
fn forces_are_the_golden_bits() {
    let mut text = String::from("# damper, motion, digest of the f32 forces, of the f64 forces\n");
    for (name, preset, overrides) in dashpot::accuracy::DAMPERS {
        let parameters = damper(preset, overrides);
        for (motion_name, motion) in MOTIONS {
            writeln!(
                text,
                "{name}; {motion_name}; {:016x}; {:016x}",
                digest::<f32>(&parameters, motion),
                digest::<f64>(&parameters, motion)
            )
            .expect("text grows");
        }
    }
    document::compare("tests/golden/forces.txt", &text);
}

/// The digests that `tests/on_target/processors.rs` expects from the Cortex-M7.
#[test]
fn a_million_steps_have_the_golden_bits() {
    let mut text = format!(
        "# element, excitation, digest of the force bits: {STEPS} steps, of a bank of {BANK} {BANK_STEPS}\n"
    );
    for experiment in experiments(1.0) {
        let (element, excitation) = (experiment.element, experiment.excitation.name());
        let digest = experiment.digest_here();
        writeln!(text, "{element}; {excitation}; {digest}").expect("text grows");
    }
    document::compare("tests/golden/target.txt", &text);
}

/// Tests are hardly optimised; what users run is.
#[test]
fn the_optimised_core_has_the_same_bits() {
    let folder = repository().join("target/optimised");
    let build = ["build", "--locked", "--release", "--package"];
    let into = ["dashpot-experiment", "--target-dir"];
    cargo(&[&build[..], &into, &[&*folder.to_string_lossy()]].concat()).unwrap();
    for experiment in experiments(0.1) {
        let mut program = Command::new(folder.join("release/dashpot-experiment"));
        let (element, excitation) = (experiment.element, experiment.excitation.name());
        assert_eq!(
            experiment.digest_by(&mut program),
            experiment.digest_here(),
            "{element}, {excitation}"
        );
    }
}

#[test]
fn the_digest_sees_a_single_bit() {
    let parameters = damper("paper", &[]);
    let base = digest::<f32>(&parameters, |t| 1e-3 * libm::sin(9.0 * t));
    let other = digest::<f32>(&parameters, |t| {
        1e-3 * libm::sin(9.0 * t) + if t == 1.0 { 2e-9 } else { 0.0 }
    });
    assert_ne!(base, other);
}
