//! A body that yaws on springs and dry friction, against the exact motion between sticking and sliding.

use dashpot_rail::vehicle::{Direction, Element, End, Law};
use dashpot_reference::vehicle::VehicleReference;

use crate::common::{
    CURVE_M, RADIUS, SPRINGS, X, abrupt_curve, contact, on_track, springs_on_track, times,
};

const SPEED: f64 = 20.0;
/// Stiffness of the springs of two friction elements at (0, +-1), at the height of the centre of gravity.
const SERIES: f64 = 20e6;
const YAW_INERTIA: f64 = 900e3;

/// Motion of `m x'' + k x + f = 0`, where `f` is the force of the spring `ks` with a slider, in one phase: sticking at
/// `slider`, or sliding with the sign of the force. It is a cosine about a centre.
#[derive(Clone, Copy)]
struct Phase {
    start: f64,
    /// Displacement and velocity at its start.
    at: [f64; 2],
    sliding: f64,
    slider: f64,
}

struct Oscillator {
    stiffness: f64,
    series: f64,
    limit: f64,
}

impl Oscillator {
    fn motion(&self, phase: &Phase, time: f64) -> [f64; 2] {
        let (stiffness, force) = if phase.sliding == 0.0 {
            (self.stiffness + self.series, -self.series * phase.slider)
        } else {
            (self.stiffness, phase.sliding * self.limit)
        };
        let rate = (stiffness / YAW_INERTIA).sqrt();
        let (sin, cos) = (rate * (time - phase.start)).sin_cos();
        let centre = -force / stiffness;
        let [x, v] = phase.at;
        [
            centre + (x - centre) * cos + v / rate * sin,
            -(x - centre) * rate * sin + v * cos,
        ]
    }

    fn force(&self, phase: &Phase, time: f64) -> f64 {
        if phase.sliding == 0.0 {
            self.series * (self.motion(phase, time)[0] - phase.slider)
        } else {
            phase.sliding * self.limit
        }
    }

    /// Positive until the phase ends.
    fn margin(&self, phase: &Phase, time: f64) -> f64 {
        if phase.sliding == 0.0 {
            self.limit - self.force(phase, time).abs()
        } else {
            phase.sliding * self.motion(phase, time)[1]
        }
    }

    /// The phase after `phase`, if it starts before `end`.
    fn next(&self, phase: &Phase, end: f64) -> Option<Phase> {
        let step = 1e-4;
        let mut before = phase.start + 1e-9;
        while self.margin(phase, before + step) > 0.0 {
            before += step;
            if before > end {
                return None;
            }
        }
        let mut after = before + step;
        for _ in 0..100 {
            let middle = 0.5 * (before + after);
            if self.margin(phase, middle) > 0.0 {
                before = middle;
            } else {
                after = middle;
            }
        }
        let at = self.motion(phase, after);
        let (sliding, slider) = if phase.sliding == 0.0 {
            (self.force(phase, after).signum(), phase.slider)
        } else {
            (0.0, at[0] - phase.sliding * self.limit / self.series)
        };
        Some(Phase {
            start: after,
            at,
            sliding,
            slider,
        })
    }
}

/// An abrupt curve turns the frame at `V/R`, so the body starts to yaw at `-V/R` and then oscillates freely. It stops
/// after some half cycles and then oscillates on the stuck springs.
#[test]
fn a_body_with_friction_yaws_until_it_sticks() {
    let friction_n = 8e3;
    let mut elements = springs_on_track();
    for y in [1.0, -1.0] {
        let at = [0.0, y, 1.5];
        let law = Law::Friction {
            direction: Direction::Longitudinal,
            stiffness_n_per_m: SERIES,
            friction_n,
            load: None,
        };
        let ends = [End::track(at), End::body("body", at)];
        elements.push(Element::new(format!("friction {y}"), ends, law));
    }
    let vehicle = on_track(elements);
    let (contact, track) = (contact(0.4), abrupt_curve());
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, SPEED, 0.0).unwrap();
    let times = times(0.013, 250);
    let samples = reference.run(&times, 1e-10).unwrap();

    let oscillator = Oscillator {
        stiffness: 4.0 * (SPRINGS[0] + SPRINGS[1] * X * X),
        series: 2.0 * SERIES,
        limit: 2.0 * friction_n,
    };
    let start_s = CURVE_M / SPEED;
    let mut phases = vec![Phase {
        start: start_s,
        at: [0.0, -SPEED / RADIUS],
        sliding: 0.0,
        slider: 0.0,
    }];
    while let Some(next) = oscillator.next(&phases[phases.len() - 1], times[times.len() - 1]) {
        phases.push(next);
    }
    assert!(phases.len() > 9, "{}", phases.len());
    assert_eq!(phases[phases.len() - 1].sliding, 0.0);
    // Each of the two elements changes its range.
    assert_eq!(reference.statistics().events, 2 * (phases.len() - 1));
    let mut slid = 0;
    for sample in &samples {
        let time = sample.time_s;
        let Some(phase) = phases.iter().rfind(|phase| phase.start <= time) else {
            assert_eq!(sample.friction_forces_n, [0.0; 2]);
            continue;
        };
        let yaw = oscillator.motion(phase, time)[0];
        let found = sample.coordinates[0][4];
        assert!((found - yaw).abs() < 1e-9, "{time}: {found} for {yaw}");
        // The displacement at y = 1 is minus the yaw.
        let expected = -0.5 * oscillator.force(phase, time);
        let [right, left] = sample.friction_forces_n[..] else {
            panic!("two friction elements");
        };
        assert!((right - expected).abs() < 0.1, "{right} for {expected}");
        assert!((right + left).abs() < 1e-6, "{right} {left}");
        if phase.sliding != 0.0 {
            slid += 1;
            assert_eq!(right.abs(), friction_n);
        }
    }
    assert!(slid > 50, "{slid}");
}
