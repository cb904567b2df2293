//! Wear of the wheels over a run: an estimate by a published law.

use std::sync::Arc;

use dashpot_rail::creep::Friction;
use dashpot_rail::track::Track;
pub use dashpot_wear::{CellWear, WearLaw};
use dashpot_wear::{Wear, WearEstimate, WearGrid, WearingPatch};
use serde::Serialize;

use super::VehicleTick;
use super::contact::Contact;
use super::indices::Travelled;
use super::run::Run;
use super::signals::SIDES;
use dashpot_files::case::Case;

/// Distance to which depths and areas are related, m.
pub const PER_DISTANCE_M: f64 = 1e6;

/// Adds up the wear of every wheel of a run, tick by tick.
#[derive(Debug, Clone)]
pub struct RunWear {
    wheelsets: Vec<WheelsetWear>,
    friction: Friction,
    track: Arc<Track>,
    step_s: f64,
    travelled: Travelled,
}

/// Wear of the left and the right wheel of a wheelset.
#[derive(Debug, Clone)]
struct WheelsetWear {
    name: String,
    /// Position from the middle of the vehicle, positive forward, m.
    position_m: f64,
    radius_m: f64,
    wheels: [Wear; 2],
}

/// Estimated wear of the wheels over a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WearIndices {
    /// States that the values are an estimate, and what it leaves out.
    pub note: &'static str,
    /// Name of the law.
    pub law: &'static str,
    /// Publication of the law.
    pub source: &'static str,
    /// Distance covered by the run, m.
    pub distance_m: f64,
    /// Each wheel: left and right of the first wheelset, then of the next.
    pub wheels: Vec<WheelWear>,
}

/// Estimated wear of one wheel over a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelWear {
    /// Name of the wheelset.
    pub wheelset: String,
    /// Side, `left` or `right`.
    pub side: &'static str,
    /// Mean wear number, N.
    pub wear_number_n: f64,
    /// Maximum depth over the run, m.
    pub max_depth_m: f64,
    /// Lateral position of the maximum depth on the wheel, from the tread datum, field side positive, m.
    pub max_depth_at_m: f64,
    /// Maximum depth per 1000 km like the run, um.
    pub max_depth_um_per_1000km: f64,
    /// Area that the profile loses per 1000 km like the run, mm^2.
    pub lost_area_mm2_per_1000km: f64,
    /// Depth over the run at each cell of the profile.
    #[serde(skip)]
    pub profile: WearEstimate,
}

/// What every report of wear states.
const NOTE: &str = "Estimate by a law from laboratory tests of dry steel; without lubrication and plastic flow. \
                    Compare variants with it.";

impl RunWear {
    /// Starts the wear of a case in its run, by a law.
    pub fn new(case: &Case, run: &Run, law: WearLaw) -> Self {
        Self::on(case, run.contacts(), Arc::clone(run.track()), law)
    }

    /// Starts the wear of a case with the contact of each wheelset and the built track, by a law.
    pub fn on(case: &Case, contacts: &[Contact], track: Arc<Track>, law: WearLaw) -> Self {
        let wheels = |contact: &Contact| {
            contact.sources().each_ref().map(|source| {
                let wheel = source.geometry().pair().wheel();
                Wear::new(WearGrid::new(wheel), law)
            })
        };
        let wheelsets = case.vehicle.wheelsets.iter().zip(contacts);
        Self {
            wheelsets: wheelsets
                .map(|(wheelset, contact)| WheelsetWear {
                    name: wheelset.name.clone(),
                    position_m: wheelset.x_m,
                    radius_m: wheelset.radius_m,
                    wheels: wheels(contact),
                })
                .collect(),
            friction: case.contact.friction(case.friction),
            track,
            step_s: case.step_s,
            travelled: Travelled::default(),
        }
    }

    /// Adds a tick of the vehicle. Does not allocate.
    pub fn add(&mut self, state: &impl VehicleTick) {
        let speed_m_per_s = state.speed_m_per_s();
        let tick_m = speed_m_per_s * self.step_s;
        self.travelled.add(tick_m);
        for (wheelset, contact) in self.wheelsets.iter_mut().zip(state.contacts()) {
            let at_m = state.distance_m() + wheelset.position_m;
            let ratios = self.track.friction_ratios(at_m);
            let wheels = wheelset.wheels.iter_mut().zip(&contact.wheels);
            for ((wear, wheel), ratio) in wheels.zip(ratios) {
                for patch in wheel.loaded_patches() {
                    let sliding_m_per_s = patch.creepage.magnitude() * speed_m_per_s;
                    let friction =
                        state.friction_factor() * ratio * self.friction.at(sliding_m_per_s);
                    let wearing = WearingPatch::new(patch, speed_m_per_s, friction);
                    wear.add(patch.wheel_y_m, &wearing, tick_m);
                }
            }
        }
    }

    /// The wear of all ticks so far; `None` before the first tick.
    pub fn indices(&self) -> Option<WearIndices> {
        let distance_m = self.travelled.metres();
        let law = self.wheelsets.first()?.wheels[0].law();
        if distance_m <= 0.0 {
            return None;
        }
        let wheels = self.wheelsets.iter().flat_map(|wheelset| {
            wheelset.wheels.iter().zip(SIDES).map(|(wear, side)| {
                let profile = wear.of_wheel(wheelset.radius_m);
                let per_distance = PER_DISTANCE_M / distance_m;
                let deepest = profile
                    .cells
                    .iter()
                    .max_by(|p, q| p.depth_m.total_cmp(&q.depth_m));
                WheelWear {
                    wheelset: wheelset.name.clone(),
                    side,
                    wear_number_n: wear.work_j() / distance_m,
                    max_depth_m: profile.max_depth_m,
                    max_depth_at_m: deepest.map_or(0.0, |cell| cell.y_m),
                    max_depth_um_per_1000km: 1e6 * profile.max_depth_m * per_distance,
                    lost_area_mm2_per_1000km: 1e6 * profile.area_m2 * per_distance,
                    profile,
                }
            })
        });
        Some(WearIndices {
            note: NOTE,
            law: law.name(),
            source: law.source(),
            distance_m,
            wheels: wheels.collect(),
        })
    }
}

impl WearIndices {
    /// The wheel with the maximum depth.
    pub fn worst(&self) -> Option<&WheelWear> {
        let wheels = self.wheels.iter();
        wheels.max_by(|p, q| p.max_depth_m.total_cmp(&q.max_depth_m))
    }
}
