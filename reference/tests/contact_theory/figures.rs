//! Figures of docs/contact.md: curves of exact theory and of this project, as SVG.

use std::ops::Range;

use dashpot_rail::creep::{
    CreepLaw, Creepage, Fastsim, KalkerBook, KalkerTable, LoadedContact, Polach, ShenHedrickElkins,
};
use dashpot_reference::rolling_contact::RollingContact;
use plotters::chart::SeriesLabelPosition::{self, LowerLeft, UpperLeft, UpperRight};
use plotters::prelude::*;

use crate::climbing::{FRICTIONS, LAWS, YAWS_MRAD, climbing};
use crate::shifts::{Shift, Wheel, shifts, steering};

const COLOURS: [RGBColor; 5] = [
    RGBColor(38, 50, 56),
    RGBColor(21, 101, 192),
    RGBColor(239, 138, 0),
    RGBColor(198, 40, 40),
    RGBColor(46, 125, 50),
];
/// Enlargement of the drawing: the backend rounds to whole units, and curves stay smooth at a larger scale.
const FINE: u32 = 4;

/// One curve: its name, its colour, whether its points are marked, its points.
struct Curve {
    name: String,
    colour: RGBColor,
    marked: bool,
    points: Vec<(f64, f64)>,
}

/// A panel of a figure.
struct Panel {
    title: &'static str,
    x: &'static str,
    y: &'static str,
    /// Position of the legend, in a corner without curves.
    legend: SeriesLabelPosition,
    curves: Vec<Curve>,
}

/// File names and texts of all figures.
pub fn figures() -> Vec<(&'static str, String)> {
    vec![
        ("shift.svg", draw(&over_the_shift())),
        ("climbing.svg", draw(&over_the_yaw())),
        ("creep.svg", draw(&over_the_creepage())),
    ]
}

fn over_the_shift() -> Vec<Panel> {
    let panel = |title, y, legend, value: fn(&Wheel) -> f64| {
        let points = |side: fn(&Shift) -> &Wheel| {
            let shifts = shifts().iter().filter(|shift| shift.lateral_mm < 6.6);
            shifts
                .map(|shift| (shift.lateral_mm, value(side(shift))))
                .collect()
        };
        Panel {
            title,
            x: "lateral shift, mm",
            y,
            legend,
            curves: exact_and_found(points(|shift| &shift.exact), points(|shift| &shift.found)),
        }
    };
    let steering = steering();
    let curve = |k: usize| steering.iter().map(|(x, y)| (*x, 1e-3 * y[k])).collect();
    vec![
        panel(
            "Place of contact from the track centre",
            "mm",
            LowerLeft,
            |wheel| wheel.place_mm,
        ),
        panel("Contact angle", "mrad", UpperLeft, |wheel| {
            1e3 * wheel.angle_rad
        }),
        Panel {
            title: "Steering force, left less right",
            x: "lateral shift, mm",
            y: "kN",
            legend: UpperLeft,
            curves: exact_and_found(curve(0), curve(1)),
        },
        panel("Lateral force on the rail", "kN", UpperLeft, |wheel| {
            1e-3 * wheel.lateral_n
        }),
    ]
}

fn over_the_yaw() -> Vec<Panel> {
    let titles = [
        "Y/Q on the flange, friction 0.1",
        "friction 0.3",
        "friction 0.5",
    ];
    let panels = FRICTIONS.iter().zip(titles).zip(climbing());
    panels
        .map(|((_, title), by_yaw)| Panel {
            title,
            x: "yaw, mrad (towards the rail)",
            y: "Y/Q",
            legend: UpperRight,
            curves: (0..LAWS.len())
                .map(|law| Curve {
                    name: LAWS[law].to_owned(),
                    colour: COLOURS[law],
                    marked: law == 0,
                    points: YAWS_MRAD
                        .iter()
                        .zip(by_yaw)
                        .map(|(x, y)| (*x, y[law]))
                        .collect(),
                })
                .collect(),
        })
        .collect()
}

/// Lateral force as a function of lateral creepage with spin, the case in which the laws differ most.
fn over_the_creepage() -> Vec<Panel> {
    let contact = LoadedContact {
        load_n: 100e3,
        a_m: 6e-3,
        b_m: 6e-3,
        shear_modulus_pa: 82e9,
        kalker: KalkerTable::new(0.28).unwrap().at(1.0),
        friction: 0.3,
    };
    let limit = contact.load_n * contact.friction;
    let scale = contact.shear_modulus_pa * contact.a_m * contact.b_m / limit;
    let laws: [(&str, Box<dyn CreepLaw>); 4] = [
        ("book of tables", Box::new(KalkerBook::new())),
        ("Polach", Box::new(Polach)),
        ("Shen-Hedrick-Elkins", Box::new(ShenHedrickElkins)),
        ("FASTSIM", Box::new(Fastsim::default())),
    ];
    let solver = RollingContact::new(1.0, 0.28).unwrap();
    let titles = [
        "Lateral force, circle, no spin",
        "spin 0.5 / m",
        "spin 1.5 / m",
    ];
    [0.0, 0.5, 1.5]
        .into_iter()
        .zip(titles)
        .map(|(spin_per_m, title)| {
            let creepages: Vec<f64> = (-12..=12).map(|i| f64::from(i) * 1e-3).collect();
            let exact = creepages.iter().step_by(2).map(|lateral| {
                let scaled = [0.0, lateral * scale, spin_per_m * contact.a_m * scale];
                (1e3 * lateral, solver.solve(scaled).unwrap()[1])
            });
            let mut curves = vec![Curve {
                name: "exact theory".to_owned(),
                colour: COLOURS[0],
                marked: true,
                points: exact.collect(),
            }];
            for ((name, law), colour) in laws.iter().zip(&COLOURS[1..]) {
                let force = |lateral: &f64| {
                    let creepage = Creepage {
                        lateral: *lateral,
                        spin_per_m,
                        ..Creepage::default()
                    };
                    (
                        1e3 * lateral,
                        law.forces(&contact, &creepage).lateral_n / limit,
                    )
                };
                curves.push(Curve {
                    name: (*name).to_owned(),
                    colour: *colour,
                    marked: false,
                    points: creepages.iter().map(force).collect(),
                });
            }
            Panel {
                title,
                x: "lateral creepage, per mille",
                y: "force over friction",
                legend: UpperRight,
                curves,
            }
        })
        .collect()
}

fn exact_and_found(exact: Vec<(f64, f64)>, found: Vec<(f64, f64)>) -> Vec<Curve> {
    let curve = |name: &str, colour, marked, points| Curve {
        name: name.to_owned(),
        colour,
        marked,
        points,
    };
    vec![
        curve("exact theory", COLOURS[0], true, exact),
        curve("here", COLOURS[1], false, found),
    ]
}

/// Draws the panels side by side, two in a row.
fn draw(panels: &[Panel]) -> String {
    let (columns, rows) = (2, panels.len().div_ceil(2));
    let (width, height) = (980, 330 * rows as u32);
    let mut text = String::new();
    {
        let sheet = SVGBackend::with_string(&mut text, (width * FINE, height * FINE));
        let sheet = sheet.into_drawing_area();
        sheet.fill(&WHITE).unwrap();
        for (area, panel) in sheet.split_evenly((rows, columns)).iter().zip(panels) {
            draw_panel(area, panel);
        }
        sheet.present().unwrap();
    }
    let drawn = format!("width=\"{}\" height=\"{}\"", width * FINE, height * FINE);
    text.replacen(&drawn, &format!("width=\"{width}\" height=\"{height}\""), 1)
}

fn draw_panel(area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>, panel: &Panel) {
    let points = || panel.curves.iter().flat_map(|curve| &curve.points);
    let (x, y) = (extent(points().map(|p| p.0)), extent(points().map(|p| p.1)));
    let letters = |size: u32| ("sans-serif", size * FINE).into_font().color(&COLOURS[0]);
    let mut chart = ChartBuilder::on(area)
        .margin(10 * FINE)
        .caption(panel.title, letters(17))
        .x_label_area_size(42 * FINE)
        .y_label_area_size(58 * FINE)
        .build_cartesian_2d(x, y)
        .unwrap();
    chart
        .configure_mesh()
        .x_desc(panel.x)
        .y_desc(panel.y)
        .x_label_formatter(&short)
        .y_label_formatter(&short)
        .label_style(letters(13))
        .axis_desc_style(letters(14))
        .light_line_style(WHITE)
        .bold_line_style(COLOURS[0].mix(0.15).stroke_width(FINE))
        .draw()
        .unwrap();
    for curve in &panel.curves {
        let style = curve.colour.stroke_width(2 * FINE);
        let swatch =
            move |(x, y): (i32, i32)| PathElement::new([(x, y), (x + 18 * FINE as i32, y)], style);
        if curve.marked {
            let points = curve.points.iter();
            let marks = points.map(|p| Circle::new(*p, 3 * FINE, curve.colour.filled()));
            chart
                .draw_series(marks)
                .unwrap()
                .label(&curve.name)
                .legend(move |(x, y)| {
                    Circle::new((x + 9 * FINE as i32, y), 3 * FINE, style.color.filled())
                });
        } else {
            chart
                .draw_series(LineSeries::new(curve.points.iter().copied(), style))
                .unwrap()
                .label(&curve.name)
                .legend(swatch);
        }
    }
    chart
        .configure_series_labels()
        .label_font(letters(12))
        .legend_area_size(24 * FINE)
        .margin(6 * FINE)
        .background_style(WHITE.mix(0.85))
        .border_style(COLOURS[0].mix(0.3).stroke_width(FINE))
        .position(panel.legend.clone())
        .draw()
        .unwrap();
}

/// Formats a number without superfluous digits, and zero without a sign.
fn short(number: &f64) -> String {
    format!("{}", (number * 1e3).round() / 1e3 + 0.0)
}

/// Range of the numbers, with a margin.
fn extent(numbers: impl Iterator<Item = f64> + Clone) -> Range<f64> {
    let min = numbers.clone().fold(f64::MAX, f64::min);
    let max = numbers.fold(f64::MIN, f64::max);
    let margin = 0.04 * (max - min);
    min - margin..max + margin
}
