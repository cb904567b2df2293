//! A hybrid test with a simple actuator, the same on every processor: a run-in, a good test, faults of each kind, and
//! starts after them.

use dashpot_core::BuildError;
use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, Command, EnergySettings, GuardSettings, HybridStatus,
    Measured, Motion, TransferSettings, TransferSystem,
};

use crate::digest::Digest;

/// The transfer system of the experiment.
pub type System = TransferSystem<AdaptiveTimeSeries>;

/// Ticks of the experiment.
pub const TICKS: u32 = 20_000;

const STEP_S: f32 = 1e-3;
/// Ticks from one fault to the next.
const FAULTS: u32 = 2000;
/// Frequency of the desired motion (rad/s) and its amplitude (m).
const OMEGA: f32 = 16.0;
const AMPLITUDE_M: f32 = 0.008;
/// Share of the way to the command that the actuator goes in a tick, and the damper's coefficient (N s/m).
const FOLLOWING: f32 = 0.1;
const DAMPING_N_S_PER_M: f32 = 60e3;

/// The system of the experiment: the nominal inverse knows two thirds of the actuator's delay.
///
/// # Errors
/// None, as long as the settings are allowed.
pub fn system() -> Result<System, BuildError> {
    let compensator = AdaptiveTimeSeries::new(
        &AdaptiveSettings::new([1.0, 0.006, 0.0, 0.0], 0.006),
        STEP_S,
    )?;
    let settings = TransferSettings {
        guard: GuardSettings::new(0.05, 0.5, 20e3),
        energy: EnergySettings {
            window_s: 0.3,
            ..EnergySettings::default()
        },
        tracking_window_s: 1.0,
        tracking_error: 100.0, // the sign shall be found first
    };
    TransferSystem::new(compensator, &settings, STEP_S)
}

/// Changes what is measured at the end of each span of [`FAULTS`] ticks, in turn.
fn with_fault(tick: u32, measured: Measured) -> Option<Measured> {
    if tick % FAULTS < FAULTS / 2 {
        return Some(measured);
    }
    match tick / FAULTS {
        1 => None,
        2 => Some(Measured {
            displacement_m: f32::NAN,
            ..measured
        }),
        3 => Some(Measured {
            force_n: 1e30,
            ..measured
        }),
        4 => Some(Measured {
            force_n: -measured.force_n,
            ..measured
        }),
        5 => Some(Measured {
            displacement_m: 0.0,
            ..measured
        }),
        6 => Some(Measured {
            displacement_m: -measured.displacement_m,
            ..measured
        }),
        _ => Some(measured),
    }
}

/// Digest of the bits of all commands, forces and readings; `tick` computes each tick. Also returns everything that was
/// noticed.
pub fn run(
    system: &mut System,
    mut tick: impl FnMut(&mut System, &Motion, &Option<Measured>) -> Command,
) -> (Digest, HybridStatus) {
    let mut digest = Digest::default();
    let mut noticed = HybridStatus::empty();
    // A point on a circle, turned and brought back to the circle each tick: sine and cosine without a library.
    let (mut sine, mut cosine) = (0.0_f32, 1.0_f32);
    let (mut reached_m, mut velocity_m_per_s) = (0.0_f32, 0.0_f32);
    let (turn, mut random) = (OMEGA * STEP_S, 1_u32);
    for number in 0..TICKS {
        let desired = Motion {
            displacement_m: AMPLITUDE_M * sine,
            velocity_m_per_s: AMPLITUDE_M * OMEGA * cosine,
            acceleration_m_per_s2: -AMPLITUDE_M * OMEGA * OMEGA * sine,
            jerk_m_per_s3: -AMPLITUDE_M * OMEGA * OMEGA * OMEGA * cosine,
        };
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = (random >> 8) as f32 / 16_777_216.0 - 0.5;
        let measured = Measured {
            displacement_m: reached_m + 2e-6 * noise,
            force_n: DAMPING_N_S_PER_M * velocity_m_per_s + 20.0 * noise,
        };
        let command = tick(system, &desired, &with_fault(number, measured));
        let change_m = FOLLOWING * (command.command_m - reached_m);
        reached_m += change_m;
        velocity_m_per_s = change_m / STEP_S;
        noticed |= command.status;
        digest.add(command.command_m.to_bits().to_le_bytes());
        digest.add(command.force_n.to_bits().to_le_bytes());
        digest.add(command.status.bits().to_le_bytes());
        if number % FAULTS == FAULTS - 1 {
            let reading = system.tracking();
            for value in [reading.delay_s, reading.amplitude, reading.relative_error] {
                digest.add(value.to_bits().to_le_bytes());
            }
            system.guard().clear();
        }
        let norm = 1.5 - 0.5 * (sine * sine + cosine * cosine);
        (sine, cosine) = ((sine + turn * cosine) * norm, (cosine - turn * sine) * norm);
    }
    (digest, noticed)
}
