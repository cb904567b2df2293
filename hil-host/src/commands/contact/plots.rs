//! SVG plots of a wheel-rail pair: contact points, rolling radius and angle, conicity.

use dashpot_rail::contact::{Pair, RigidContact};
use dashpot_rail::indices::RollingRadiusDifference;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use dashpot_report::DrawError;
use dashpot_report::plot::style::{
    FINE, FIRST, INK, LEFT, LINE, RIGHT, SECOND, axes, draw, extent, failed, letters,
};

/// Draws the wheel over the rail with lines between the contact points for each lateral shift in `contacts`.
///
/// `side` is 0 for the left wheel, which is drawn as its mirror image, and 1 for the right wheel.
///
/// # Errors
/// The drawing fails.
pub fn contact_points(
    pair: &Pair,
    contacts: &[RigidContact],
    side: usize,
) -> Result<String, DrawError> {
    /// Height by which the wheel is lifted in the drawing to leave space for the lines, mm.
    const LIFT: f64 = 30.0;
    /// Width and height of margins, labels and title, pixels.
    const MARGINS: [f64; 2] = [88.0, 90.0];
    let datum = pair.installation().datum_offset_m() * 1e3;
    let wheel = || {
        pair.wheel()
            .points()
            .iter()
            .map(move |p| (p.y_m * 1e3 + datum, LIFT - p.z_m * 1e3))
    };
    let rail = || {
        pair.rail()
            .points()
            .iter()
            .map(|p| (p.y_m * 1e3, -p.z_m * 1e3))
    };
    let x = extent(wheel().chain(rail()).map(|p| p.0));
    let y = extent(wheel().chain(rail()).map(|p| p.1));
    // Use the same scale on both axes.
    let width = 1000;
    let scale = (f64::from(width) - MARGINS[0]) / (x.end - x.start);
    let height = (scale * (y.end - y.start) + MARGINS[1]).round() as u32;
    draw(width, height, |area| {
        let title = format!(
            "Contact points, {}: {} on {}",
            ["left side as its mirror image", "right side"][side],
            pair.wheel().name(),
            pair.rail().name()
        );
        let mut chart = axes!(
            area,
            title,
            x,
            y,
            "lateral position from the track centre, mm (wheelset centred)",
            "height, mm (wheel lifted by 30 mm)",
            (0, 0)
        );
        let max_shift = contacts
            .iter()
            .fold(1e-9, |max: f64, c| max.max(c.lateral_m.abs()));
        for contact in contacts {
            let side = &contact.sides[side];
            let relative_shift = contact.lateral_m / max_shift;
            let colour = if relative_shift < -1e-9 {
                LEFT
            } else if relative_shift > 1e-9 {
                RIGHT
            } else {
                INK
            };
            let style = colour
                .mix(0.45 + 0.55 * relative_shift.abs())
                .stroke_width(FINE);
            let top = (side.wheel_y_m * 1e3 + datum, LIFT - side.wheel_z_m * 1e3);
            let rail_depth = pair.rail().at(side.track_y_m).z_m;
            let bottom = (side.track_y_m * 1e3, -rail_depth * 1e3);
            chart
                .draw_series(LineSeries::new([top, bottom], style))
                .map_err(failed)?;
            chart
                .draw_series([top, bottom].map(|p| Circle::new(p, 2 * FINE, colour.filled())))
                .map_err(failed)?;
        }
        let outline = INK.stroke_width(LINE);
        chart
            .draw_series(LineSeries::new(wheel(), outline))
            .map_err(failed)?;
        chart
            .draw_series(LineSeries::new(rail(), outline))
            .map_err(failed)?;
        let mut last_label = (f64::MAX, f64::MAX);
        for contact in contacts {
            let shift = contact.lateral_m * 1e3;
            let side = &contact.sides[side];
            let at = (side.wheel_y_m * 1e3 + datum, LIFT - side.wheel_z_m * 1e3);
            let whole = (shift - shift.round()).abs() < 1e-6;
            if !whole || (at.0 - last_label.0).hypot(at.1 - last_label.1) < 2.4 {
                continue;
            }
            last_label = at;
            // Place the number next to the wheel surface, along its normal.
            let (across, up) = (side.slope.atan().sin(), side.slope.atan().cos());
            let away = 15.0 * f64::from(FINE);
            let offset = ((away * across) as i32, (-away * up) as i32);
            let text = if shift.round() == 0.0 {
                "0".to_owned()
            } else {
                format!("{shift:+.0}")
            };
            let style = letters(13, &INK).pos(Pos::new(HPos::Center, VPos::Center));
            chart
                .draw_series(std::iter::once(
                    EmptyElement::at(at) + Text::new(text, offset, style),
                ))
                .map_err(failed)?;
        }
        // The explanation is inside the rail head, where every profile leaves space.
        let middle = 0.5
            * (rail().map(|p| p.0).fold(f64::MAX, f64::min)
                + rail().map(|p| p.0).fold(f64::MIN, f64::max));
        for (row, (note, colour)) in [
            ("lines connect the points in contact,", &INK),
            ("numbers: lateral shift of the wheelset, mm", &INK),
            ("shifted to the right (+)", &RIGHT),
            ("shifted to the left (-)", &LEFT),
        ]
        .into_iter()
        .enumerate()
        {
            let style = letters(14, colour).pos(Pos::new(HPos::Center, VPos::Top));
            let below = 22 * row as i32 * FINE as i32;
            chart
                .draw_series(std::iter::once(
                    EmptyElement::at((middle, -14.0)) + Text::new(note, (0, below), style),
                ))
                .map_err(failed)?;
        }
        Ok(())
    })
}

/// Draws the rolling radius difference and the contact angles over the lateral shift.
///
/// # Errors
/// The drawing fails.
pub fn rolling_radius(profiles: &str, contacts: &[RigidContact]) -> Result<String, DrawError> {
    let title = format!("Rolling radius difference, right minus left: {profiles}");
    draw(1000, 760, |area| {
        let (upper, lower) = area.split_vertically(380 * FINE);
        let shift = |c: &RigidContact| c.lateral_m * 1e3;
        let x = extent(contacts.iter().map(shift));
        let difference = |c: &RigidContact| c.rolling_radius_difference_m() * 1e3;
        let mut chart = axes!(
            &upper,
            title,
            x.clone(),
            extent(contacts.iter().map(difference)),
            "lateral shift at the top of the rails, mm (positive to the right)",
            "difference, mm",
            (0, 0)
        );
        chart
            .draw_series(LineSeries::new(
                contacts.iter().map(|c| (shift(c), difference(c))),
                FIRST.stroke_width(LINE),
            ))
            .map_err(failed)?;
        let angle = |c: &RigidContact, side: usize| -c.sides[side].slope.atan().to_degrees();
        let both = contacts.iter().flat_map(|c| [angle(c, 0), angle(c, 1)]);
        let mut chart = axes!(
            &lower,
            "Contact angle relative to the track plane",
            x,
            extent(both),
            "lateral shift at the top of the rails, mm (positive to the right)",
            "angle, degrees",
            (0, 0)
        );
        for (side, name, colour) in [(1, "right wheel", RIGHT), (0, "left wheel", LEFT)] {
            chart
                .draw_series(LineSeries::new(
                    contacts.iter().map(|c| (shift(c), angle(c, side))),
                    colour.stroke_width(LINE),
                ))
                .map_err(failed)?
                .label(name)
                .legend(move |(x, y)| {
                    PathElement::new(
                        [(x, y), (x + 22 * FINE as i32, y)],
                        colour.stroke_width(LINE),
                    )
                });
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperMiddle)
            .label_font(letters(14, &INK))
            .legend_area_size(30 * FINE)
            .margin(8 * FINE)
            .background_style(WHITE.mix(0.9))
            .border_style(INK.mix(0.3).stroke_width(FINE))
            .draw()
            .map_err(failed)
    })
}

/// Draws the equivalent conicity over the amplitude, with the value at 3 mm as text: of the rigid wheelset and, if
/// given, of the wheelset on elastic patches.
///
/// # Errors
/// The drawing fails.
pub fn conicity(
    profiles: &str,
    rigid: &RollingRadiusDifference,
    elastic: Option<&RollingRadiusDifference>,
    radius_m: f64,
    reach_m: f64,
) -> Result<String, DrawError> {
    let title = format!("Equivalent conicity (EN 15302): {profiles}");
    draw(1000, 620, |area| {
        let points = |rolling: &RollingRadiusDifference| -> Vec<(f64, f64)> {
            (1..=400)
                .map(|i| reach_m * f64::from(i) / 400.0)
                .filter(|amplitude_m| *amplitude_m >= 0.5e-3)
                .filter_map(|amplitude_m| {
                    let value = rolling.equivalent_conicity(amplitude_m, radius_m)?;
                    Some((amplitude_m * 1e3, value))
                })
                .collect()
        };
        let curves: Vec<_> = [
            (Some(rigid), "rigid", &FIRST),
            (elastic, "elastic", &SECOND),
        ]
        .into_iter()
        .filter_map(|(rolling, name, colour)| {
            let rolling = rolling?;
            Some((rolling, points(rolling), name, colour))
        })
        .collect();
        let heights = curves
            .iter()
            .flat_map(|curve| &curve.1)
            .map(|point| point.1);
        let highest = heights.fold(0.05, f64::max);
        let mut chart = axes!(
            area,
            title,
            0.0..reach_m * 1e3,
            0.0..1.08 * highest,
            "amplitude of the lateral shift, mm",
            "equivalent conicity, dimensionless",
            (0, 1)
        );
        for (rolling, points, name, colour) in &curves {
            chart
                .draw_series(LineSeries::new(
                    points.iter().copied(),
                    colour.stroke_width(LINE),
                ))
                .map_err(failed)?;
            let Some(value) = rolling.equivalent_conicity(3e-3, radius_m) else {
                continue;
            };
            // The label of the higher curve is above it, that of the lower one below it.
            let others = curves
                .iter()
                .filter_map(|curve| curve.0.equivalent_conicity(3e-3, radius_m));
            let is_highest = others.fold(f64::MIN, f64::max) <= value;
            let fine = FINE as i32;
            let offset = if is_highest { -26 } else { 10 };
            let text = if elastic.is_some() {
                format!("{name}: {value:.3} at 3 mm")
            } else {
                format!("{value:.3} at 3 mm")
            };
            chart
                .draw_series(std::iter::once(
                    EmptyElement::at((3.0, value))
                        + Circle::new((0, 0), 4 * fine, colour.filled())
                        + Text::new(text, (-4 * fine, offset * fine), letters(16, colour)),
                ))
                .map_err(failed)?;
        }
        Ok(())
    })
}
