//! Position on the rail's own profile of a point of the laid rail.

use dashpot_rail::contact::Pair;
use dashpot_rail::profile::Profile;

/// Converts track axes into those of the rail's profile, which is inclined and shifted where the rail lies.
pub(super) struct RailPosition<'a> {
    pair: &'a Pair,
    sin: f64,
    cos: f64,
    /// Lateral shift and depth of the laid rail's origin after the rotation, m.
    shift_m: f64,
    crown_m: f64,
}

impl<'a> RailPosition<'a> {
    pub fn new(pair: &'a Pair, rail: &Profile) -> Self {
        let (sin, cos) = libm::sincos(libm::atan(pair.installation().inclination));
        let turned = |point: &dashpot_rail::profile::ProfilePoint| {
            [
                point.y_m * cos + point.z_m * sin,
                point.z_m * cos - point.y_m * sin,
            ]
        };
        let points = rail.points().iter().map(turned);
        let top = points
            .min_by(|p, q| p[1].total_cmp(&q[1]))
            .unwrap_or_default();
        Self {
            pair,
            sin,
            cos,
            shift_m: pair.rail_top_m() - top[0],
            crown_m: top[1],
        }
    }

    /// Lateral position on the profile of the point of the rail's surface at `track_y_m` from the track centre, m.
    pub fn profile_y_m(&self, track_y_m: f64) -> f64 {
        let z_m = self.pair.rail().at(track_y_m).z_m + self.crown_m;
        (track_y_m - self.shift_m) * self.cos - z_m * self.sin
    }
}

#[cfg(test)]
mod tests {
    use dashpot_rail::contact::Installation;
    use dashpot_rail::profile::uic60;

    use super::*;

    #[test]
    fn the_surface_is_found_again() {
        let pair = Pair::standard(Installation::default()).unwrap();
        let rail = uic60::profile();
        let position = RailPosition::new(&pair, &rail);
        for laid in pair.rail().points().iter().step_by(50) {
            let y_m = position.profile_y_m(laid.y_m);
            let turn = pair.installation().inclination.atan();
            assert!((rail.at(y_m).angle_rad - turn - laid.angle_rad).abs() < 1e-3);
        }
    }
}
