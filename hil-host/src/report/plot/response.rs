//! Frequency responses: dynamic stiffness, loss angle and damping over frequency.

use plotters::style::RGBColor;

use super::curves::Curve;
use super::sheet::{Panel, Scale};
use crate::report::page::panel;
use crate::study::response::Response;

/// The panels of dynamic stiffness (MN/m), loss angle (degrees) and damping (kN s/m) without curves yet.
pub(crate) fn panels() -> [Panel; 3] {
    [
        "dynamic stiffness, MN/m",
        "loss angle, °",
        "damping, kN s/m",
    ]
    .map(|y| Panel {
        x_scale: Scale::Decades,
        ..panel("frequency, Hz", y, Vec::new())
    })
}

/// A response as a curve of each panel.
pub(crate) fn of(name: &str, colour: RGBColor, responses: &[Response]) -> [Curve; 3] {
    let curve = |value: fn(&Response) -> f64| {
        let points = responses.iter().map(|r| (r.frequency_hz, value(r)));
        Curve::new(name, colour, points)
    };
    [
        curve(|r| r.stiffness_n_per_m() * 1e-6),
        // A number that is none parts a line.
        curve(|r| r.loss_angle_deg().unwrap_or(f64::NAN)),
        curve(|r| r.damping_n_s_per_m() * 1e-3),
    ]
}
