//! Expected result of `prefix_digest` in `digest.c`, computed with the core.

use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, EnergySettings, GuardAction, GuardSettings, HybridStatus,
    InverseModel, Measured, MotionFilter, TransferSettings, TransferSystem,
};

/// Ticks of the test.
const TICKS: u16 = 2048;

/// The test's system and its motion filter; `None` if a setting were not allowed.
fn system() -> Option<(TransferSystem<AdaptiveTimeSeries>, MotionFilter)> {
    let step_s = 1.0 / 1024.0;
    let nominal = InverseModel::of_delay(1.0 / 128.0).ok()?.coefficients();
    let adaptive = AdaptiveSettings::new(nominal, 1.0 / 256.0);
    let settings = TransferSettings {
        guard: GuardSettings {
            action: GuardAction::ZeroForce,
            approach_m_per_s: 0.25,
            ramp_s: 0.0625,
            ..GuardSettings::new(0.05, 0.5, 20e3)
        },
        energy: EnergySettings {
            window_s: 0.25,
            ..EnergySettings::default()
        },
        tracking_window_s: 1.0,
        tracking_error: 0.3,
    };
    let compensator = AdaptiveTimeSeries::new(&adaptive, step_s).ok()?;
    let system = TransferSystem::new(compensator, &settings, step_s).ok()?;
    Some((system, MotionFilter::new(40.0, step_s).ok()?))
}

/// Hash (FNV-1a, 32 bit) of the results of a test in which an actuator follows arcs of a parabola too late. At the end
/// of each 512 ticks there is a fault: no measurement, NaN, a wrong sign, and an end that the program requests.
pub(super) fn digest() -> u32 {
    let mut hash = 0x811c_9dc5_u32;
    let mut add = |bits: u32| {
        for byte in bits.to_le_bytes() {
            hash = (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    };
    let Some((mut system, mut filter)) = system() else {
        return 0;
    };
    let (mut reached_m, mut change_m, mut random) = (0.0_f32, 0.0_f32, 1_u32);
    for tick in 0..TICKS {
        let part = f32::from(tick % 128) / 128.0;
        let arc = 1.0 / 64.0 * part * (1.0 - part);
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = (random >> 8) as f32 / 16_777_216.0 - 0.5;
        let fault = (tick % 512 >= 384).then_some(tick / 512);
        let desired = filter.push(if (tick / 128).is_multiple_of(2) {
            arc
        } else {
            -arc
        });
        let force_n = 16_777_216.0 * change_m + 16.0 * noise;
        let measured = Measured {
            displacement_m: match fault {
                Some(1) => f32::NAN,
                _ => reached_m + noise / 524_288.0,
            },
            force_n: if fault == Some(2) { -force_n } else { force_n },
        };
        if tick == 3 * 512 + 384 {
            system.guard().end(HybridStatus::REQUESTED);
        }
        let command = system.tick(&desired, (fault != Some(0)).then_some(measured));
        change_m = 0.125 * (command.command_m - reached_m);
        reached_m += change_m;
        add(command.command_m.to_bits());
        add(command.force_n.to_bits());
        add(u32::from(command.status.bits()));
        if tick % 512 == 383 {
            let reading = system.tracking();
            add(reading.delay_s.to_bits());
            add(reading.amplitude.to_bits());
            add(reading.relative_error.to_bits());
            add(system.energy().added_share().to_bits());
            for coefficient in system.compensator().coefficients() {
                add(coefficient.to_bits());
            }
        }
        if tick % 512 == 511 {
            system.guard().clear();
        }
    }
    hash
}
