//! Random dampers from the full ranges of docs/parameters.md, and small changes of them.

use dashpot_core::parameters::{
    Element, Geometry, Leakage, Limits, Mount, Oil, OilColumn, Orifice, Range, Reduced, Relief,
    Reservoir, Seal, Shims, TwoChamber, Valve,
};
use dashpot_core::{BuildError, CheckedParameters, DamperParameters};

use crate::random_damper::{Random, damper};

/// Changes a value of a damper within its range.
type Change<'a> = &'a mut dyn FnMut(&mut f64, &Range);

/// A value anywhere in its range, sometimes its minimum; uniform over the decades of a wide range.
fn anywhere(random: &mut Random, range: &Range) -> f64 {
    let (least, greatest) = (range.min, range.max);
    if random.happens(0.05) {
        least
    } else if least >= 0.0 && (least == 0.0 || greatest > 100.0 * least) {
        random.decades(least.max(1e-6 * greatest), greatest)
    } else {
        random.between(least, greatest)
    }
}

/// A damper that `check` accepts, with some values anywhere in their documented ranges and the others at usual values.
pub fn documented_damper(random: &mut Random) -> CheckedParameters {
    loop {
        let mut parameters = damper(random);
        use_shims(&mut parameters, random);
        let share = [0.0, 0.03, 0.15, 0.5][(4.0 * random.unit()) as usize];
        change(&mut parameters, &mut |number, range| {
            if random.happens(share) {
                *number = anywhere(random, range);
            }
        });
        if let Some(checked) = related(parameters, random) {
            return checked;
        }
    }
}

/// A damper with some values slightly changed.
pub fn changed_damper(base: &DamperParameters, random: &mut Random) -> CheckedParameters {
    loop {
        let mut parameters = base.clone();
        change(&mut parameters, &mut |number, range| {
            if random.happens(0.25) {
                let factor = random.between(-0.6, 0.6).exp();
                *number = (*number * factor).clamp(range.min, range.max);
            }
        });
        if let Some(checked) = related(parameters, random) {
            return checked;
        }
    }
}

/// Describes some valves by the discs of a shim pack instead of a compliance.
fn use_shims(parameters: &mut DamperParameters, random: &mut Random) {
    let Element::Physical(hydraulics) = &mut parameters.element else {
        return;
    };
    let valves = &mut hydraulics.valves;
    for valve in [
        &mut valves.piston_extension,
        &mut valves.piston_compression,
        &mut valves.foot_compression,
    ] {
        if random.happens(0.3) {
            let shims = 1 + (8.0 * random.unit()) as usize;
            let thicknesses: Vec<f64> = (0..shims).map(|_| random.decades(1e-4, 1e-3)).collect();
            valve.shims_m = Shims::new(&thicknesses).expect("at most 8 shims");
            valve.edge_compliance_m_per_pa = None;
        }
    }
}

/// Adjusts the damper so that it satisfies all relations between its values; `None` if the final check refuses it.
fn related(mut parameters: DamperParameters, random: &mut Random) -> Option<CheckedParameters> {
    if let Element::Physical(hydraulics) = &mut parameters.element {
        let geometry = &mut hydraulics.geometry;
        let piston = geometry.piston_diameter_m;
        if !(0.01 * piston..=0.95 * piston).contains(&geometry.rod_diameter_m) {
            geometry.rod_diameter_m = piston * random.between(0.1, 0.9);
        }
        if hydraulics.orifice.diameter_m >= piston {
            hydraulics.orifice.diameter_m = piston * random.decades(1e-3, 0.5);
        }
        let valves = &mut hydraulics.valves;
        for valve in [
            &mut valves.piston_extension,
            &mut valves.piston_compression,
            &mut valves.foot_compression,
        ] {
            if valve.free_radius_m <= 0.0 {
                valve.free_radius_m = 0.3 * piston;
            }
            let clamp = valve.clamp_radius_m / valve.free_radius_m;
            if !(0.01..0.99).contains(&clamp) {
                valve.clamp_radius_m = random.between(0.05, 0.95) * valve.free_radius_m;
            }
        }
        let oil = &mut hydraulics.oil;
        if oil.viscosity_100c_m2_per_s >= oil.viscosity_40c_m2_per_s {
            oil.viscosity_100c_m2_per_s = 0.5 * oil.viscosity_40c_m2_per_s;
        }
        let limit = parameters.limits.force_n;
        if let Some(seal) = &mut hydraulics.seal
            && limit <= 2.0 * seal.friction_n
        {
            seal.friction_n = random.between(0.0, 0.45) * limit;
        }
    }
    match parameters.check() {
        Err(BuildError {
            field: "force_n",
            bound: Some(bound),
            ..
        }) => {
            parameters.limits.force_n = 0.9 * bound;
            parameters.check().ok()
        }
        checked => checked.ok(),
    }
}

/// Applies a change to every value of a damper, with its range.
fn change(parameters: &mut DamperParameters, by: Change<'_>) {
    let mount = &mut parameters.mount;
    by(
        &mut mount.stiffness_n_per_m,
        &Mount::RANGES.stiffness_n_per_m,
    );
    if let Some(seats) = &mut mount.seat_stiffness_n_per_m {
        by(seats, &Mount::RANGES.seat_stiffness_n_per_m);
    }
    by(&mut mount.clearance_m, &Mount::RANGES.clearance_m);
    by(&mut parameters.limits.force_n, &Limits::RANGES.force_n);
    by(
        &mut parameters.limits.rate_m_per_s,
        &Limits::RANGES.rate_m_per_s,
    );
    let hydraulics = match &mut parameters.element {
        Element::Reduced(reduced) => {
            let ranges = Reduced::RANGES;
            by(&mut reduced.damping_n_s_per_m, &ranges.damping_n_s_per_m);
            by(
                &mut reduced.saturation_velocity_m_per_s,
                &ranges.saturation_velocity_m_per_s,
            );
            return;
        }
        Element::Physical(hydraulics) => hydraulics,
        other => panic!("no ranges of {other:?}"),
    };
    let (geometry, ranges) = (&mut hydraulics.geometry, Geometry::RANGES);
    by(&mut geometry.rod_diameter_m, &ranges.rod_diameter_m);
    by(&mut geometry.piston_diameter_m, &ranges.piston_diameter_m);
    let (orifice, ranges) = (&mut hydraulics.orifice, Orifice::RANGES);
    by(&mut orifice.diameter_m, &ranges.diameter_m);
    by(
        &mut orifice.discharge_coefficient,
        &ranges.discharge_coefficient,
    );
    by(
        &mut orifice.transition_reynolds,
        &ranges.transition_reynolds,
    );
    change_valve(&mut hydraulics.valves.piston_extension, by);
    change_valve(&mut hydraulics.valves.piston_compression, by);
    change_valve(&mut hydraulics.valves.foot_compression, by);
    if let Some(leakage) = &mut hydraulics.leakage {
        let ranges = Leakage::RANGES;
        by(&mut leakage.radial_clearance_m, &ranges.radial_clearance_m);
        by(&mut leakage.length_m, &ranges.length_m);
        by(&mut leakage.eccentricity_ratio, &ranges.eccentricity_ratio);
    }
    if let Some(relief) = &mut hydraulics.relief {
        let ranges = Relief::RANGES;
        by(&mut relief.opening_pressure_pa, &ranges.opening_pressure_pa);
        by(
            &mut relief.area_gradient_m2_per_pa,
            &ranges.area_gradient_m2_per_pa,
        );
        by(
            &mut relief.discharge_coefficient,
            &ranges.discharge_coefficient,
        );
    }
    if let Some(reservoir) = &mut hydraulics.reservoir {
        let ranges = Reservoir::RANGES;
        by(&mut reservoir.fill_pressure_pa, &ranges.fill_pressure_pa);
        by(&mut reservoir.gas_volume_m3, &ranges.gas_volume_m3);
        by(
            &mut reservoir.fill_temperature_c,
            &ranges.fill_temperature_c,
        );
        by(&mut reservoir.rod_insertion_m, &ranges.rod_insertion_m);
    }
    if let Some(seal) = &mut hydraulics.seal {
        by(&mut seal.friction_n, &Seal::RANGES.friction_n);
    }
    if let Some(two_chamber) = &mut hydraulics.two_chamber {
        by(
            &mut two_chamber.vapour_pressure_pa,
            &TwoChamber::RANGES.vapour_pressure_pa,
        );
    }
    change_oil(&mut hydraulics.oil, by);
}

fn change_valve(valve: &mut Valve, by: Change<'_>) {
    let ranges = Valve::RANGES;
    by(&mut valve.clamp_radius_m, &ranges.clamp_radius_m);
    by(&mut valve.free_radius_m, &ranges.free_radius_m);
    for shim in valve.shims_m.iter_mut() {
        by(shim, &ranges.shims_m);
    }
    if let Some(compliance) = &mut valve.edge_compliance_m_per_pa {
        by(compliance, &ranges.edge_compliance_m_per_pa);
    }
    by(
        &mut valve.equivalent_pressure_factor,
        &ranges.equivalent_pressure_factor,
    );
    by(
        &mut valve.discharge_coefficient,
        &ranges.discharge_coefficient,
    );
    by(&mut valve.preload_pa, &ranges.preload_pa);
    by(&mut valve.elastic_modulus_pa, &ranges.elastic_modulus_pa);
    by(&mut valve.poisson_ratio, &ranges.poisson_ratio);
}

fn change_oil(oil: &mut Oil, by: Change<'_>) {
    let ranges = Oil::RANGES;
    by(&mut oil.density_kg_per_m3, &ranges.density_kg_per_m3);
    by(
        &mut oil.thermal_expansion_per_k,
        &ranges.thermal_expansion_per_k,
    );
    by(&mut oil.temperature_c, &ranges.temperature_c);
    by(
        &mut oil.viscosity_40c_m2_per_s,
        &ranges.viscosity_40c_m2_per_s,
    );
    by(
        &mut oil.viscosity_100c_m2_per_s,
        &ranges.viscosity_100c_m2_per_s,
    );
    if let Some(column) = &mut oil.column {
        let ranges = OilColumn::RANGES;
        by(&mut column.bulk_modulus_pa, &ranges.bulk_modulus_pa);
        by(&mut column.rod_side_volume_m3, &ranges.rod_side_volume_m3);
        by(
            &mut column.piston_side_volume_m3,
            &ranges.piston_side_volume_m3,
        );
        by(&mut column.air_fraction, &ranges.air_fraction);
        by(&mut column.polytropic_exponent, &ranges.polytropic_exponent);
    }
}
