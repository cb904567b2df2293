//! Indices that step and reference are compared by: all that a page, a JSON file or a study reports.

use dashpot_vehicle_run::wear::WheelWear;
use dashpot_vehicle_run::{
    BodyIndices, Indices, RideIndices, WearIndices, WheelIndices, WheelsetIndices,
};

/// An index of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Compared {
    pub name: String,
    pub value: f64,
    /// Differences are relative to the value, or to this scale if the value is smaller: an index can be zero.
    pub scale: f64,
    /// True for a minimum, a maximum or a duration, false for a mean or a root mean square.
    pub is_extreme: bool,
}

impl Compared {
    /// Difference from the expected index, relative to it or to its scale.
    pub fn deviation(&self, expected: &Self) -> f64 {
        (self.value - expected.value).abs() / expected.value.abs().max(self.scale)
    }
}

/// Scale of accelerations, m/s^2.
pub(super) const ACCELERATION: f64 = 0.01;
/// Scale of lateral forces and damper forces, N.
const FORCE_N: f64 = 1e3;
/// Scale of wear numbers, N.
const WEAR_NUMBER_N: f64 = 1.0;
/// Scale of `Y/Q`.
const DERAILMENT: f64 = 0.05;
/// Scale of the longest distance above Nadal's limit, m.
const DISTANCE_M: f64 = 2.0;
/// Scale of the share of time without load.
const SHARE: f64 = 0.05;
/// Scale of the depth of wear, um per 1000 km.
const DEPTH_UM: f64 = 1.0;
/// Scale of the worn area, mm^2 per 1000 km.
const AREA_MM2: f64 = 0.01;

/// Collects indices under the name of their owner.
struct List(Vec<Compared>);

impl List {
    fn mean(&mut self, owner: &str, what: &str, value: f64, scale: f64) {
        self.push(owner, what, value, scale, false);
    }

    fn extreme(&mut self, owner: &str, what: &str, value: f64, scale: f64) {
        self.push(owner, what, value, scale, true);
    }

    fn push(&mut self, owner: &str, what: &str, value: f64, scale: f64, is_extreme: bool) {
        self.0.push(Compared {
            name: format!("{owner}, {what}"),
            value,
            scale,
            is_extreme,
        });
    }

    fn body(&mut self, body: &BodyIndices) {
        let name = &body.body;
        self.mean(name, "lateral rms", body.lateral_rms_m_per_s2, ACCELERATION);
        self.mean(
            name,
            "vertical rms",
            body.vertical_rms_m_per_s2,
            ACCELERATION,
        );
        let (lateral, vertical) = (
            body.lateral_greatest_m_per_s2,
            body.vertical_greatest_m_per_s2,
        );
        self.extreme(name, "greatest lateral acceleration", lateral, ACCELERATION);
        self.extreme(
            name,
            "greatest vertical acceleration",
            vertical,
            ACCELERATION,
        );
    }

    fn ride(&mut self, ride: &RideIndices) {
        for (what, index) in [
            ("W lateral", ride.sperling_lateral),
            ("W vertical", ride.sperling_vertical),
            ("N_MV", ride.mean_comfort),
        ] {
            if let Some(index) = index {
                self.mean(&ride.point, what, index, 0.01);
            }
        }
    }

    fn wheelset(&mut self, wheelset: &WheelsetIndices) {
        let name = &wheelset.wheelset;
        self.mean(
            name,
            "lateral force rms",
            wheelset.lateral_force_rms_n,
            FORCE_N,
        );
        self.extreme(
            name,
            "greatest lateral force",
            wheelset.lateral_force_greatest_n,
            FORCE_N,
        );
        self.mean(name, "wear number", wheelset.wear_number_n, WEAR_NUMBER_N);
        self.mean(
            name,
            "wear number rms",
            wheelset.wear_number_rms_n,
            WEAR_NUMBER_N,
        );
        self.extreme(
            name,
            "greatest wear number",
            wheelset.wear_number_greatest_n,
            WEAR_NUMBER_N,
        );
        for wheel in &wheelset.wheels {
            self.wheel(&format!("{name}, {}", wheel.side), wheel);
        }
    }

    fn wheel(&mut self, name: &str, wheel: &WheelIndices) {
        self.mean(name, "Y/Q rms", wheel.derailment_rms, DERAILMENT);
        self.extreme(name, "greatest Y/Q", wheel.derailment_greatest, DERAILMENT);
        self.extreme(
            name,
            "Y/Q over Nadal's limit",
            wheel.derailment_over_nadal,
            DERAILMENT,
        );
        self.extreme(
            name,
            "distance over Nadal's limit",
            wheel.longest_over_nadal_m,
            DISTANCE_M,
        );
        // The least load may be zero, and unloading is relative to the load at standstill.
        let static_n = wheel.load_static_n.unwrap_or(FORCE_N);
        self.extreme(name, "least load", wheel.load_least_n, static_n);
        self.extreme(name, "greatest load", wheel.load_greatest_n, static_n);
        self.extreme(
            name,
            "least filtered load",
            wheel.filtered_load_least_n,
            static_n,
        );
        self.extreme(
            name,
            "greatest filtered load",
            wheel.filtered_load_greatest_n,
            static_n,
        );
        if let Some(unloading) = wheel.unloading_of_mean_greatest {
            self.extreme(name, "unloading of the mean", unloading, 1.0);
        }
        self.extreme(name, "lifted share", wheel.lifted_share, SHARE);
    }

    fn wear(&mut self, wear: &WheelWear) {
        let name = format!("{}, {}", wear.wheelset, wear.side);
        self.extreme(&name, "wear depth", wear.max_depth_um_per_1000km, DEPTH_UM);
        self.extreme(&name, "worn area", wear.lost_area_mm2_per_1000km, AREA_MM2);
    }
}

/// Returns the compared indices of a run in a fixed order. `dampers` are the names of the dampers.
pub(super) fn compared(
    indices: &Indices,
    wear: Option<&WearIndices>,
    dampers: &[String],
) -> Vec<Compared> {
    let mut list = List(Vec::new());
    for body in &indices.bodies {
        list.body(body);
    }
    for ride in &indices.ride {
        list.ride(ride);
    }
    for wheelset in &indices.wheelsets {
        list.wheelset(wheelset);
    }
    for (name, force_n) in dampers.iter().zip(&indices.greatest_damper_forces_n) {
        list.extreme(name, "greatest force", *force_n, FORCE_N);
    }
    for wheel in wear.iter().flat_map(|wear| &wear.wheels) {
        list.wear(wheel);
    }
    list.0
}
