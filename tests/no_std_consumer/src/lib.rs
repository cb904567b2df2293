//! All calls that a firmware makes in a tick, without `std`, heap and builder.
#![no_std]

use dashpot_core::hybrid::{
    AdaptiveTimeSeries, Command, InverseModel, Measured, Motion, PolynomialExtrapolation,
    TransferSystem,
};
use dashpot_core::integrity::Check;
use dashpot_core::telemetry::{Sample, Telemetry};
use dashpot_core::{Damper, DamperState, Loading, step_bank};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Steps in single precision.
#[unsafe(no_mangle)]
pub extern "C" fn checked_step_f32(
    damper: &Damper<f32>,
    state: &mut DamperState<f32>,
    x: f32,
) -> f32 {
    damper.step(state, x)
}

/// Steps in double precision.
#[unsafe(no_mangle)]
pub extern "C" fn checked_step_f64(
    damper: &Damper<f64>,
    state: &mut DamperState<f64>,
    x: f64,
) -> f64 {
    damper.step(state, x)
}

/// Steps a bank whose dampers fill one group and part of another.
#[unsafe(no_mangle)]
pub extern "C" fn checked_bank(
    damper: &Damper<f32>,
    states: &mut [DamperState<f32>; 19],
    x: &[f32; 19],
    forces: &mut [f32; 19],
) {
    step_bank(&[damper; 19], states, x, forces);
}

/// Changes a damper while it runs.
#[unsafe(no_mangle)]
pub extern "C" fn checked_change(
    damper: &mut Damper<f32>,
    state: &mut DamperState<f32>,
    clearance_m: f32,
) -> bool {
    let set = damper.set_clearance_m(clearance_m);
    damper.adopt(state);
    state.clear_status();
    set.is_ok()
}

/// A tick of a hybrid test with each compensator.
#[unsafe(no_mangle)]
pub extern "C" fn checked_transfer(
    adaptive: &mut TransferSystem<AdaptiveTimeSeries>,
    polynomial: &mut TransferSystem<PolynomialExtrapolation>,
    inverse: &mut TransferSystem<InverseModel>,
    desired: &Motion,
    measured: Option<&Measured>,
    commands: &mut [Command; 3],
) -> f32 {
    let measured = measured.copied();
    *commands = [
        adaptive.tick(desired, measured),
        polynomial.tick(desired, measured),
        inverse.tick(desired, measured),
    ];
    adaptive.guard().clear();
    adaptive.tracking().delay_s + adaptive.energy().added_share()
}

/// Loads a damper from a link. True if it was accepted.
#[unsafe(no_mangle)]
pub extern "C" fn checked_image(
    damper: &mut Damper<f32>,
    image: &[u8; 8192],
    length: usize,
) -> bool {
    image
        .get(..length)
        .is_some_and(|image| damper.load_image(image).is_ok())
}

/// Runs a slice of a load and of the check, as in a tick. True if both succeed.
#[unsafe(no_mangle)]
pub extern "C" fn checked_slices(
    damper: &mut Damper<f32>,
    image: &[u8; 8192],
    length: usize,
    loading: &mut Loading,
    check: &mut Check,
) -> bool {
    let image = image.get(..length).unwrap_or_default();
    let loaded = damper.load_slice(image, loading).is_ok();
    loaded && check.slice(damper).is_ok() && Check::state(damper, &damper.at_rest(0.0)).is_ok()
}

/// Writes and reads the telemetry ring.
#[unsafe(no_mangle)]
pub extern "C" fn checked_telemetry(
    telemetry: &mut Telemetry<64>,
    state: &DamperState<f32>,
    tick: u32,
) -> f32 {
    telemetry.record(Sample::new(
        tick,
        state.displacement_m(),
        state.force_n(),
        state.status(),
    ));
    let oldest = telemetry.take().unwrap_or_default();
    oldest.force_n + telemetry.approximate_rms_force_n()
}

/// Panics if `index` is out of range, to show that the check finds panics.
#[unsafe(no_mangle)]
pub extern "C" fn control_panics(values: &[f32; 4], index: usize) -> f32 {
    values[index]
}
