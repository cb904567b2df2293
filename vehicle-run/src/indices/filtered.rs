//! Wheel forces as acceptance tests judge them: filtered at 20 Hz, and averaged over 2 m.

use dashpot_rail::vehicle::VehicleParameters;

use super::Indexer;
use crate::signals::{SIDES, slug};

/// Names of the filtered forces of a vehicle: of each wheelset the lateral force on the track, and of each of its
/// wheels `Y/Q` and the load. Each ends in the unit.
pub fn filtered_names(vehicle: &VehicleParameters) -> Vec<String> {
    let of_wheelset = |name: String| {
        let lateral = format!("{name}_filtered_lateral_force_n");
        let wheels = SIDES.into_iter().flat_map(move |side| {
            [
                format!("{name}_{side}_filtered_derailment"),
                format!("{name}_{side}_filtered_load_n"),
            ]
        });
        std::iter::once(lateral).chain(wheels)
    };
    let wheelsets = vehicle.wheelsets.iter();
    wheelsets
        .flat_map(|wheelset| of_wheelset(slug(&wheelset.name)))
        .collect()
}

impl Indexer {
    /// Filtered forces after the last tick, in the order of [`filtered_names`]. Lateral forces and `Y/Q` are means over
    /// 2 m, or over all ticks before the first 2 m.
    pub fn filtered(&self) -> impl Iterator<Item = f64> + '_ {
        self.wheelsets.iter().flat_map(|wheelset| {
            let wheels = wheelset.wheels.iter();
            let of_wheels =
                wheels.flat_map(|wheel| [wheel.filtered_derailment.mean(), wheel.filtered_load_n]);
            std::iter::once(wheelset.filtered_lateral.mean()).chain(of_wheels)
        })
    }
}
