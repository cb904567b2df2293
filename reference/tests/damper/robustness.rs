//! Difficult motions (noise, jumps, near rest) with stiff and soft springs: the second solver must agree, and the
//! damper must not generate energy.

use dashpot_core::DamperParameters;
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::nrmse;

use crate::common::motions::Motion;
use crate::common::radau::Radau;
use crate::common::{dampers, motions};

/// Fixed sequence of pseudorandom numbers in [0, 1).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Displacements at alternating intervals of 1 and 0.1 ms.
fn uneven(displacement: impl FnMut(usize) -> f64) -> Motion {
    let mut times = vec![0.0];
    for i in 1..300 {
        times.push(times[i - 1] + if i % 2 == 0 { 1e-4 } else { 1e-3 });
    }
    (times, (0..300).map(displacement).collect())
}

fn hard_motions() -> Vec<(&'static str, Motion)> {
    let mut sequence = Sequence(88_172_645_463_325_252);
    let mut walk = 0.0;
    let coarse = uneven(|_| {
        walk += (sequence.next() - 0.5) * 2e-3;
        walk
    });
    let mut place = 0.0;
    let jumps = uneven(|_| {
        if sequence.next() < 0.1 {
            place = (sequence.next() - 0.5) * 6e-3;
        }
        place
    });
    let mut creep = 0.0;
    let creeping = uneven(|i| {
        creep += (sequence.next() - 0.5) * 1e-12 + if i == 50 { 2e-3 } else { 0.0 };
        creep
    });
    let fading = uneven(|i| 2e-3 * (i as f64 * 0.37).sin() * 10f64.powf(-(i as f64) / 20.0));
    vec![
        ("coarse", coarse),
        ("jumps", jumps),
        ("creeping", creeping),
        ("fading", fading),
    ]
}

/// Largest normalised difference allowed between ESDIRK5 and Radau5; 2.3e-7 is the largest seen.
const AGREEMENT: f64 = 1e-6;

fn survives(parameters: &DamperParameters) {
    for stiffness in [1e6, 6e6, 4e7] {
        for clearance in [0.0, 1e-3] {
            let mut parameters = parameters.clone();
            parameters.mount.stiffness_n_per_m = stiffness;
            parameters.mount.clearance_m = clearance;
            for (name, (times, x)) in hard_motions() {
                let case = format!("{name}, {stiffness} N/m, {clearance} m");
                let mut reference = Reference::new(&parameters).expect("laws");
                let force = reference.forces(&times, &x).expect(&case);
                let other = reference
                    .forces_with(&mut Radau::default(), &times, &x)
                    .expect(&case);
                let difference = nrmse(&force, &other);
                println!("{case}: {difference:.1e}");
                assert!(difference < AGREEMENT, "{case}: {difference:e}");
                let largest = force.iter().fold(0.0_f64, |a, f| a.max(f.abs()));
                assert!(largest <= parameters.limits.force_n, "{case}: {largest} N");
            }
        }
    }
}

#[test]
fn paper() {
    survives(&dampers::paper());
}

#[test]
fn reduced() {
    survives(&dampers::reduced_vertical());
}

#[test]
fn in_service_lumped() {
    survives(&dampers::in_service(false));
}

#[test]
fn in_service_two_chamber() {
    survives(&dampers::in_service(true));
}

/// Springs and valves are passive: the work done on them since rest is never negative, and most of it is dissipated.
#[test]
fn work_is_dissipated() {
    for parameters in [
        dampers::paper(),
        dampers::paper_with_clearance(),
        dampers::reduced_vertical(),
        dampers::in_service(false),
        dampers::in_service(true),
    ] {
        let (times, x) = motions::ride(10e3, 1.0);
        let force = Reference::new(&parameters)
            .expect("laws")
            .forces(&times, &x)
            .expect("forces");
        let (mut work, mut moved) = (0.0, 0.0);
        for i in 1..times.len() {
            let step = 0.5 * (force[i] + force[i - 1]) * (x[i] - x[i - 1]);
            work += step;
            moved += step.abs();
            // Within 0.1 ms the force is linear to 1e-3, the error of the trapezoidal rule.
            assert!(work >= -1e-6 * moved, "{} s: {work} J", times[i]);
        }
        assert!(work > 0.5 * moved, "{work} J of {moved} J");
    }
}

#[test]
fn nothing_moves_nothing_pushes() {
    let times: Vec<f64> = (0..100).map(|i| f64::from(i) * 1e-3).collect();
    for parameters in [dampers::paper(), dampers::in_service(true)] {
        let mut reference = Reference::new(&parameters).expect("laws");
        let still = reference.forces(&times, &vec![0.012; 100]).expect("forces");
        assert!(still.iter().all(|force| *force == 0.0));
    }
    let inside: Vec<f64> = times.iter().map(|t| 0.49e-3 * (300.0 * t).sin()).collect();
    let force = Reference::new(&dampers::paper_with_clearance())
        .expect("laws")
        .forces(&times, &inside)
        .expect("forces");
    assert!(force.iter().all(|force| *force == 0.0));
}
