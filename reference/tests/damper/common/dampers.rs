//! Dampers of the reference tests.

use dashpot_core::parameters::{
    DamperParameters, Element, Geometry, Hydraulics, Leakage, Limits, Mount, Oil, OilColumn,
    Orifice, Reduced, Relief, Reservoir, Seal, TwoChamber, Valve, Valves,
};

/// A valve with the published compliance [m/Pa], steel as in Table 1 of the source paper.
fn published(clamp: f64, free: f64, compliance: f64, factor: f64) -> Valve {
    Valve {
        clamp_radius_m: clamp,
        free_radius_m: free,
        shims_m: heapless::Vec::new(),
        edge_compliance_m_per_pa: Some(compliance),
        equivalent_pressure_factor: factor,
        discharge_coefficient: 0.61,
        preload_pa: 0.0,
        elastic_modulus_pa: 2.0e11,
        poisson_ratio: 0.3,
    }
}

fn paper_hydraulics() -> Hydraulics {
    Hydraulics {
        geometry: Geometry {
            rod_diameter_m: 0.028,
            piston_diameter_m: 0.0698,
        },
        orifice: Orifice {
            diameter_m: 0.002,
            discharge_coefficient: 0.72,
            transition_reynolds: 0.0,
        },
        valves: Valves {
            piston_extension: published(0.016, 0.029, 1.36e-11, 0.2169),
            piston_compression: published(0.016, 0.029, 1.37e-11, 0.2000),
            foot_compression: published(0.005, 0.011, 1.446e-12, 0.8265),
        },
        leakage: None,
        relief: None,
        reservoir: None,
        seal: None,
        two_chamber: None,
        oil: Oil {
            density_kg_per_m3: 860.0,
            thermal_expansion_per_k: 0.0,
            temperature_c: 45.0,
            viscosity_40c_m2_per_s: 15e-6,
            viscosity_100c_m2_per_s: 3.8e-6,
            column: None,
        },
    }
}

fn mount(stiffness: f64, clearance: f64) -> Mount {
    Mount {
        stiffness_n_per_m: stiffness,
        seat_stiffness_n_per_m: None,
        clearance_m: clearance,
    }
}

/// The damper exactly as published.
pub fn paper() -> DamperParameters {
    DamperParameters {
        element: Element::Physical(paper_hydraulics()),
        mount: mount(6e6, 0.0),
        limits: Limits::default(),
    }
}

/// The paper's valves behind 1 mm of clearance.
pub fn paper_with_clearance() -> DamperParameters {
    DamperParameters {
        mount: mount(8e6, 1e-3),
        ..paper()
    }
}

/// The reduced vertical damper of the paper's vehicle model.
pub fn reduced_vertical() -> DamperParameters {
    reduced(120e3, 0.03, 8e6, 1e-3)
}

/// A reduced element.
pub fn reduced(damping: f64, saturation: f64, stiffness: f64, clearance: f64) -> DamperParameters {
    DamperParameters {
        element: Element::Reduced(Reduced {
            damping_n_s_per_m: damping,
            saturation_velocity_m_per_s: saturation,
        }),
        mount: mount(stiffness, clearance),
        limits: Limits {
            force_n: 1e6,
            rate_m_per_s: 100.0,
            ..Limits::default()
        },
    }
}

/// A damper with all in-service terms.
pub fn in_service(two_chamber: bool) -> DamperParameters {
    let mut hydraulics = paper_hydraulics();
    hydraulics.orifice.transition_reynolds = 100.0;
    hydraulics.valves.piston_extension.preload_pa = 0.5e6;
    hydraulics.valves.piston_compression.preload_pa = 0.5e6;
    hydraulics.valves.foot_compression.preload_pa = 0.3e6;
    hydraulics.leakage = Some(Leakage {
        radial_clearance_m: 30e-6,
        length_m: 0.03,
        eccentricity_ratio: 0.5,
    });
    hydraulics.relief = Some(Relief {
        opening_pressure_pa: 5e6,
        area_gradient_m2_per_pa: 5e-12,
        discharge_coefficient: 0.65,
    });
    hydraulics.reservoir = Some(Reservoir {
        fill_pressure_pa: 0.1e6,
        gas_volume_m3: 0.5e-3,
        fill_temperature_c: 20.0,
        rod_insertion_m: 0.02,
    });
    hydraulics.seal = Some(Seal { friction_n: 150.0 });
    hydraulics.two_chamber = two_chamber.then_some(TwoChamber {
        vapour_pressure_pa: -0.9e5,
    });
    hydraulics.oil.thermal_expansion_per_k = 7e-4;
    hydraulics.oil.density_kg_per_m3 = 870.0;
    hydraulics.oil.column = Some(OilColumn {
        bulk_modulus_pa: 1.5e9,
        rod_side_volume_m3: 0.5e-3,
        piston_side_volume_m3: 0.6e-3,
        air_fraction: 0.005,
        polytropic_exponent: 1.0,
    });
    DamperParameters {
        element: Element::Physical(hydraulics),
        mount: Mount {
            stiffness_n_per_m: 8e6,
            seat_stiffness_n_per_m: Some(40e6),
            clearance_m: 1e-3,
        },
        limits: Limits::default(),
    }
}
