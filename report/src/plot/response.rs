//! Frequency responses: dynamic stiffness, loss angle and damping.

use plotters::style::RGBColor;

use super::curves::Curve;
use super::sheet::panel;
use super::sheet::{Panel, Scale};
use dashpot_testbench::response::Response;

/// Minimum loss angle (degrees) for showing damping on a logarithmic scale; below it the damper is practically a
/// spring.
const MIN_LOSS_ANGLE_DEG: f64 = 0.1;

/// Returns empty panels for dynamic stiffness (MN/m), loss angle (degrees) and damping (kN s/m). `scale` is the
/// vertical scale of stiffness and damping; the loss angle is always linear.
pub fn panels(scale: Scale) -> [Panel; 3] {
    let axes = |y: &str, scale| Panel {
        x_scale: Scale::Decades,
        scale,
        ..panel("frequency, Hz", y, Vec::new())
    };
    [
        axes("dynamic stiffness, MN/m", scale),
        axes("loss angle, °", Scale::Linear),
        axes("damping, kN s/m", scale),
    ]
}

/// Returns a response as one curve for each panel. Curves have gaps where the loss angle is undefined or too small for
/// a logarithmic scale.
pub fn of(name: &str, colour: RGBColor, responses: &[Response], scale: Scale) -> [Curve; 3] {
    let curve = |value: &dyn Fn(&Response) -> Option<f64>| {
        let points = responses.iter();
        let points = points.map(|r| (r.frequency_hz, value(r).unwrap_or(f64::NAN)));
        Curve::new(name, colour, points)
    };
    let is_shown = |min_deg: f64| {
        move |r: &Response| match scale {
            Scale::Linear => true,
            Scale::Decades => r.loss_angle_deg().is_some_and(|angle| angle >= min_deg),
        }
    };
    let (has_force, has_loss) = (is_shown(f64::MIN), is_shown(MIN_LOSS_ANGLE_DEG));
    [
        curve(&|r| has_force(r).then(|| r.stiffness_n_per_m() * 1e-6)),
        curve(&|r| r.loss_angle_deg()),
        curve(&|r| has_loss(r).then(|| r.damping_n_s_per_m() * 1e-3)),
    ]
}
