//! The numbers of a patch from its record.

use super::record::{FIELDS, UNITS};
use crate::contact::patch_numbers::PatchNumbers;
use crate::math::number::Number;

/// Added to the share of a patch, so that a patch without load has no numbers like 0/0. Its reciprocal squared is a
/// number of single precision, as derivatives are.
const TINY: f64 = 1e-12;
/// Added to semi-axes, so that a patch without load has a shape, m.
const TINY_SEMI_AXIS_M: f64 = 1e-8;

/// The numbers of a patch from its record.
#[inline(always)]
pub(super) fn unpacked<T: Number>(record: [T; FIELDS], load: T, root: T) -> PatchNumbers<T> {
    let [share, sine, wheel_y, wheel_z, a, b, whole, pressure] = record;
    let per = (share + TINY).reciprocal();
    let [
        unit,
        sine_unit,
        y_unit,
        z_unit,
        a_unit,
        b_unit,
        whole_unit,
        pressure_unit,
    ] = UNITS;
    let per_root = per * root;
    PatchNumbers {
        load: share * unit * load,
        whole_load: whole * per * (whole_unit / unit) * load,
        sine: sine * per * (sine_unit / unit),
        wheel_y: wheel_y * per * (y_unit / unit),
        wheel_z: wheel_z * per * (z_unit / unit),
        semi_axes: [
            a * per_root * (a_unit / unit) + TINY_SEMI_AXIS_M,
            b * per_root * (b_unit / unit) + TINY_SEMI_AXIS_M,
        ],
        peak_pressure: pressure * per_root * (pressure_unit / unit),
    }
}
