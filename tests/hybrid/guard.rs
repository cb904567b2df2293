//! Promises of the guard, for any input.

use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, EnergySettings, GuardAction, GuardSettings, HybridStatus,
    Measured, Motion, TransferSettings, TransferSystem,
};
use proptest::prelude::*;

const STEP_S: f32 = 1e-3;

fn settings(action: GuardAction) -> TransferSettings {
    TransferSettings {
        guard: GuardSettings {
            action,
            ..GuardSettings::new(0.05, 0.5, 20e3)
        },
        energy: EnergySettings::default(),
        tracking_window_s: 1.0,
        tracking_error: 0.3,
    }
}

fn system(action: GuardAction) -> TransferSystem<AdaptiveTimeSeries> {
    let adaptive = AdaptiveSettings::new([1.0, 0.015, 1e-4, 0.0], 0.005);
    let compensator = AdaptiveTimeSeries::new(&adaptive, STEP_S).unwrap();
    TransferSystem::new(compensator, &settings(action), STEP_S).unwrap()
}

/// Numbers of all sizes, and those that are none.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        -0.06f32..0.06,
        -30e3f32..30e3,
        any::<f32>(),
        Just(f32::NAN),
        Just(f32::INFINITY),
        Just(0.0)
    ]
}

fn tick() -> impl Strategy<Value = ([f32; 4], Option<(f32, f32)>, u8)> {
    let motion = [number(), number(), number(), number()];
    (motion, proptest::option::of((number(), number())), 0u8..200)
}

proptest! {
    /// Whatever comes in, the command stays within stroke and rate, and everything that comes out is finite.
    #[test]
    fn no_command_ever_steps(ticks in proptest::collection::vec(tick(), 1..60), releases: bool) {
        let action = if releases { GuardAction::ZeroForce } else { GuardAction::Hold };
        let mut system = system(action);
        let (mut last, mut last_force_n, mut had_ended) = (0.0_f32, 0.0_f32, false);
        for (motion, measured, repeats) in ticks {
            let desired = Motion {
                displacement_m: motion[0],
                velocity_m_per_s: motion[1],
                acceleration_m_per_s2: motion[2],
                jerk_m_per_s3: motion[3],
            };
            for _ in 0..=repeats {
                let measured = measured.map(|(displacement_m, force_n)| Measured { displacement_m, force_n });
                let out = system.tick(&desired, measured);
                prop_assert!((out.command_m - last).abs() <= 0.5 * STEP_S * 1.0001, "{last} {out:?}");
                prop_assert!(out.command_m.abs() <= 0.05 && out.force_n.is_finite());
                let reading = system.tracking();
                for value in [reading.delay_s, reading.amplitude, reading.relative_error] {
                    prop_assert!(value.is_finite(), "{reading:?}");
                }
                prop_assert!(system.energy().added_j().is_finite() && system.energy().added_share().is_finite());
                prop_assert!(system.compensator().coefficients().iter().all(|a| a.is_finite()));
                // After the end the force for the vehicle only fades, whatever the rig measures.
                prop_assert!(!had_ended || out.force_n.abs() <= last_force_n.abs(), "{last_force_n} {out:?}");
                (last, last_force_n, had_ended) = (out.command_m, out.force_n, system.guard().has_ended());
            }
            if repeats == 7 {
                system.guard().clear();
                had_ended = system.guard().has_ended();
            }
        }
    }
}

/// A sine of 10 mm at 1 Hz, the damper's force in phase with its velocity, and a perfect actuator.
fn sine(tick: u32) -> (Motion, Measured) {
    let phase = std::f32::consts::TAU * STEP_S * tick as f32;
    let omega = std::f32::consts::TAU;
    let desired = Motion {
        velocity_m_per_s: 0.01 * omega * phase.cos(),
        acceleration_m_per_s2: -0.01 * omega * omega * phase.sin(),
        ..Motion::at_rest(0.01 * phase.sin())
    };
    let measured = Measured {
        displacement_m: desired.displacement_m,
        force_n: 50e3 * desired.velocity_m_per_s,
    };
    (desired, measured)
}

/// Runs a good test up to tick 3000, then changes what is measured; returns the status and the ticks until the end.
fn after(change: impl Fn(u32, Measured) -> Option<Measured>) -> (HybridStatus, u32) {
    let mut system = system(GuardAction::Hold);
    for tick in 0..20_000 {
        let (desired, measured) = sine(tick);
        let measured = match tick < 3000 {
            true => Some(measured),
            false => change(tick, measured),
        };
        let status = system.tick(&desired, measured).status;
        let ending = status & HybridStatus::ENDING;
        assert!(tick >= 3000 || ending.is_empty(), "tick {tick}: {status:?}");
        if !ending.is_empty() {
            return (ending, tick - 3000);
        }
    }
    (HybridStatus::empty(), 0)
}

#[test]
fn a_good_test_does_not_end() {
    assert_eq!(
        after(|_, measured| Some(measured)),
        (HybridStatus::empty(), 0)
    );
}

#[test]
fn each_fault_ends_the_test_with_its_reason() {
    let ends = |expected: HybridStatus,
                within: u32,
                change: &dyn Fn(u32, Measured) -> Option<Measured>| {
        let (found, ticks) = after(change);
        assert!(
            found.contains(expected) && ticks <= within,
            "{expected:?}: {found:?} after {ticks} ticks"
        );
    };
    ends(HybridStatus::AGE, 12, &|_, _| None);
    ends(HybridStatus::IMPLAUSIBLE, 12, &|_, measured| {
        Some(Measured {
            displacement_m: f32::NAN,
            ..measured
        })
    });
    ends(HybridStatus::FORCE, 1, &|_, measured| {
        Some(Measured {
            force_n: 21e3,
            ..measured
        })
    });
    let (_, stuck) = sine(2999);
    ends(HybridStatus::IMPLAUSIBLE, 100, &|_, measured| {
        Some(Measured {
            displacement_m: stuck.displacement_m,
            ..measured
        })
    });
    ends(HybridStatus::SIGN, 2000, &|_, measured| {
        Some(Measured {
            force_n: -measured.force_n,
            ..measured
        })
    });
    ends(HybridStatus::TRACKING, 400, &|_, measured| {
        Some(Measured {
            displacement_m: -measured.displacement_m,
            ..measured
        })
    });
}

/// A measurement that is missing now and then, or a single wild one, does not end a test.
#[test]
fn single_bad_measurements_are_survived() {
    let (found, _) = after(|tick, measured| match tick % 20 {
        ..8 => None,
        12 => Some(Measured {
            displacement_m: 3.0,
            ..measured
        }),
        _ => Some(measured),
    });
    assert_eq!(found, HybridStatus::empty());
}

/// The command comes to rest in the stated time, and a cleared test starts again without a step.
#[test]
fn an_ended_test_rests_and_can_start_again() {
    let mut system = system(GuardAction::Hold);
    let mut commands = Vec::new();
    for tick in 0..6000 {
        let (desired, measured) = sine(tick);
        if tick == 3000 {
            system.guard().end(HybridStatus::REQUESTED);
            assert!(!system.guard().clear(), "cleared while it moves");
        }
        if tick == 4000 {
            assert!(system.guard().is_held());
            assert!(system.guard().clear());
        }
        let out = system.tick(&desired, Some(measured));
        if (3300..4000).contains(&tick) {
            assert_eq!(out.force_n, 0.0);
            assert_eq!(out.status, HybridStatus::REQUESTED);
        }
        commands.push(out.command_m);
    }
    assert!(
        commands[3201..4000]
            .iter()
            .all(|command| *command == commands[3200])
    );
    assert!(system.guard().is_running());
    for pair in commands.windows(2) {
        assert!((pair[1] - pair[0]).abs() <= 0.5 * STEP_S * 1.0001);
    }
}

/// A host that is suspended finds the rig at rest. Its late reading does not make the fading force jump.
#[test]
fn the_force_for_the_vehicle_fades_evenly_after_a_gap() {
    let mut system = system(GuardAction::Hold);
    let (mut last_n, mut fading) = (None, 0);
    for tick in 0..3400 {
        let (desired, measured) = sine(tick);
        let measured = match tick {
            ..3000 => Some(measured),
            3000..3060 => None,
            _ => Some(Measured {
                force_n: 0.0,
                ..measured
            }),
        };
        let force_n = system.tick(&desired, measured).force_n;
        if system.guard().has_ended() {
            let last_n: f32 = last_n.expect("the test ran before it ended");
            let change_n = (force_n - last_n).abs();
            assert!(
                change_n < 0.006 * 3141.6,
                "tick {tick}: {last_n} then {force_n}"
            );
            fading += 1;
        }
        last_n = Some(force_n);
    }
    assert!(fading > 300);
    assert_eq!(last_n, Some(0.0));
}
