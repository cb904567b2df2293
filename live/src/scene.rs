//! What a page draws and does not change while the vehicle runs.

use dashpot_files::case::Case;
use dashpot_files::damper::PRESETS;
use dashpot_rail::contact::Pair;
use dashpot_rail::indices::{nadal_limit, prudhomme_limit_n};
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Direction, Law, Standstill};
use dashpot_vehicle_run::signals::slug;
use dashpot_vehicle_run::{Run, VehicleRunError};
use serde::Serialize;

use crate::defect::{DEFECTS, DefectKind};
use crate::desk::{Desk, SPEED_KM_H};
use crate::fault::{FAULTS, FaultKind};
use crate::outline::Outline;
use crate::quantity::Quantity;
use crate::signal::SignalWords;

/// Half the width of a car body, m.
const HALF_BODY_M: f64 = 1.5;
/// Half the width of a bogie frame, m.
const HALF_FRAME_M: f64 = 1.05;
/// Points of each profile.
const PROFILE_POINTS: usize = 160;
/// Points of a curve's transition.
const COURSE_M: f64 = 5.0;

/// A vehicle on its track, as a page draws it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scene {
    #[serde(rename = "type")]
    kind: &'static str,
    /// Version of Dashpot.
    pub version: &'static str,
    /// Name of the case.
    pub case: String,
    /// Name of the vehicle.
    pub vehicle: String,
    /// Name of the track.
    pub track: String,
    /// Where the numbers come from: `page`, `machine`, `target` or `recording`.
    pub source: &'static str,
    /// `operator` or `viewer`.
    pub role: &'static str,
    /// True if a damper is on a rig, which an operator can stop.
    pub has_rig: bool,
    step_s: f64,
    start_m: f64,
    end_m: Option<f64>,
    speed_range_km_h: [f64; 2],
    signals: Vec<SignalWords>,
    bodies: Vec<SceneBody>,
    wheelsets: Vec<SceneWheelset>,
    dampers: Vec<SceneDamper>,
    profiles: Profiles,
    derailment_limit: f64,
    course: Vec<[f64; 3]>,
    faults: &'static [FaultKind],
    defects: &'static [DefectKind],
    native_digest: &'static str,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct SceneBody {
    name: String,
    slug: String,
    kind: &'static str,
    x_m: [f64; 2],
    height_m: [f64; 2],
    half_width_m: f64,
    centre_m: [f64; 2],
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct SceneWheelset {
    name: String,
    slug: String,
    x_m: f64,
    radius_m: f64,
    load_static_n: f64,
    lateral_limit_n: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct SceneDamper {
    name: String,
    slug: String,
    direction: &'static str,
    on: [Option<String>; 2],
    ends_m: [[f64; 3]; 2],
    quantities: Vec<Quantity>,
    presets: Vec<&'static str>,
    outside: bool,
}

/// Right wheel and right rail in track axes: y from the middle of the track, z down from the top of the rail.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Profiles {
    wheel_m: Vec<[f64; 2]>,
    rail_m: Vec<[f64; 2]>,
    datum_offset_m: f64,
    gauge_m: f64,
}

impl Scene {
    /// The scene of a run of the desk's case before its first tick; `signals` are the names in a frame.
    ///
    /// # Errors
    /// A vehicle without wheelsets or equilibrium, or profiles that do not fit each other.
    pub fn new(desk: &Desk, run: &Run, signals: &[String]) -> Result<Self, VehicleRunError> {
        let case = desk.case();
        let vehicle = &case.vehicle;
        let standstill = Standstill::new(vehicle)?;
        let loads_n = standstill.axle_loads_n();
        let wheelsets = vehicle.wheelsets.iter().zip(loads_n);
        let pair = pair(case)?;
        Ok(Self {
            kind: "scene",
            version: env!("CARGO_PKG_VERSION"),
            case: case.name.clone(),
            vehicle: vehicle.name.clone(),
            track: case.track.name.clone(),
            source: "page",
            role: "operator",
            has_rig: false,
            step_s: case.step_s,
            start_m: case.start_m,
            end_m: end_m(run.track()),
            speed_range_km_h: SPEED_KM_H,
            signals: signals.iter().map(|name| SignalWords::of(name)).collect(),
            bodies: bodies(case),
            wheelsets: wheelsets
                .map(|(wheelset, load_n)| SceneWheelset {
                    name: wheelset.name.clone(),
                    slug: slug(&wheelset.name),
                    x_m: wheelset.x_m,
                    radius_m: wheelset.radius_m,
                    load_static_n: 0.5 * load_n,
                    lateral_limit_n: prudhomme_limit_n(*load_n),
                })
                .collect(),
            dampers: dampers(desk, run),
            derailment_limit: nadal_limit(
                pair.flange_angle_rad(),
                case.contact.greatest_friction(1, case.friction),
            ),
            profiles: profiles(&pair),
            course: course(run.track(), case.start_m),
            faults: &FAULTS,
            defects: &DEFECTS,
            native_digest: crate::REFERENCE_DIGEST,
        })
    }
}

fn bodies(case: &Case) -> Vec<SceneBody> {
    let bodies = case.vehicle.bodies.iter();
    bodies
        .map(|body| {
            let outline = Outline::of(&case.vehicle, body);
            let (kind, half_width_m) = match outline.is_frame {
                true => ("frame", HALF_FRAME_M),
                false => ("body", HALF_BODY_M),
            };
            SceneBody {
                name: body.name.clone(),
                slug: slug(&body.name),
                kind,
                x_m: outline.x_m,
                height_m: outline.height_m,
                half_width_m,
                centre_m: [body.x_m, body.height_m],
            }
        })
        .collect()
}

fn dampers(desk: &Desk, run: &Run) -> Vec<SceneDamper> {
    let elements = desk.case().vehicle.dampers().zip(desk.dampers());
    elements
        .enumerate()
        .map(|(index, (element, damper))| SceneDamper {
            name: element.name.clone(),
            slug: slug(&element.name),
            direction: match element.law {
                Law::Damper {
                    direction: Direction::Longitudinal,
                    ..
                } => "longitudinal",
                Law::Damper {
                    direction: Direction::Lateral,
                    ..
                } => "lateral",
                _ => "vertical",
            },
            on: element
                .ends
                .each_ref()
                .map(|end| end.on.as_deref().map(slug)),
            ends_m: element.ends.each_ref().map(|end| end.at_m),
            quantities: damper.quantities(),
            presets: PRESETS.iter().map(|(name, _)| *name).collect(),
            outside: run.state().outside_force_n(index).is_some(),
        })
        .collect()
}

/// The right wheel of the leading wheelset on its rail.
fn pair(case: &Case) -> Result<Pair, VehicleRunError> {
    let radius_m = case
        .vehicle
        .wheelsets
        .first()
        .map_or(0.5, |wheelset| wheelset.radius_m);
    let wheel = (**case.contact.wheel(0, 1)).clone();
    let pair = Pair::new(
        wheel,
        case.contact.rail(1),
        case.contact.installation(radius_m),
    );
    Ok(pair?)
}

/// Places the wheel on the rail as in the middle of the track.
fn profiles(pair: &Pair) -> Profiles {
    let offset_m = pair.installation().datum_offset_m();
    let (wheel, rail) = (pair.wheel(), pair.rail());
    let thin = |points: Vec<[f64; 2]>| {
        let stride = points.len().div_ceil(PROFILE_POINTS).max(1);
        points.into_iter().step_by(stride).collect::<Vec<_>>()
    };
    let of = |profile: &dashpot_rail::profile::Profile, shift: [f64; 2]| {
        let points = profile.points().iter();
        thin(
            points
                .map(|point| [point.y_m + shift[0], point.z_m + shift[1]])
                .collect(),
        )
    };
    let rail_m = of(rail, [0.0, 0.0]);
    let gaps = rail_m.iter().filter_map(|[y, z]| {
        let [first, last] =
            [wheel.points().first()?, wheel.points().last()?].map(|point| point.y_m);
        let on_wheel = y - offset_m;
        let is_over = (first.min(last)..=first.max(last)).contains(&on_wheel);
        is_over.then(|| z - wheel.at(on_wheel).z_m)
    });
    let gap_m = gaps.fold(f64::INFINITY, f64::min);
    let gap_m = if gap_m.is_finite() { gap_m } else { 0.0 };
    Profiles {
        wheel_m: of(wheel, [offset_m, gap_m]),
        rail_m,
        datum_offset_m: offset_m,
        gauge_m: pair.installation().gauge_m,
    }
}

/// End of the irregularities, m; `None` on an even track.
fn end_m(track: &Track) -> Option<f64> {
    let [start_m, end_m] = track.irregularity().ends_m();
    (end_m > start_m).then_some(end_m)
}

/// Curvature and cant at the corners of their polylines: distance (m), curvature (1/m), cant (m).
fn course(track: &Track, start_m: f64) -> Vec<[f64; 3]> {
    let layout = track.layout();
    let mut distances: Vec<f64> = std::iter::once(start_m - 100.0)
        .chain(layout.starts_m())
        .collect();
    distances.push(layout.length_m());
    let corners = distances
        .iter()
        .flat_map(|distance| [distance - 1e-3, *distance]);
    let between = distances.windows(2).flat_map(|ends| {
        let count = ((ends[1] - ends[0]) / COURSE_M).clamp(0.0, 20.0) as usize;
        let ends = [ends[0], ends[1]];
        (1..count).map(move |k| ends[0] + (ends[1] - ends[0]) * k as f64 / count as f64)
    });
    let mut all: Vec<f64> = corners
        .chain(between)
        .filter(|distance| distance.is_finite())
        .collect();
    all.sort_by(f64::total_cmp);
    all.into_iter()
        .map(|distance| {
            let at = layout.at(distance);
            [distance, at.curvature_per_m, at.cant_m]
        })
        .collect()
}
