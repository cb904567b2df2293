//! Plausible range and default prior of each damper parameter; the range gives the default bounds of a calibration.

use super::prior::Prior;

/// Default bounds, scale and prior of a parameter.
pub(super) struct Plausible {
    pub(super) bounds: [f64; 2],
    /// True for a logarithmic scale, false for a linear one.
    pub(super) by_ratio: bool,
    pub(super) prior: Option<Prior>,
}

const fn ratio(min: f64, max: f64) -> Plausible {
    Plausible {
        bounds: [min, max],
        by_ratio: true,
        prior: None,
    }
}

const fn difference(min: f64, max: f64) -> Plausible {
    Plausible {
        by_ratio: false,
        ..ratio(min, max)
    }
}

const fn known(mean: f64, standard_deviation: f64, plausible: Plausible) -> Plausible {
    Plausible {
        prior: Some(Prior {
            mean,
            standard_deviation,
        }),
        ..plausible
    }
}

/// Returns the plausible range of `key` in the table `table` of a damper file; `None` for parameters that are measured
/// on the part, not calibrated from forces.
///
/// Sources of the priors: a sharp edge contracts a jet to `pi/(pi + 2) = 0.611` (Kirchhoff); a short bore has a
/// discharge coefficient of 0.6 to 0.8 (Idelchik, Handbook of Hydraulic Resistance); mineral oil has 870 kg/m3 at 15
/// degC and a bulk modulus of 1.3 to 1.8 GPa; spring steel has 200 GPa.
pub(super) fn plausible(table: &str, key: &str) -> Option<Plausible> {
    let is_valve = table.starts_with("valves.");
    Some(match (table, key) {
        ("orifice", "diameter_m") => ratio(1e-4, 2e-2),
        ("orifice", "discharge_coefficient") => known(0.7, 0.1, ratio(0.3, 1.0)),
        ("orifice", "transition_reynolds") => ratio(1.0, 1e4),
        (_, "edge_compliance_m_per_pa") if is_valve => ratio(1e-14, 1e-9),
        (_, "equivalent_pressure_factor") if is_valve => ratio(1e-2, 2.0),
        (_, "discharge_coefficient") if is_valve || table == "relief" => {
            known(0.611, 0.06, ratio(0.3, 1.0))
        }
        (_, "preload_pa") if is_valve => difference(0.0, 1e7),
        (_, "elastic_modulus_pa") if is_valve => known(2e11, 5e9, ratio(1.5e11, 2.5e11)),
        ("leakage", "radial_clearance_m") => ratio(1e-6, 3e-4),
        ("leakage", "length_m") => ratio(1e-3, 0.2),
        ("leakage", "eccentricity_ratio") => difference(0.0, 1.0),
        ("relief", "opening_pressure_pa") => ratio(1e5, 3e7),
        ("relief", "area_gradient_m2_per_pa") => ratio(1e-14, 1e-9),
        ("reservoir", "fill_pressure_pa") => difference(0.0, 1e6),
        ("seal", "friction_n") => difference(0.0, 2e3),
        ("oil", "density_kg_per_m3") => known(870.0, 15.0, ratio(780.0, 950.0)),
        ("oil", "temperature_c") => difference(-40.0, 100.0),
        ("oil", "viscosity_40c_m2_per_s") => ratio(3e-6, 1e-4),
        ("oil", "viscosity_100c_m2_per_s") => ratio(1e-6, 3e-5),
        ("oil.column", "bulk_modulus_pa") => known(1.5e9, 2e8, ratio(8e8, 2.5e9)),
        ("oil.column", "air_fraction") => ratio(1e-5, 0.2),
        ("oil.column", "rod_side_volume_m3" | "piston_side_volume_m3") => ratio(1e-5, 1e-2),
        ("mount", "stiffness_n_per_m" | "seat_stiffness_n_per_m") => ratio(1e5, 1e9),
        ("mount", "clearance_m") => difference(0.0, 1e-2),
        ("reduced", "damping_n_s_per_m") => ratio(1e3, 1e7),
        ("reduced", "saturation_velocity_m_per_s") => ratio(1e-3, 2.0),
        ("limits", "force_n") => ratio(1e3, 1e6),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashpot_files::damper::{KeyedParameters, PRESETS, load, range};

    #[test]
    fn plausible_ranges_are_allowed_and_contain_the_presets() {
        let mut found = 0;
        for (preset, _) in PRESETS {
            let damper = KeyedParameters::new(preset, &load(preset, &[]).unwrap()).unwrap();
            for key in damper.keys() {
                let (table, last) = key.rsplit_once('.').unwrap();
                let Some(plausible) = plausible(table, last) else {
                    continue;
                };
                let allowed = range(&key).unwrap();
                let [min, max] = plausible.bounds;
                assert!(allowed.contains(min) && allowed.contains(max), "{key}");
                if let Some(prior) = plausible.prior {
                    assert!((min..max).contains(&prior.mean), "{key}");
                }
                // A parameter may also be 0: this is how presets turn parts off.
                let parameter = damper.number(&key).unwrap();
                assert!(
                    parameter == 0.0 || (min..=max).contains(&parameter),
                    "{key}"
                );
                found += 1;
            }
        }
        assert!(found > 60, "{found}");
    }
}
