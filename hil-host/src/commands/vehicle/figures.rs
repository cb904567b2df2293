//! Figures of the page.

use plotters::style::RGBColor;

use super::history::History;
use dashpot_report::page::{Figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::envelope::thinned;
use dashpot_report::plot::sheet::{Panel, Scale};
use dashpot_report::plot::style::{COMPARED, DIFFERENCE, FIRST, RESULT, SECOND};
use dashpot_study::verification::Forces;
use dashpot_vehicle_run::signals::slug;

/// Group of figures over time, which share one cursor.
pub(super) const TIME: &str = "time";
pub(super) const HEIGHT: u32 = 300;

fn over_time(history: &History, signal: &str, factor: f64, name: &str, colour: RGBColor) -> Curve {
    Curve::new(name, colour, history.over_time(signal, factor)).wide(5)
}

/// Lateral and vertical accelerations of a body.
pub(super) fn accelerations(history: &History, body: &str) -> Figure {
    let one = |direction: &str, colour| {
        let signal = format!("{}_{direction}_acceleration_m_per_s2", slug(body));
        let curve = over_time(history, &signal, 1.0, "", colour);
        panel("time, s", &format!("{direction}, m/s²"), vec![curve])
    };
    Figure {
        panels: vec![one("lateral", FIRST), one("vertical", SECOND)],
        height: HEIGHT,
        cursor_group: Some(TIME),
    }
}

/// Force of friction elements over time, two elements per panel.
pub(super) fn friction(history: &History, elements: &[&str]) -> Figure {
    let panels = elements.chunks(2).map(|pair| {
        let curves = pair.iter().zip([FIRST, SECOND]);
        let curves = curves.map(|(name, colour)| {
            let signal = format!("{}_force_n", slug(name));
            over_time(history, &signal, 1e-3, name, colour)
        });
        panel("time, s", "force, kN", curves.collect())
    });
    Figure {
        panels: panels.collect(),
        height: HEIGHT,
        cursor_group: Some(TIME),
    }
}

/// Force of an external damper, of the same damper simulated internally, and their difference.
pub(super) fn outside(forces: &Forces, step_s: f64) -> Figure {
    let over_time = |values: &mut dyn Iterator<Item = f64>, name: &str, colour| {
        Curve::new(name, colour, thinned(values, step_s))
    };
    let Forces {
        outside_n,
        inside_n,
        ..
    } = forces;
    let both = vec![
        over_time(
            &mut inside_n.iter().map(|force| force * 1e-3),
            "internal",
            COMPARED,
        )
        .wide(16),
        over_time(
            &mut outside_n.iter().map(|force| force * 1e-3),
            "external",
            RESULT,
        )
        .wide(5),
    ];
    let mut difference = outside_n.iter().zip(inside_n).map(|(a, b)| a - b);
    let difference = over_time(&mut difference, "", DIFFERENCE).wide(5);
    Figure {
        panels: vec![
            panel("time, s", "force, kN", both),
            panel("time, s", "external minus internal, N", vec![difference]),
        ],
        height: HEIGHT,
        cursor_group: Some(TIME),
    }
}

/// Force over displacement of dampers, two dampers per panel.
pub(super) fn loops(history: &History, dampers: &[&str]) -> Figure {
    of_dampers(
        history,
        dampers,
        ("displacement_m", 1e3, "displacement, mm"),
    )
}

/// Force over velocity of dampers, two dampers per panel.
pub(super) fn characteristics(history: &History, dampers: &[&str]) -> Figure {
    of_dampers(history, dampers, ("velocity_m_per_s", 1.0, "velocity, m/s"))
}

/// Force of dampers over another of their signals, given with its factor and axis label.
fn of_dampers(
    history: &History,
    dampers: &[&str],
    (over, factor, label): (&str, f64, &str),
) -> Figure {
    let colours = [FIRST, SECOND];
    let panels = dampers.chunks(2).map(|pair| {
        let curves = pair.iter().zip(colours).map(|(name, colour)| {
            let name_of = |what: &str| format!("{}_{what}", slug(name));
            let (x, y) = (name_of(over), name_of("force_n"));
            Curve::new(*name, colour, history.points([&x, &y], [factor, 1e-3])).wide(4)
        });
        Panel {
            title: String::new(),
            x_label: label.into(),
            y_label: "force, kN".into(),
            legend: None,
            sides: true,
            x_scale: Scale::Linear,
            scale: Scale::Linear,
            keeps_to_values: false,
            y_range: None,
            curves: curves.collect(),
        }
    });
    Figure {
        panels: panels.collect(),
        height: HEIGHT + 40,
        cursor_group: None,
    }
}
