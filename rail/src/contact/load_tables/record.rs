//! One patch at one node and load, packed into sixteen bytes.

use crate::contact::elastic::ElasticPatch;

/// Numbers of a record.
pub(super) const FIELDS: usize = 8;
/// Part of the load below which a patch is left out, and above which it is kept whole.
const LEFT_OUT: [f64; 2] = [1e-3, 3e-3];

/// Largest value of each field, and what is added to make it positive: part of the load; then, each times this part:
/// sine of the contact angle, position and depth on the wheel (m), semi-axes (m) divided by `N^(1/3)`, part of the load
/// that the whole patch carries, and peak pressure (Pa) divided by `N^(1/3)`.
const LARGEST: [f64; FIELDS] = [1.0, 2.0, 0.3, 0.2, 1e-3, 1e-3, 1.0, 2e8];
const ADDED: [f64; FIELDS] = [0.0, 1.0, 0.15, 0.1, 0.0, 0.0, 0.0, 0.0];

/// A packed record. All fields are amounts that belong to the load: where a node has no such patch, they are zero, and
/// between nodes they add up.
pub(super) type Record = [u16; FIELDS];

/// Packs `patch` of a wheel that carries `load_n`.
pub(super) fn pack(patch: &ElasticPatch, load_n: f64) -> Record {
    let part = patch.load_n / load_n;
    let step = ((part - LEFT_OUT[0]) / (LEFT_OUT[1] - LEFT_OUT[0])).clamp(0.0, 1.0);
    let share = part * step * step * (3.0 - 2.0 * step);
    let per_root = load_n.cbrt().recip();
    let [a, b] = patch.semi_axes_m;
    let values = [
        1.0,
        patch.slope / patch.slope.hypot(1.0),
        patch.wheel_y_m,
        patch.wheel_z_m,
        a * per_root,
        b * per_root,
        patch.whole_load_n / load_n,
        patch.peak_pressure_pa * per_root,
    ];
    std::array::from_fn(|k| {
        let scaled = share * (values[k] + ADDED[k]) / LARGEST[k];
        (scaled * f64::from(u16::MAX)).round() as u16
    })
}

/// A patch that was read: the sums of the fields of weighted records.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LoadedPatch {
    /// Part of the wheel's normal load.
    pub share: f64,
    /// Sine of the contact angle.
    pub sine: f64,
    /// Position on the wheel, m from the tread datum.
    pub wheel_y_m: f64,
    /// Depth on the wheel, m; the rolling radius is the wheel radius plus this depth.
    pub wheel_z_m: f64,
    /// Semi-axes in the rolling direction and across, m, divided by the cube root of the wheel's normal load, N.
    pub semi_axes_per_root: [f64; 2],
    /// Part of the wheel's normal load that the whole patch carries.
    pub whole: f64,
    /// Peak pressure, Pa, divided by the cube root of the wheel's normal load, N.
    pub pressure_per_root: f64,
}

/// Unpacks the weighted sum of records; `None` if no record has a part of the load.
pub(super) fn unpack(sums: &[f64; FIELDS]) -> Option<LoadedPatch> {
    let unit = 1.0 / f64::from(u16::MAX);
    let share = sums[0] * unit;
    if share <= 0.0 {
        return None;
    }
    let value = |k: usize| sums[k] * unit * LARGEST[k] / share - ADDED[k];
    Some(LoadedPatch {
        share,
        sine: value(1),
        wheel_y_m: value(2),
        wheel_z_m: value(3),
        semi_axes_per_root: [value(4), value(5)],
        whole: value(6),
        pressure_per_root: value(7),
    })
}
