//! Contact geometry compared with a dense evaluation that shares no code with it.

use std::sync::OnceLock;

use dashpot_rail::contact::{Installation, Pair, WheelPose};
use dashpot_rail::profile::{s1002, uic60};

/// The laid rail 60E1, computed from its arcs alone: depth at a lateral position by bisection, m.
struct DenseRail {
    shift: f64,
    crown: f64,
}

impl DenseRail {
    const TILT: f64 = 1.0 / 40.0;

    fn new() -> Self {
        let mut rail = Self {
            shift: 0.0,
            crown: 0.0,
        };
        // The inclination moves the centre of R 300; the crown lies 300 mm above it.
        rail.crown = 300e-3 * Self::TILT.atan().cos() - 300e-3;
        // The gauge face, 14 mm below the crown, lies at half the gauge.
        let (mut low, mut high) = (-45e-3, -20e-3);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            match rail.depth(middle) {
                Some(depth) if depth < 14e-3 => high = middle,
                _ => low = middle,
            }
        }
        rail.shift = 0.5 * 1.435 - low;
        rail
    }

    /// Position on the inclined rail at the arc length `arc` from the top, negative towards the gauge side, m.
    fn position(&self, arc: f64) -> [f64; 2] {
        let [y, z] = uic60::position_mm(arc.abs() * 1e3).map(|x| x * 1e-3);
        let y = y * arc.signum();
        let (sin, cos) = Self::TILT.atan().sin_cos();
        [
            y * cos + z * sin + self.shift,
            z * cos - y * sin - self.crown,
        ]
    }

    fn depth(&self, y: f64) -> Option<f64> {
        let (mut low, mut high) = (-70e-3, 70e-3);
        if y < self.position(low)[0] || y > self.position(high)[0] {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.position(middle)[0] < y {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(self.position(low)[1])
    }
}

/// Maximum depth of the wheel, a rotated body of revolution, below the rail, and the position of that point on the
/// profile.
///
/// Rotates every point of the circles of the profile; the search is refined around the deepest point.
fn dense(rail: &DenseRail, pose: &WheelPose) -> (f64, f64) {
    let radius = 0.625;
    let (sin_yaw, cos_yaw) = pose.yaw_rad.sin_cos();
    let (sin_roll, cos_roll) = pose.roll_rad.sin_cos();
    let reach = |s: f64, turn: f64| -> f64 {
        let r = radius + s1002::depth_mm(s * 1e3) * 1e-3;
        // Wheel axes with the origin at the datum: x forward, y outwards, z down.
        let [x, y, z] = [r * f64::sin(turn), s, r * f64::cos(turn) - radius];
        let across = x * sin_yaw + y * cos_yaw;
        let lateral = 0.750 + pose.lateral_m + across * cos_roll - z * sin_roll;
        let depth = across * sin_roll + z * cos_roll;
        rail.depth(lateral).map_or(-1.0, |rail| depth - rail)
    };
    let mut best = (-1.0, 0.0, 0.0);
    for i in -1390..1200 {
        let s = f64::from(i) * 50e-6;
        let turns = if pose.yaw_rad == 0.0 { 0 } else { 40 };
        for j in -turns..=turns {
            let turn = f64::from(j) * 4e-3;
            let value = reach(s, turn);
            if value > best.0 {
                best = (value, s, turn);
            }
        }
    }
    let (mut ds, mut dt) = (50e-6, if pose.yaw_rad == 0.0 { 0.0 } else { 4e-3 });
    for _ in 0..14 {
        let (_, s0, t0) = best;
        for i in -4..=4 {
            for j in -4..=4 {
                let (s, turn) = (s0 + ds * f64::from(i) / 4.0, t0 + dt * f64::from(j) / 4.0);
                let value = reach(s, turn);
                if value > best.0 {
                    best = (value, s, turn);
                }
            }
        }
        ds *= 0.5;
        dt *= 0.5;
    }
    (best.0, best.1)
}

/// Poses with contact on tread, root, flange face and tip, with the depth and position found by the dense search.
fn searched() -> &'static [(WheelPose, f64, f64)] {
    static SEARCHED: OnceLock<Vec<(WheelPose, f64, f64)>> = OnceLock::new();
    SEARCHED.get_or_init(|| {
        let rail = DenseRail::new();
        let mut found = Vec::new();
        for lateral_m in [
            -8e-3, -0.4e-3, 0.8e-3, 4.4e-3, 5.6e-3, 6.3e-3, 7.1e-3, 9e-3, 40e-3,
        ] {
            for (roll_rad, yaw_rad) in [(0.0, 0.0), (5e-3, 0.0), (-1e-3, -0.03)] {
                let pose = WheelPose {
                    lateral_m,
                    roll_rad,
                    yaw_rad,
                };
                let (depth, s) = dense(&rail, &pose);
                found.push((pose, depth, s));
            }
        }
        found
    })
}

#[test]
fn the_rigid_search_agrees_with_the_dense_search() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let mut scratch = Vec::new();
    let mut worst = 0.0_f64;
    for &(pose, depth, s) in searched() {
        let found = pair.deepest(&pose, &mut scratch);
        let off = (found.interpenetration_m - depth).abs();
        worst = worst.max(off);
        // On a steep face, a lateral error changes the height by 2.7 times as much.
        assert!(
            off < 0.3e-6,
            "{pose:?}: {} for {depth}, s {} for {s}",
            found.interpenetration_m,
            found.wheel_y_m
        );
        // At a flat maximum, the error of the position grows with the square root of the error of the height.
        let width = (2.0 * 0.3e-6 / found.curvature_per_m.max(0.5)).sqrt() + 20e-6;
        assert!(
            (found.wheel_y_m - s).abs() < width,
            "{pose:?}: s {} for {s}",
            found.wheel_y_m
        );
    }
    println!(
        "deepest point: within {:.3} um of the dense search",
        worst * 1e6
    );
}
