//! Description of the dampers on the page, generated from their parameters.

use std::f64::consts::PI;

use dashpot_core::parameters::{DamperParameters, Element, Hydraulics};
use maud::{Markup, html};

use super::results::Bench;
use dashpot_testbench::{TestbenchError, shim_valves};

/// Formats a number with up to four decimals, without trailing zeros.
fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn hydraulics(bench: &Bench) -> Option<&Hydraulics> {
    match &bench.parameters.element {
        Element::Physical(hydraulics) => Some(hydraulics),
        _ => None,
    }
}

/// Describes the design of the first damper and the additions of the others.
pub(super) fn damper(benches: &[Bench]) -> Markup {
    let built = benches.first().and_then(hydraulics).map(|hydraulics| {
        format!(
            ", {} mm piston and {} mm rod. A constant orifice of {} mm in the piston is open in both directions",
            number(hydraulics.geometry.piston_diameter_m * 1e3),
            number(hydraulics.geometry.rod_diameter_m * 1e3),
            number(hydraulics.orifice.diameter_m * 1e3)
        )
    });
    html! {
        p {
            "The secondary vertical damper of a locomotive: a twin-tube hydraulic damper" (built.unwrap_or_default())
            "; three packs of thin steel shims, one for extension and two for compression, bend open under oil \
             pressure. In series with them are rubber bushes and, in service, the oil column with its entrained air, \
             the seats and a clearance."
        }
        p {
            @for bench in benches {
                @let terms = in_service_terms(&bench.parameters).join(", ");
                b { (bench.damper) }
                @if terms.is_empty() {
                    " is exactly the published damper, without clearance and without in-service terms. "
                } @else {
                    " adds " (terms) ". "
                }
            }
            "Displacement and force are positive in extension; all forces are computed."
        }
    }
}

/// Lists the active terms that the published equations do not contain.
fn in_service_terms(parameters: &DamperParameters) -> Vec<String> {
    let mut terms = Vec::new();
    let mount = &parameters.mount;
    if mount.clearance_m > 0.0 {
        terms.push(format!("{} mm clearance", number(mount.clearance_m * 1e3)));
    }
    if let Some(stiffness) = mount.seat_stiffness_n_per_m {
        terms.push(format!("seats of {} MN/m", number(stiffness * 1e-6)));
    }
    let Element::Physical(hydraulics) = &parameters.element else {
        return terms;
    };
    let valves = &hydraulics.valves;
    let packs = [
        &valves.piston_extension,
        &valves.piston_compression,
        &valves.foot_compression,
    ];
    let preload_pa = packs.map(|valve| valve.preload_pa);
    if preload_pa.iter().any(|preload_pa| *preload_pa > 0.0) {
        let [extension, compression, foot] = preload_pa.map(|pa| number(pa * 1e-6));
        terms.push(format!(
            "valve preloads of {extension}, {compression} (piston) and {foot} MPa (foot)"
        ));
    }
    if let Some(leakage) = &hydraulics.leakage {
        let gap_um = number(leakage.radial_clearance_m * 1e6);
        terms.push(format!("leakage through a piston gap of {gap_um} µm"));
    }
    if let Some(relief) = &hydraulics.relief {
        let opening_mpa = number(relief.opening_pressure_pa * 1e-6);
        terms.push(format!("a relief valve that opens at {opening_mpa} MPa"));
    }
    if let Some(seal) = &hydraulics.seal {
        let friction_n = number(seal.friction_n);
        terms.push(format!("seal friction of {friction_n} N"));
    }
    if hydraulics.reservoir.is_some() {
        terms.push("reservoir pressure".into());
    }
    if hydraulics.orifice.transition_reynolds > 0.0 {
        terms.push("a laminar orifice at low flow".into());
    }
    if let Some(column) = &hydraulics.oil.column {
        let air_percent = number(column.air_fraction * 1e2);
        terms.push(format!(
            "a compressible oil column with {air_percent} % entrained air"
        ));
    }
    terms
}

/// Describes each relief valve with its opening pressure and the forces `P A + F_c` at which it opens.
pub(super) fn relief(benches: &[Bench]) -> Markup {
    html! {
        @for bench in benches {
            @if let Some((opening_mpa, [extension_kn, compression_kn])) = relief_opening(bench) {
                " The relief valve of " b { (bench.damper) } " opens at " (number(opening_mpa)) " MPa: "
                (format!("{extension_kn:.0}")) " kN in extension, " (format!("{compression_kn:.0}"))
                " kN in compression."
            }
        }
    }
}

/// Returns the opening pressure (MPa) of the relief valve and the forces (kN) in extension and compression.
fn relief_opening(bench: &Bench) -> Option<(f64, [f64; 2])> {
    let hydraulics = hydraulics(bench)?;
    let relief = hydraulics.relief.as_ref()?;
    let area_m2 = |diameter_m: f64| 0.25 * PI * diameter_m * diameter_m;
    let piston_m2 = area_m2(hydraulics.geometry.piston_diameter_m);
    let annulus_m2 = piston_m2 - area_m2(hydraulics.geometry.rod_diameter_m);
    let friction_n = hydraulics.seal.as_ref().map_or(0.0, |seal| seal.friction_n);
    let force_kn = |area_m2| 1e-3 * (relief.opening_pressure_pa * area_m2 + friction_n);
    Some((
        relief.opening_pressure_pa * 1e-6,
        [annulus_m2, piston_m2].map(force_kn),
    ))
}

/// Returns the first erratum of the source paper, with values of the first damper, which is the damper of the paper.
///
/// # Errors
/// See [`shim_valves::erratum`].
pub(super) fn erratum(benches: &[Bench]) -> Result<String, TestbenchError> {
    match benches.first().and_then(hydraulics) {
        Some(paper) => shim_valves::erratum(paper),
        None => Ok(String::new()),
    }
}
