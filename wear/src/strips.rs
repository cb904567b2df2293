//! Distribution of the friction work across a patch.

use crate::patch::WearingPatch;

/// Number of strips of equal width into which a patch is divided across.
pub const STRIPS: usize = 16;

/// A strip of a patch in the rolling direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Strip {
    /// Maximum pressure, Pa.
    pub pressure_pa: f64,
    /// Root mean square of the rigid slip divided by the speed.
    pub slip: f64,
    /// Share of the patch's wear number, N.
    pub work_n: f64,
}

/// Part of the load, and mean pressure over the maximum, of each strip of a half-ellipsoid.
const SHAPE: [[f64; 2]; STRIPS] = {
    let mut shape = [[0.0; 2]; STRIPS];
    let mut k = 0;
    while k < STRIPS {
        let middle = -1.0 + (2 * k + 1) as f64 / STRIPS as f64;
        let half = 1.0 / STRIPS as f64;
        // The load per width is a parabola; its integral over the strip is exact.
        let square = 1.0 - middle * middle;
        shape[k] = [0.75 * 2.0 * half * (square - half * half / 3.0), square];
        k += 1;
    }
    shape
};

/// Divides a wearing patch into strips, from the flange to the field side.
///
/// The pressure is a half-ellipsoid. The friction work of a strip is in proportion to its load times its rigid slip
/// `hypot(xi - phi y, eta + phi x)`, the root mean square over the strip; all strips together have that of the patch.
#[inline]
pub(crate) fn strips(patch: &WearingPatch) -> [Strip; STRIPS] {
    let [a, b] = patch.semi_axes_m;
    let creepage = patch.creepage.bounded();
    let (xi, eta, phi) = (creepage.longitudinal, creepage.lateral, creepage.spin_per_m);
    let mut total = 0.0;
    let mut strips = [Strip {
        pressure_pa: 0.0,
        slip: 0.0,
        work_n: 0.0,
    }; STRIPS];
    for (k, strip) in strips.iter_mut().enumerate() {
        let [load, square] = SHAPE[k];
        let y = b * (-1.0 + (2 * k + 1) as f64 / STRIPS as f64);
        let along = xi - phi * y;
        // The mean of x^2 over a half-ellipse of pressure is a quarter of its squared half-length.
        let across = eta * eta + 0.25 * phi * phi * a * a * square;
        strip.slip = (along * along + across).sqrt();
        strip.pressure_pa = patch.peak_pressure_pa * square.sqrt();
        strip.work_n = load * strip.slip;
        total += strip.work_n;
    }
    // Without slip the strips share by load, so that none of the work is lost.
    for (strip, [load, _]) in strips.iter_mut().zip(SHAPE) {
        let part = if total > 0.0 {
            strip.work_n / total
        } else {
            load
        };
        strip.work_n = part * patch.wear_number_n;
    }
    strips
}
