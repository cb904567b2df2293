//! Lengths of a wheel over its rail.

use super::geometry::ContactGeometry;

/// Lengths of a wheel over its rail, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct WheelLengths<T> {
    /// Lateral distance of the tread datum from the wheelset's centre.
    pub offset: T,
    pub radius: T,
    /// Nominal radius minus the nominal height of the wheelset's centre above the top of the rails.
    pub below_top: T,
    /// Lateral distance of the datum of a centred wheel from the rail's top.
    pub beside_top: T,
}

impl WheelLengths<f64> {
    /// Returns these lengths for the wheels of `geometry` on a wheelset whose centre is `height_m` above the rails.
    pub fn new(geometry: &ContactGeometry, height_m: f64) -> Self {
        let pair = geometry.pair();
        let offset = pair.installation().datum_offset_m();
        let radius = pair.installation().wheel_radius_m;
        Self {
            offset,
            radius,
            below_top: radius - height_m,
            beside_top: offset - pair.rail_top_m(),
        }
    }
}

impl<T> WheelLengths<T> {
    /// Applies `function` to every length.
    #[inline(always)]
    pub fn map<U>(&self, function: impl Fn(&T) -> U) -> WheelLengths<U> {
        WheelLengths {
            offset: function(&self.offset),
            radius: function(&self.radius),
            below_top: function(&self.below_top),
            beside_top: function(&self.beside_top),
        }
    }

    /// Combines each length with that of another wheel.
    pub fn zip<U>(&self, other: &Self, function: impl Fn(&T, &T) -> U) -> WheelLengths<U> {
        WheelLengths {
            offset: function(&self.offset, &other.offset),
            radius: function(&self.radius, &other.radius),
            below_top: function(&self.below_top, &other.below_top),
            beside_top: function(&self.beside_top, &other.beside_top),
        }
    }
}
