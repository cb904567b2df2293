//! Ticks of the reference solution, in the form in which indices read a vehicle.

use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::vehicle::Extremes;
use dashpot_reference::vehicle::VehicleSample;
use dashpot_vehicle_run::VehicleTick;

/// Vehicle of the reference solution after a tick.
#[derive(Default)]
pub(super) struct ReferenceTick {
    sample: VehicleSample,
    /// Acceleration of the track under each body.
    track: Vec<[f64; 5]>,
    extremes: Vec<Extremes>,
    distance_m: f64,
    speed_m_per_s: f64,
}

impl ReferenceTick {
    /// Starts a tick of a vehicle with `wheelsets` wheelsets at a speed.
    pub fn begin(&mut self, wheelsets: usize, speed_m_per_s: f64) {
        self.speed_m_per_s = speed_m_per_s;
        self.extremes.clear();
        self.extremes.resize(wheelsets, Extremes::NONE);
    }

    /// Adds a sample within the tick, for the extremes.
    pub fn add(&mut self, sample: &VehicleSample) {
        for (extremes, contact) in self.extremes.iter_mut().zip(&sample.contacts) {
            extremes.add(contact);
        }
    }

    /// Ends the tick with its last sample, at which the vehicle's middle is at `distance_m` and the bodies have the
    /// accelerations `track` of their track.
    pub fn end(&mut self, sample: &VehicleSample, distance_m: f64, track: &[[f64; 5]]) {
        self.add(sample);
        self.sample.clone_from(sample);
        self.distance_m = distance_m;
        self.track.clear();
        self.track.extend_from_slice(track);
    }
}

impl VehicleTick for ReferenceTick {
    fn distance_m(&self) -> f64 {
        self.distance_m
    }
    fn speed_m_per_s(&self) -> f64 {
        self.speed_m_per_s
    }
    /// A case with events has no reference solution.
    fn friction_factor(&self) -> f64 {
        1.0
    }
    fn coordinates(&self) -> &[[f64; 5]] {
        &self.sample.coordinates
    }
    /// An accelerometer does not measure gravity, but it does measure the centripetal acceleration in a curve.
    fn acceleration(&self, body: usize) -> [f64; 5] {
        std::array::from_fn(|i| self.sample.accelerations[body][i] - self.track[body][i])
    }
    fn unbalanced_m_per_s2(&self) -> f64 {
        -self.track[0][0]
    }
    fn contacts(&self) -> &[WheelsetForces] {
        &self.sample.contacts
    }
    fn extremes(&self) -> &[Extremes] {
        &self.extremes
    }
    fn damper_displacements_m(&self) -> &[f64] {
        &self.sample.damper_displacements_m
    }
    fn damper_velocities_m_per_s(&self) -> &[f64] {
        &[]
    }
    fn damper_forces_n(&self) -> &[f64] {
        &self.sample.damper_forces_n
    }
    fn friction_forces_n(&self) -> &[f64] {
        &self.sample.friction_forces_n
    }
}
