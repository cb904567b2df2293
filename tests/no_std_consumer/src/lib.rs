//! Every call firmware makes in a tick, without `std`, heap and builder.
#![no_std]

use dashpot_core::integrity::Check;
use dashpot_core::telemetry::{Sample, Telemetry};
use dashpot_core::{Damper, DamperState, Loading, step_bank};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// A step in single precision.
#[unsafe(no_mangle)]
pub extern "C" fn checked_step_f32(
    damper: &Damper<f32>,
    state: &mut DamperState<f32>,
    x: f32,
) -> f32 {
    damper.step(state, x)
}

/// A step in double precision.
#[unsafe(no_mangle)]
pub extern "C" fn checked_step_f64(
    damper: &Damper<f64>,
    state: &mut DamperState<f64>,
    x: f64,
) -> f64 {
    damper.step(state, x)
}

/// A bank that fills its lanes and has some dampers left over.
#[unsafe(no_mangle)]
pub extern "C" fn checked_bank(
    damper: &Damper<f32>,
    states: &mut [DamperState<f32>; 19],
    x: &[f32; 19],
    forces: &mut [f32; 19],
) {
    step_bank(&[damper; 19], states, x, forces);
}

/// The live changes of firmware.
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

/// A damper received over a link; returns whether it was accepted.
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

/// A slice of a load and of the check, as small as a tick permits; returns whether both succeed.
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

/// The telemetry ring, written and read.
#[unsafe(no_mangle)]
pub extern "C" fn checked_telemetry(
    telemetry: &mut Telemetry<64>,
    state: &DamperState<f32>,
    tick: u32,
) -> f32 {
    telemetry.record(Sample {
        tick,
        displacement_m: state.displacement_m(),
        force_n: state.force_n(),
        status: state.status(),
    });
    let oldest = telemetry.take().unwrap_or_default();
    oldest.force_n + telemetry.approximate_rms_force_n()
}

/// The control: panics if `index` is out of range, which shows that the check finds panics.
#[unsafe(no_mangle)]
pub extern "C" fn control_panics(values: &[f32; 4], index: usize) -> f32 {
    values[index]
}
