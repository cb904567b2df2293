//! Figure of docs/other-codes.md: histories of both codes on top of each other, with their difference below, as SVG.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::histories::Histories;

const INK: RGBColor = RGBColor(38, 50, 56);
const ORVD: RGBColor = RGBColor(239, 138, 0);
const DASHPOT: RGBColor = RGBColor(21, 101, 192);
/// Enlargement of the drawing: the backend rounds to whole units, and curves stay smooth at a larger scale.
const FINE: u32 = 4;
const SIZE: (u32, u32) = (980, 900);
/// Part of the runs that is shown, s.
const SHOWN_S: Range<f64> = 8.0..14.0;
/// Heights of the panels: histories, then their difference, for two quantities.
const HEIGHTS: [f64; 4] = [0.3, 0.2, 0.3, 0.2];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A curve: name, colour, width, points.
type Curve = (&'static str, RGBColor, u32, Vec<(f64, f64)>);

/// Draws the first wheelset's lateral displacement and yaw, one column for each pair of runs (ORVD's, Dashpot's).
pub fn draw(columns: [(&str, &[Histories; 2]); 2]) -> String {
    let (width, height) = (SIZE.0 * FINE, SIZE.1 * FINE);
    let mut text = String::new();
    {
        let sheet = SVGBackend::with_string(&mut text, (width, height)).into_drawing_area();
        sheet.fill(&WHITE).unwrap();
        let (left, right) = sheet.split_horizontally(width / 2);
        for (area, (speed, runs)) in [left, right].iter().zip(columns) {
            draw_column(area, speed, runs);
        }
        sheet.present().unwrap();
    }
    let drawn = format!("width=\"{width}\" height=\"{height}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", SIZE.0, SIZE.1);
    text.replacen(&drawn, &shown, 1)
}

fn draw_column(area: &Area<'_>, speed: &str, [orvd, dashpot]: &[Histories; 2]) {
    let total = f64::from(SIZE.1 * FINE);
    let breaks: Vec<i32> = HEIGHTS
        .iter()
        .scan(0.0, |sum, height| {
            *sum += height * total;
            Some(*sum as i32)
        })
        .collect();
    let areas = area.split_by_breakpoints([] as [i32; 0], &breaks[..3]);
    let quantities = [
        (
            "lateral displacement",
            "mm",
            [orvd, dashpot].map(|run| &run.lateral_mm[0]),
        ),
        ("yaw", "mrad", [orvd, dashpot].map(|run| &run.yaw_mrad[0])),
    ];
    for ((name, unit, [a, b]), areas) in quantities.into_iter().zip(areas.chunks(2)) {
        let points = |values: &mut dyn Iterator<Item = f64>| -> Vec<(f64, f64)> {
            let times = orvd.time_s.iter().copied();
            times
                .zip(values)
                .filter(|(time_s, _)| SHOWN_S.contains(time_s))
                .collect()
        };
        let both = [
            ("ORVD", ORVD, 4, points(&mut a.iter().copied())),
            ("Dashpot", DASHPOT, 1, points(&mut b.iter().copied())),
        ];
        draw_panel(
            &areas[0],
            &format!("{speed}: {name} of wheelset 1"),
            unit,
            &both,
        );
        let difference = points(&mut a.iter().zip(b).map(|(a, b)| b - a));
        draw_panel(&areas[1], "difference", unit, &[("", INK, 1, difference)]);
    }
}

fn draw_panel(area: &Area<'_>, title: &str, unit: &str, curves: &[Curve]) {
    let values = || {
        curves
            .iter()
            .flat_map(|curve| curve.3.iter().map(|point| point.1))
    };
    let letters = |size: u32| ("sans-serif", size * FINE).into_font().color(&INK);
    let mut chart = ChartBuilder::on(area)
        .margin(8 * FINE)
        .caption(title, letters(15))
        .x_label_area_size(34 * FINE)
        .y_label_area_size(58 * FINE)
        .build_cartesian_2d(SHOWN_S, extent(values()))
        .unwrap();
    chart
        .configure_mesh()
        .x_desc("time, s")
        .y_desc(unit)
        .x_label_formatter(&short)
        .y_label_formatter(&short)
        .y_labels(6)
        .label_style(letters(12))
        .axis_desc_style(letters(13))
        .light_line_style(WHITE)
        .bold_line_style(INK.mix(0.15).stroke_width(FINE))
        .draw()
        .unwrap();
    for (name, colour, width, points) in curves {
        let style = colour.stroke_width(width * FINE);
        let drawn = chart
            .draw_series(LineSeries::new(points.iter().copied(), style))
            .unwrap();
        if !name.is_empty() {
            drawn
                .label(*name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18 * FINE as i32, y)], style));
        }
    }
    if curves.len() > 1 {
        chart
            .configure_series_labels()
            .label_font(letters(12))
            .legend_area_size(24 * FINE)
            .margin(4 * FINE)
            .background_style(WHITE.mix(0.85))
            .border_style(INK.mix(0.3).stroke_width(FINE))
            .position(SeriesLabelPosition::LowerLeft)
            .draw()
            .unwrap();
    }
}

/// Formats a number without superfluous digits, and zero without a sign.
fn short(number: &f64) -> String {
    format!("{}", (number * 1e3).round() / 1e3 + 0.0)
}

/// Range of the numbers, with a margin.
fn extent(numbers: impl Iterator<Item = f64> + Clone) -> Range<f64> {
    let min = numbers.clone().fold(f64::MAX, f64::min);
    let max = numbers.fold(f64::MIN, f64::max);
    let margin = 0.06 * (max - min);
    min - margin..max + margin
}
