//! Frames that follow the track at each body of a vehicle, and the effects of their motion.

use dashpot_rail::track::{Alignment, Defect, Layout, Track};
use dashpot_rail::vehicle::GRAVITY_M_PER_S2;

use super::attachment::Coordinates;

/// Distance between the centres of the rails, over which the cant is measured (m).
const RAILS_APART_M: f64 = 1.5;

/// Abscissae from -1 to 1 and weights of Gaussian quadrature, exact for the cubic integrals over a transition.
const GAUSS: [[f64; 2]; 2] = [
    [-0.577_350_269_189_625_8, 1.0],
    [0.577_350_269_189_625_8, 1.0],
];

/// A point that runs along the track: the middle of the vehicle, or a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Runner {
    /// Distance ahead of the middle (m).
    pub(super) x: f64,
    /// Height above the top of the rails (m).
    pub(super) height: f64,
}

/// Part of the track under a runner, extrapolated beyond its ends so that the solver's trial stages are smooth.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    alignment: Alignment,
}

/// Cant angle, its rate, and curvature at a runner.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    angle: f64,
    angle_rate: f64,
    curvature: f64,
}

/// Effects of the track's course on a body.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Following {
    /// Displacement of the body's own frame from the frame of the middle: `c` in `Q = q + c`.
    pub(super) offset: Coordinates,
    /// `dc/dt - e`: rate of `Q` minus the absolute velocity.
    pub(super) offset_rate: Coordinates,
    /// Absolute velocity of the body's own frame: `e` in `dq/dt = v - e`.
    pub(super) frame_velocity: Coordinates,
    /// Lateral and vertical acceleration due to gravity and centrifugal force (m/s^2), minus the acceleration on
    /// straight track.
    pub(super) acceleration: [f64; 2],
}

/// A run along a track at constant speed.
#[derive(Clone, Debug)]
pub(super) struct Path<'a> {
    pub(super) track: &'a Track,
    pub(super) speed: f64,
    pub(super) start: f64,
    /// The middle, followed by the bodies.
    runners: Vec<Runner>,
    stretches: Vec<Stretch>,
}

impl<'a> Path<'a> {
    pub(super) fn new(track: &'a Track, speed: f64, start: f64, bodies: &[Runner]) -> Self {
        let middle = Runner {
            x: 0.0,
            height: 0.0,
        };
        let runners: Vec<Runner> = [middle].iter().chain(bodies).copied().collect();
        let mut path = Self {
            track,
            speed,
            start,
            stretches: Vec::new(),
            runners,
        };
        path.enter(0.0);
        path
    }

    /// Distance along the track of the point `x` ahead of the middle (m).
    fn distance(&self, time: f64, x: f64) -> f64 {
        self.start + self.speed * time + x
    }

    /// Distance of a body along the track (m).
    pub(super) fn distance_of(&self, body: usize, time: f64) -> f64 {
        self.distance(time, self.runners[body + 1].x)
    }

    /// Times up to `end` at which a runner reaches an edge of the layout, of a defect, of the gauge or of the friction,
    /// in increasing order.
    pub(super) fn edges(&self, end: f64) -> Vec<f64> {
        let layout = self.track.layout().starts_m();
        let defects = self.track.defects().iter().flat_map(ends);
        let edges: Vec<f64> = layout.chain(defects).chain(self.track.bends_m()).collect();
        let mut times: Vec<f64> = self
            .runners
            .iter()
            .flat_map(|runner| {
                let start = self.start + runner.x;
                edges.iter().map(move |edge| (edge - start) / self.speed)
            })
            .filter(|time| (0.0..end).contains(time) && *time > 0.0)
            .collect();
        times.sort_by(f64::total_cmp);
        times
    }

    /// Selects the part of the layout under each runner at `time`, which must not be close to an edge.
    pub(super) fn enter(&mut self, time: f64) {
        let at = |runner: &Runner| {
            let from = self.distance(time, runner.x);
            Stretch {
                from,
                alignment: self.track.layout().at(from),
            }
        };
        self.stretches = self.runners.iter().map(at).collect();
    }

    fn line(&self, runner: usize, time: f64) -> Line {
        let Stretch { from, alignment } = self.stretches[runner];
        let ahead = self.distance(time, self.runners[runner].x) - from;
        let sine = (alignment.cant_m + alignment.cant_slope * ahead) / RAILS_APART_M;
        Line {
            angle: sine.asin(),
            angle_rate: self.speed * alignment.cant_slope
                / (RAILS_APART_M * (1.0 - sine * sine).sqrt()),
            curvature: alignment.curvature_per_m + alignment.curvature_rate_per_m2 * ahead,
        }
    }

    /// Effects of the track's course on each body at `time`.
    pub(super) fn following(&self, time: f64) -> Vec<Following> {
        let layout = self.track.layout();
        let middle = self.line(0, time);
        let s = self.distance(time, 0.0);
        let heading = layout.heading_rad(s);
        let motion_of_body = |number: usize| {
            let Runner { x, height } = self.runners[number];
            let own = self.line(number, time);
            let roll = own.angle - middle.angle;
            let roll_rate = own.angle_rate - middle.angle_rate;
            let yaw = layout.heading_rad(s + x) - heading;
            let lateral = sideways(layout, s, s + x) - heading * x;
            let lateral_rate = self.speed * (yaw - middle.curvature * x);
            let yaw_rate = self.speed * (own.curvature - middle.curvature);
            let frame_velocity = [
                height * own.angle_rate,
                0.0,
                own.angle_rate,
                0.0,
                self.speed * own.curvature,
            ];
            let relative_velocity = [
                lateral_rate + height * roll_rate,
                0.0,
                roll_rate,
                0.0,
                yaw_rate,
            ];
            let centripetal = self.speed * self.speed * own.curvature;
            Following {
                offset: [lateral + height * roll, 0.0, roll, 0.0, yaw],
                offset_rate: std::array::from_fn(|k| relative_velocity[k] - frame_velocity[k]),
                frame_velocity,
                acceleration: [
                    GRAVITY_M_PER_S2 * middle.angle.sin() - centripetal * own.angle.cos(),
                    GRAVITY_M_PER_S2 * (middle.angle.cos() - 1.0) + centripetal * own.angle.sin(),
                ],
            }
        };
        (1..self.runners.len()).map(motion_of_body).collect()
    }
}

/// Integral of the heading between two distances (m).
fn sideways(layout: &Layout, from: f64, to: f64) -> f64 {
    let (low, high) = (from.min(to), from.max(to));
    let mut bounds = vec![low];
    bounds.extend(
        layout
            .starts_m()
            .filter(|start| (low..high).contains(start)),
    );
    bounds.push(high);
    let integral: f64 = bounds
        .windows(2)
        .map(|pair| {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            let at = |[abscissa, weight]: &[f64; 2]| {
                weight * layout.heading_rad(middle + half * abscissa)
            };
            half * GAUSS.iter().map(at).sum::<f64>()
        })
        .sum();
    if to < from { -integral } else { integral }
}

/// Distances at which the formula of a defect changes.
fn ends(defect: &Defect) -> Vec<f64> {
    match *defect {
        Defect::CosineDip {
            start_m, length_m, ..
        }
        | Defect::AlignmentBump {
            start_m, length_m, ..
        } => vec![start_m, start_m + length_m],
        Defect::AlignmentKink {
            start_m,
            length_m,
            rounding_m,
            ..
        } => {
            let corners = [0.0, 0.5, 1.0].map(|share| start_m + share * length_m);
            rounded(&corners, rounding_m)
        }
        Defect::Twist {
            start_m,
            base_m,
            plateau_m,
            rounding_m,
            ..
        } => {
            let behind = start_m + base_m + plateau_m;
            let corners = [start_m, start_m + base_m, behind, behind + base_m];
            rounded(&corners, rounding_m)
        }
        // The ends of other defects are not known here; only the solver's error control limits the step.
        _ => Vec::new(),
    }
}

fn rounded(corners: &[f64], rounding: f64) -> Vec<f64> {
    corners
        .iter()
        .flat_map(|corner| [corner - 0.5 * rounding, corner + 0.5 * rounding])
        .collect()
}
