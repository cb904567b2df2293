//! The promise that no command steps, over all allowed settings: drawn from the whole range, then climbed.

use dashpot_core::hybrid::{Guard, GuardAction, GuardSettings, HybridStatus};
use fastrand::Rng;

const TICKS: usize = 80;
const STARTS: usize = 300;
const CLIMBS: usize = 60;

/// Wanted command and desired displacement (m), and measured displacement (m) and force (N), of a tick.
type Asked = (f32, f32, Option<(f32, f32)>);

/// A guard, and all that it is asked: wanted command, desired displacement and measured values of each tick.
#[derive(Clone, Debug)]
struct Trial {
    settings: GuardSettings,
    step_s: f32,
    ticks: Vec<Asked>,
}

/// A number from the whole range, by its logarithm.
fn draw(random: &mut Rng, least: f32, most: f32) -> f32 {
    (least * (most / least).powf(random.f32())).clamp(least, most)
}

/// A number from 0 on.
fn from_0(random: &mut Rng, most: f32) -> f32 {
    if random.u8(0..5) == 0 {
        0.0
    } else {
        draw(random, 1e-6 * most, most)
    }
}

fn settings(random: &mut Rng) -> GuardSettings {
    GuardSettings {
        stroke_m: draw(random, 1e-4, 1.0),
        velocity_m_per_s: draw(random, 1e-3, 10.0),
        limited_s: from_0(random, 10.0),
        force_n: draw(random, 1.0, 1e7),
        error_m: draw(random, 1e-5, 1.0),
        error_s: from_0(random, 10.0),
        age_s: from_0(random, 10.0),
        plausible_m_per_s: draw(random, 1e-3, 1e3),
        plausible_n_per_s: draw(random, 1.0, 1e12),
        stuck_travel_m: draw(random, 1e-6, 1.0),
        least_force_n: from_0(random, 1e7),
        without_force_m: draw(random, 1e-6, 100.0),
        ramp_s: draw(random, 0.01, 10.0),
        approach_m_per_s: draw(random, 1e-4, 1.0),
        action: if random.bool() {
            GuardAction::Hold
        } else {
            GuardAction::ZeroForce
        },
        stiffness_n_per_m: draw(random, 1e3, 1e12),
    }
}

/// A displacement or force about as large as `size`, or a number that no sensor reads.
fn value(random: &mut Rng, size: f32) -> f32 {
    match random.u8(0..12) {
        0 => f32::NAN,
        1 => f32::INFINITY,
        2 => f32::from_bits(random.u32(..)),
        3 => 0.0,
        _ => size * (2.0 * random.f32() - 1.0),
    }
}

fn tick(random: &mut Rng, settings: &GuardSettings) -> Asked {
    let size_m = 1.2 * settings.stroke_m;
    let measured = (value(random, size_m), value(random, 1.2 * settings.force_n));
    (
        value(random, size_m),
        value(random, size_m),
        (random.u8(0..6) > 0).then_some(measured),
    )
}

fn trial(random: &mut Rng) -> Trial {
    let settings = settings(random);
    Trial {
        step_s: draw(random, 1e-5, 0.02),
        ticks: (0..TICKS).map(|_| tick(random, &settings)).collect(),
        settings,
    }
}

/// Largest change of the command over what the limit and the resolution of single precision allow.
fn ratio(trial: &Trial) -> f32 {
    let mut guard = Guard::new(&trial.settings, trial.step_s).unwrap();
    let (mut last_m, mut most) = (0.0_f32, 0.0_f32);
    for (number, (wanted_m, desired_m, measured)) in trial.ticks.iter().enumerate() {
        let command_m = guard.step(*wanted_m, *desired_m, *measured);
        assert!(command_m.abs() <= trial.settings.stroke_m, "{trial:?}");
        let allowed_m =
            trial.settings.velocity_m_per_s * trial.step_s + f32::EPSILON * last_m.abs();
        most = most.max((command_m - last_m).abs() / allowed_m);
        last_m = command_m;
        if number % 40 == 39 {
            guard.end(HybridStatus::REQUESTED);
            guard.clear();
        }
    }
    most
}

/// Changes one thing of a trial.
fn changed(random: &mut Rng, trial: &Trial) -> Trial {
    let mut next = trial.clone();
    match random.u8(0..4) {
        0 => next.settings = settings(random),
        1 => next.step_s = draw(random, 1e-5, 0.02),
        _ => {
            let place = random.usize(0..TICKS);
            next.ticks[place] = tick(random, &next.settings);
        }
    }
    next
}

#[test]
fn no_allowed_setting_lets_a_command_step() {
    let mut random = Rng::with_seed(31);
    let mut worst = 0.0_f32;
    for _ in 0..STARTS {
        let mut best = trial(&mut random);
        let mut reached = ratio(&best);
        for _ in 0..CLIMBS {
            let next = changed(&mut random, &best);
            let found = ratio(&next);
            if found >= reached {
                (best, reached) = (next, found);
            }
        }
        assert!(reached <= 1.001, "{reached} times the limit: {best:?}");
        worst = worst.max(reached);
    }
    // The search has met the limit.
    assert!(worst > 0.99, "{worst}");
}
