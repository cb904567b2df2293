//! Pictures of README.md: error of the fixed step over its size, in a light and a dark variant.
//! `DASHPOT_BLESS=1 cargo test -p dashpot --test damper accuracy_figure` draws them.

use std::fmt::Write;

use dashpot::accuracy::errors;
use dashpot::{damper, document};
use dashpot_files::Scalar;
use dashpot_testbench::accuracy_limits::ACCURACY_LIMITS;
use dashpot_testbench::excitation::Excitation;

/// Steps of the curves, s.
const STEPS_S: [f64; 8] = [2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3];
/// Dampers with the height by which their name is moved, so that names do not cover one another.
const DAMPERS: [(&str, f64); 3] = [
    ("paper", -5.0),
    ("in-service", 6.0),
    ("reduced-vertical", 8.0),
];
/// Where the motion of all curves comes from.
const MOTION: Excitation = Excitation::Ride;

/// Size of the picture, and the edges of its plot.
const SIZE: (f64, f64) = (760.0, 380.0);
const LEFT: f64 = 70.0;
const RIGHT: f64 = 610.0;
const TOP: f64 = 52.0;
const BOTTOM: f64 = 328.0;
/// Powers of ten at the edges of the plot: steps in s, errors.
const STEPS: (f64, f64) = (-4.7, -2.3);
const ERRORS: (f64, f64) = (-7.5, -1.5);

/// Colours of a variant.
struct Theme {
    name: &'static str,
    paper: &'static str,
    ink: &'static str,
    grid: &'static str,
    limit: &'static str,
    curves: [&'static str; 3],
}

const THEMES: [Theme; 2] = [
    Theme {
        name: "light",
        paper: "#ffffff",
        ink: "#1f2328",
        grid: "#d8dde2",
        limit: "#6e7781",
        curves: ["#1565c0", "#b35900", "#2e7d32"],
    },
    Theme {
        name: "dark",
        paper: "#0d1117",
        ink: "#e6edf3",
        grid: "#30363d",
        limit: "#8b949e",
        curves: ["#79b8ff", "#ffb366", "#7ee787"],
    },
];

fn x(step_s: f64) -> f64 {
    LEFT + (step_s.log10() - STEPS.0) / (STEPS.1 - STEPS.0) * (RIGHT - LEFT)
}

fn y(error: f64) -> f64 {
    BOTTOM - (error.log10() - ERRORS.0) / (ERRORS.1 - ERRORS.0) * (BOTTOM - TOP)
}

/// Points of a line in a picture, with one digit after the point.
fn points(line: &[(f64, f64)]) -> String {
    let points = line.iter().map(|(step_s, error)| (x(*step_s), y(*error)));
    let points: Vec<String> = points.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    points.join(" ")
}

/// The NRMSE in `f32` of a damper over the steps.
fn measured(name: &str) -> Vec<(f64, f64)> {
    let damper = damper(name, &[]);
    let steps = STEPS_S.into_iter();
    steps
        .map(|step_s| {
            let [_, single] = errors(&damper, MOTION, step_s).0;
            // Two digits, as in docs/numerics.md: the picture is the same on every machine.
            let rounded = format!("{single:.1e}");
            (step_s, rounded.parse().expect("a number"))
        })
        .collect()
}

/// The limit that the tests require, over the steps for which there is one.
fn limit() -> Vec<(f64, f64)> {
    let steps = [STEPS_S[0], 1e-4, 1.0001e-4, 1e-3];
    steps
        .into_iter()
        .filter_map(|step_s| Some((step_s, ACCURACY_LIMITS[0].nrmse(step_s, Scalar::F32)?)))
        .collect()
}

fn grid(text: &mut String, theme: &Theme) -> std::fmt::Result {
    let (grid, ink) = (theme.grid, theme.ink);
    for (step_s, label) in [
        (2e-5, "20 us"),
        (1e-4, "100 us"),
        (1e-3, "1 ms"),
        (5e-3, "5 ms"),
    ] {
        let x = x(step_s);
        writeln!(
            text,
            "<path d=\"M{x:.1} {TOP}V{BOTTOM}\" stroke=\"{grid}\"/>\
             <text x=\"{x:.1}\" y=\"346\" fill=\"{ink}\" text-anchor=\"middle\">{label}</text>"
        )?;
    }
    for power in [-7, -6, -5, -4, -3, -2] {
        let y = y(10_f64.powi(power));
        writeln!(
            text,
            "<path d=\"M{LEFT} {y:.1}H{RIGHT}\" stroke=\"{grid}\"/>\
             <text x=\"62\" y=\"{:.1}\" fill=\"{ink}\" text-anchor=\"end\">1e{power}</text>",
            y + 4.0
        )?;
    }
    Ok(())
}

fn draw(theme: &Theme, curves: &[Vec<(f64, f64)>]) -> Result<String, std::fmt::Error> {
    let (width, height) = SIZE;
    let (paper, ink) = (theme.paper, theme.ink);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{paper}\"/>\n\
         <text x=\"{LEFT}\" y=\"22\" fill=\"{ink}\" font-size=\"15\">Error of the fixed step over its size</text>\n\
         <text x=\"{LEFT}\" y=\"40\" fill=\"{ink}\">rms error over rms force, f32, a ride of 5 s, against the adaptive \
         reference</text>\n\
         <text x=\"340\" y=\"368\" fill=\"{ink}\" text-anchor=\"middle\">step</text>\n"
    );
    grid(&mut text, theme)?;
    let limit = limit();
    writeln!(
        text,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"6 4\"/>\
         <text x=\"{:.1}\" y=\"{:.1}\" fill=\"{}\">limit that the tests require</text>",
        points(&limit),
        theme.limit,
        x(1.0001e-4),
        y(1e-3) - 8.0,
        theme.limit
    )?;
    for (((name, shift), colour), curve) in DAMPERS.into_iter().zip(theme.curves).zip(curves) {
        writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>",
            points(curve)
        )?;
        for (step_s, error) in curve {
            let (x, y) = (x(*step_s), y(*error));
            writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{colour}\"/>"
            )?;
        }
        let end = curve.last().map_or(TOP, |(_, error)| y(*error) + shift);
        writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{end:.1}\" fill=\"{colour}\">{name}</text>",
            RIGHT + 12.0
        )?;
    }
    text += "</svg>\n";
    Ok(text)
}

#[test]
fn the_pictures_of_the_readme_have_the_measured_errors() {
    let curves = DAMPERS.map(|(name, _)| measured(name));
    let within = |(step_s, error): &(f64, f64)| {
        let limit = ACCURACY_LIMITS[0].nrmse(*step_s, Scalar::F32);
        limit.is_none_or(|limit| *error <= limit)
    };
    assert!(curves.iter().flatten().all(within), "{curves:?}");
    for theme in THEMES {
        let path = format!("docs/pictures/accuracy-{}.svg", theme.name);
        let text = draw(&theme, &curves).expect("text grows");
        document::compare(&path, &text);
    }
}
