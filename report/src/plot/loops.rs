//! Force loops: force over displacement and over velocity, side by side.

use plotters::style::RGBColor;

use super::curves::Curve;
use super::sheet::{Panel, Scale};
use dashpot_testbench::bench_test::Cycle;

/// Returns two panels: force (kN) over displacement (mm) and over velocity (m/s). Force is positive when it resists
/// extension.
pub fn panels(displacement: Vec<Curve>, velocity: Vec<Curve>) -> Vec<Panel> {
    let panel = |x: &str, curves| Panel {
        title: String::new(),
        x_label: x.into(),
        y_label: "force, kN".into(),
        legend: None,
        sides: true,
        x_scale: Scale::Linear,
        scale: Scale::Linear,
        keeps_to_values: false,
        y_range: None,
        curves,
    };
    vec![
        panel("displacement, mm", displacement),
        panel("velocity, m/s", velocity),
    ]
}

/// Returns two closed curves of a settled cycle: force over displacement and force over velocity, for the two
/// [`panels`].
pub fn of_cycle(name: &str, colour: RGBColor, cycle: &Cycle) -> (Curve, Curve) {
    let forces = cycle.forces_n.iter().map(|force| force * 1e-3);
    let close = |abscissas: Vec<f64>| {
        let points = abscissas.into_iter().zip(forces.clone());
        let closed = points.clone().chain(points.take(1));
        Curve::new(name, colour, closed.collect::<Vec<_>>())
    };
    let displacements = cycle.displacements_m.iter().map(|x| x * 1e3);
    (
        close(displacements.collect()),
        close(cycle.velocities_m_per_s()),
    )
}
