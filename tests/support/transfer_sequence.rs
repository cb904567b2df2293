//! A hybrid test through every fault, of which each language must compute the same bits.
//!
//! The actuator is computed in double precision with sums and products only, so that the package of Python can repeat
//! it; python/tests/test_hybrid.py does.

use dashpot_core::BuildError;
use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, EnergySettings, GuardAction, GuardSettings, HybridStatus,
    Measured, Motion, MotionFilter, TransferSettings, TransferSystem,
};
use dashpot_experiment::digest::Digest;

/// Step (s).
pub const STEP_S: f32 = 1e-3;
/// Ticks from one fault to the next; the test is cleared at the end of each.
pub const SPAN: usize = 1000;
/// Tick of a span at which its fault begins.
const FAULT_AT: usize = 600;
/// Number of faults, with the first span, which has none.
const FAULTS: usize = 17;
/// Pole of the motion filter (Hz).
pub const FILTER_POLE_HZ: f32 = 40.0;

/// A tick: what goes in and what comes out.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Desired displacement (m).
    pub desired_m: f32,
    /// Measured displacement (m) and force (N).
    pub measured: Option<[f32; 2]>,
    /// True if the program ends the test before the tick.
    pub ends: bool,
    /// Motion that the filter estimates.
    pub motion: [f32; 4],
    /// Command (m) and force for the vehicle (N).
    pub command: [f32; 2],
    /// Status after the tick.
    pub status: u16,
    /// At the end of a span, before it is cleared: tracking (4), energy (2) and coefficients (4).
    pub reading: Option<[f32; 10]>,
}

/// Settings of the test but for its compensator.
pub fn settings(action: GuardAction) -> TransferSettings {
    TransferSettings {
        guard: GuardSettings {
            action,
            limited_s: 0.02,
            approach_m_per_s: 0.2,
            without_force_m: 0.02,
            ..GuardSettings::new(0.05, 0.5, 20e3)
        },
        energy: EnergySettings {
            window_s: 0.3,
            ..EnergySettings::default()
        },
        tracking_window_s: 1.0,
        tracking_error: 0.3,
    }
}

/// Settings of the compensator.
pub fn adaptive() -> AdaptiveSettings {
    AdaptiveSettings::new([1.0, 0.008, 3.2e-5, 8.5e-8], 0.006)
}

/// Input of a tick: desired displacement (m), measured displacement (m) and force (N), and whether the program ends the
/// test before it.
type Input = (f32, Option<[f32; 2]>, bool);

/// Runs the test with the core.
///
/// # Errors
/// None, as long as the settings are allowed.
pub fn run(action: GuardAction) -> Result<Vec<Row>, BuildError> {
    ticks(action, |tick, [reached_m, velocity_m_per_s], random| {
        let noise = f64::from(random >> 8) / 16_777_216.0 - 0.5;
        let sensed = [
            reached_m + 2e-6 * noise,
            20e3 * velocity_m_per_s + 20.0 * noise,
        ];
        let measured = measured(tick, sensed, noise).map(|pair| pair.map(|value| value as f32));
        let ends = tick == 12 * SPAN + FAULT_AT;
        (desired_m(tick) as f32, measured, ends)
    })
}

/// Runs a test in which any number may be any bits, between ticks that are as they should be.
///
/// # Errors
/// None, as long as the settings are allowed.
pub fn run_wild(action: GuardAction) -> Result<Vec<Row>, BuildError> {
    let mut bits = 5_u64;
    // Upper bits of a congruential generator (Knuth, MMIX).
    let mut draw = move || {
        bits = bits
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (bits >> 32) as u32
    };
    ticks(
        action,
        move |tick, [reached_m, velocity_m_per_s], random| {
            let noise = f64::from(random >> 8) / 16_777_216.0 - 0.5;
            let wanted = [
                0.5 * desired_m(tick),
                reached_m + 2e-6 * noise,
                20e3 * velocity_m_per_s + 20.0 * noise,
            ];
            let [desired_m, displacement_m, force_n] = wanted.map(|value| match draw() % 2000 {
                0 => f32::from_bits(draw()),
                1 => (value + 0.02 * noise) as f32,
                _ => value as f32,
            });
            let measured = (draw() % 100 > 0).then_some([displacement_m, force_n]);
            (desired_m, measured, draw() % 2000 == 0)
        },
    )
}

/// Runs a test; `input` gets the tick, the displacement (m) and velocity (m/s) of the actuator, and a random number.
fn ticks(
    action: GuardAction,
    mut input: impl FnMut(usize, [f64; 2], u32) -> Input,
) -> Result<Vec<Row>, BuildError> {
    let compensator = AdaptiveTimeSeries::new(&adaptive(), STEP_S)?;
    let mut system = TransferSystem::new(compensator, &settings(action), STEP_S)?;
    let mut filter = MotionFilter::new(FILTER_POLE_HZ, STEP_S)?;
    let (mut reached_m, mut velocity_m_per_s, mut random) = (0.0_f64, 0.0_f64, 1_u32);
    let mut rows = Vec::with_capacity(FAULTS * SPAN);
    for tick in 0..FAULTS * SPAN {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let (desired_m, measured, ends) = input(tick, [reached_m, velocity_m_per_s], random);
        if ends {
            system.guard().end(HybridStatus::REQUESTED);
        }
        let motion = if desired_m.is_finite() {
            filter.push(desired_m)
        } else {
            filter.rest_at(0.0);
            Motion::at_rest(desired_m)
        };
        let pair = measured.map(|[displacement_m, force_n]| Measured {
            displacement_m,
            force_n,
        });
        let command = system.tick(&motion, pair);
        let change_m = 0.1 * (f64::from(command.command_m) - reached_m);
        reached_m += change_m;
        velocity_m_per_s = 1000.0 * change_m;
        let is_last = tick % SPAN == SPAN - 1;
        rows.push(Row {
            desired_m,
            measured,
            ends,
            motion: [
                motion.displacement_m,
                motion.velocity_m_per_s,
                motion.acceleration_m_per_s2,
                motion.jerk_m_per_s3,
            ],
            command: [command.command_m, command.force_n],
            status: command.status.bits(),
            reading: is_last.then(|| reading(&system)),
        });
        if is_last {
            system.guard().clear();
        }
    }
    Ok(rows)
}

fn reading(system: &TransferSystem<AdaptiveTimeSeries>) -> [f32; 10] {
    let (tracking, energy) = (system.tracking(), system.energy());
    let [a0, a1, a2, a3] = system.compensator().coefficients();
    [
        tracking.delay_s,
        tracking.amplitude,
        tracking.relative_error,
        tracking.error_m,
        energy.added_j(),
        energy.added_share(),
        a0,
        a1,
        a2,
        a3,
    ]
}

/// Desired displacement (m): arcs of a parabola to alternate sides.
fn desired_m(tick: usize) -> f64 {
    let part = (tick % 200) as f64 / 200.0;
    let arc = 0.03 * part * (1.0 - part);
    let displacement_m = if (tick / 200).is_multiple_of(2) {
        arc
    } else {
        -arc
    };
    match (tick / SPAN, tick % SPAN) {
        (8, FAULT_AT..) => 0.06,
        (9, FAULT_AT) => f64::NAN,
        (10, FAULT_AT..) => 6.0 * displacement_m,
        (15, FAULT_AT) => 1e30,
        _ => displacement_m,
    }
}

/// Measured displacement (m) and force (N).
fn measured(tick: usize, [displacement_m, force_n]: [f64; 2], noise: f64) -> Option<[f64; 2]> {
    if tick % SPAN < FAULT_AT {
        return Some([displacement_m, force_n]);
    }
    match tick / SPAN {
        1 => None,
        2 => Some([f64::NAN, force_n]),
        3 => Some([displacement_m, f64::INFINITY]),
        4 => Some([displacement_m, -force_n]),
        5 => Some([0.0, force_n]),
        6 => Some([-displacement_m, force_n]),
        7 => Some([displacement_m, 25e3]),
        11 => Some([1.3 * displacement_m, force_n]),
        // Single ticks that are missing, jump, or are too large.
        13 if noise > 0.3 => None,
        13 if noise < -0.3 => Some([displacement_m + 0.01, force_n]),
        14 if noise > 0.4 => Some([1e30, -1e30]),
        16 => Some([displacement_m, 10.0 * noise]),
        _ => Some([displacement_m, force_n]),
    }
}

/// Digest of all that comes out.
pub fn digest(rows: &[Row]) -> Digest {
    let mut digest = Digest::default();
    for row in rows {
        let numbers = row.motion.iter().chain(&row.command);
        for number in numbers.chain(row.reading.iter().flatten()) {
            // All NaNs are equal: their bits differ from one processor to another.
            let bits = if number.is_nan() {
                u32::MAX
            } else {
                number.to_bits()
            };
            digest.add(bits.to_le_bytes());
        }
        digest.add(row.status.to_le_bytes());
    }
    digest
}
