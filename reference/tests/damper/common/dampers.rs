//! Dampers of the reference tests.

use dashpot_core::parameters::{
    DamperParameters, Element, Geometry, Hydraulics, Leakage, Limits, Mount, Oil, OilColumn,
    Orifice, Relief, Reservoir, Seal, TwoChamber, Valve, Valves,
};

/// A valve with the published compliance (m/Pa).
fn published(clamp: f64, free: f64, compliance: f64, factor: f64) -> Valve {
    Valve::with_edge_compliance(clamp, free, compliance, 0.61).equivalent_pressure_factor(factor)
}

fn paper_hydraulics() -> Hydraulics {
    Hydraulics::new(
        Geometry::new(0.028, 0.0698),
        Orifice::new(0.002, 0.72),
        Valves::new(
            published(0.016, 0.029, 1.36e-11, 0.2169),
            published(0.016, 0.029, 1.37e-11, 0.2000),
            published(0.005, 0.011, 1.446e-12, 0.8265),
        ),
        Oil::new(860.0)
            .temperature_c(45.0)
            .viscosity_40c_m2_per_s(15e-6)
            .viscosity_100c_m2_per_s(3.8e-6),
    )
}

/// The damper exactly as published.
pub fn paper() -> DamperParameters {
    DamperParameters::new(Element::Physical(paper_hydraulics()), Mount::new(6e6))
}

/// The published damper with 1 mm of clearance.
pub fn paper_with_clearance() -> DamperParameters {
    let mut parameters = paper();
    parameters.mount = Mount::new(8e6).clearance_m(1e-3);
    parameters
}

/// The reduced vertical damper of the paper's vehicle model.
pub fn reduced_vertical() -> DamperParameters {
    reduced(120e3, 0.03, 8e6, 1e-3)
}

/// A reduced element.
pub fn reduced(damping: f64, saturation: f64, stiffness: f64, clearance: f64) -> DamperParameters {
    let mount = Mount::new(stiffness).clearance_m(clearance);
    DamperParameters::reduced(damping, saturation, mount)
        .limits(Limits::DEFAULT.force_n(1e6).rate_m_per_s(100.0))
}

/// A damper with all in-service terms.
pub fn in_service(two_chamber: bool) -> DamperParameters {
    let mut hydraulics = paper_hydraulics();
    hydraulics.orifice.transition_reynolds = 100.0;
    hydraulics.valves.piston_extension.preload_pa = 0.5e6;
    hydraulics.valves.piston_compression.preload_pa = 0.5e6;
    hydraulics.valves.foot_compression.preload_pa = 0.3e6;
    hydraulics.leakage = Some(Leakage::new(30e-6, 0.03).eccentricity_ratio(0.5));
    hydraulics.relief = Some(Relief::new(5e6, 5e-12, 0.65));
    hydraulics.reservoir = Some(Reservoir::new(0.1e6, 0.5e-3, 20.0).rod_insertion_m(0.02));
    hydraulics.seal = Some(Seal::new(150.0));
    hydraulics.two_chamber = two_chamber.then_some(TwoChamber::new(-0.9e5));
    hydraulics.oil.thermal_expansion_per_k = 7e-4;
    hydraulics.oil.density_kg_per_m3 = 870.0;
    hydraulics.oil.column = Some(OilColumn::new(1.5e9, 0.5e-3, 0.6e-3).air_fraction(0.005));
    let mount = Mount::new(8e6)
        .seat_stiffness_n_per_m(40e6)
        .clearance_m(1e-3);
    DamperParameters::new(Element::Physical(hydraulics), mount)
}
