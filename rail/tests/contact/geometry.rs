//! Contact geometry against a dense evaluation that shares no code with them.

use dashpot_rail::contact::geometry::SOFTNESS;
use dashpot_rail::contact::pair::{Installation, Pair, Place};

use dashpot_rail::profile::{s1002, uic60};
use std::sync::OnceLock;

/// The laid rail 60E1 from its arcs alone: depth at a lateral place by bisection, m.
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
        // The centre of R 300 moves up by its cosine; the crown lies 300 mm above it.
        rail.crown = 300e-3 * Self::TILT.atan().cos() - 300e-3;
        // The gauge face 14 mm below the crown lies at half the gauge.
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

    /// Place at `arc` m from the top, negative to the gauge side, tilted, m.
    fn place(&self, arc: f64) -> [f64; 2] {
        let [y, z] = uic60::place_mm(arc.abs() * 1e3).map(|x| x * 1e-3);
        let y = y * arc.signum();
        let (sin, cos) = Self::TILT.atan().sin_cos();
        [
            y * cos + z * sin + self.shift,
            z * cos - y * sin - self.crown,
        ]
    }

    fn depth(&self, y: f64) -> Option<f64> {
        let (mut low, mut high) = (-70e-3, 70e-3);
        if y < self.place(low)[0] || y > self.place(high)[0] {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.place(middle)[0] < y {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(self.place(low)[1])
    }
}

/// How far the wheel, a body of revolution turned in space, reaches below the rail, and where on the profile.
///
/// Circles of the profile, each turned point by point; the search closes in on the best.
fn dense(rail: &DenseRail, place: &Place) -> (f64, f64) {
    let radius = 0.625;
    let (sin_yaw, cos_yaw) = place.yaw.sin_cos();
    let (sin_roll, cos_roll) = place.roll.sin_cos();
    let reach = |s: f64, turn: f64| -> f64 {
        let r = radius + s1002::depth_mm(s * 1e3) * 1e-3;
        // Wheel axes about the datum: x forward, y out, z down.
        let [x, y, z] = [r * f64::sin(turn), s, r * f64::cos(turn) - radius];
        let across = x * sin_yaw + y * cos_yaw;
        let lateral = 0.750 + place.lateral + across * cos_roll - z * sin_roll;
        let depth = across * sin_roll + z * cos_roll;
        rail.depth(lateral).map_or(-1.0, |rail| depth - rail)
    };
    let mut best = (-1.0, 0.0, 0.0);
    for i in -1390..1200 {
        let s = f64::from(i) * 50e-6;
        let turns = if place.yaw == 0.0 { 0 } else { 40 };
        for j in -turns..=turns {
            let turn = f64::from(j) * 4e-3;
            let value = reach(s, turn);
            if value > best.0 {
                best = (value, s, turn);
            }
        }
    }
    let (mut ds, mut dt) = (50e-6, if place.yaw == 0.0 { 0.0 } else { 4e-3 });
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

/// Places on tread, root, flange face and tip, with the dense search's height and place on the wheel.
fn searched() -> &'static [(Place, f64, f64)] {
    static SEARCHED: OnceLock<Vec<(Place, f64, f64)>> = OnceLock::new();
    SEARCHED.get_or_init(|| {
        let rail = DenseRail::new();
        let mut found = Vec::new();
        for lateral in [
            -8e-3, -0.4e-3, 0.8e-3, 4.4e-3, 5.6e-3, 6.3e-3, 7.1e-3, 9e-3, 40e-3,
        ] {
            for (roll, yaw) in [(0.0, 0.0), (5e-3, 0.0), (-1e-3, -0.03)] {
                let place = Place { lateral, roll, yaw };
                let (rise, s) = dense(&rail, &place);
                found.push((place, rise, s));
            }
        }
        found
    })
}

#[test]
fn the_rigid_search_finds_what_a_dense_one_finds() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let mut room = Vec::new();
    let mut worst = 0.0_f64;
    for &(place, rise, s) in searched() {
        let found = pair.deepest(&place, &mut room);
        let off = (found.rise - rise).abs();
        worst = worst.max(off);
        // Across a steep face, heights answer a lateral error 2.7-fold.
        assert!(
            off < 0.3e-6,
            "{place:?}: {} for {rise}, s {} for {s}",
            found.rise,
            found.s
        );
        // The place of a flat summit is known as the root of its height.
        let width = (2.0 * 0.3e-6 / found.curvature.max(0.5)).sqrt() + 20e-6;
        assert!(
            (found.s - s).abs() < width,
            "{place:?}: s {} for {s}",
            found.s
        );
    }
    println!(
        "deepest place: within {:.3} um of the dense search",
        worst * 1e6
    );
}

#[test]
fn patches_lie_within_the_softness_of_the_dense_summit() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let mut room = Vec::new();
    let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
    for &(place, rise, _) in searched() {
        let patches = pair.patches(&place, SOFTNESS, &mut room);
        let off = patches.tread.rise.max(patches.flange.rise) - rise;
        worst = worst.max(off.abs());
        squares += off * off;
        count += 1.0;
        assert!(off.abs() < 0.6 * SOFTNESS, "{place:?}: {off}");
    }
    let rms = f64::sqrt(squares / count);
    println!(
        "soft summit: {:.2} um RMS, {:.2} um at most",
        rms * 1e6,
        worst * 1e6
    );
    assert!(rms < 0.25 * SOFTNESS);
}
