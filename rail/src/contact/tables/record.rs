//! One patch at one node and load, packed into sixteen bytes.

use crate::contact::elastic::ElasticPatch;

/// Numbers of a record.
pub(super) const FIELDS: usize = 8;
/// Part of the load below which a patch is left out, and above which it is kept whole.
const LEFT_OUT: [f64; 2] = [1e-3, 3e-3];

/// Greatest magnitude of each field: part of the load; then, each times this part: sine of the contact angle, position
/// and depth on the wheel (m), semi-axes (m) divided by `N^(1/3)`, part of the load that the whole patch carries, and
/// peak pressure (Pa) divided by `N^(1/3)`.
const GREATEST: [f64; FIELDS] = [1.0, 1.0, 0.15, 0.1, 1e-3, 1e-3, 1.1, 2e8];

/// A packed record. All fields are amounts that belong to the load: where a node has no such patch, they are zero, and
/// between nodes they add up.
pub(super) type Record = [i16; FIELDS];

/// Value of one unit of each field of a record.
pub(super) const UNITS: [f64; FIELDS] = {
    let mut units = GREATEST;
    let mut k = 0;
    while k < FIELDS {
        units[k] /= i16::MAX as f64;
        k += 1;
    }
    units
};

/// Packs `patch` of a wheel that carries `load_n`.
pub(super) fn pack(patch: &ElasticPatch, load_n: f64) -> Record {
    let part = patch.load_n / load_n;
    let step = ((part - LEFT_OUT[0]) / (LEFT_OUT[1] - LEFT_OUT[0])).clamp(0.0, 1.0);
    let share = part * step * step * (3.0 - 2.0 * step);
    let per_root = libm::cbrt(load_n).recip();
    let [a, b] = patch.semi_axes_m;
    let values = [
        1.0,
        patch.slope / libm::hypot(patch.slope, 1.0),
        patch.wheel_y_m,
        patch.wheel_z_m,
        a * per_root,
        b * per_root,
        patch.whole_load_n / load_n,
        patch.peak_pressure_pa * per_root,
    ];
    // The conversion limits a value beyond the range.
    std::array::from_fn(|k| (share * values[k] / UNITS[k]).round() as i16)
}
