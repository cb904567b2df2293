//! Figures with one small panel for each wheelset, all on one scale, with the limits of the report.

use plotters::style::RGBColor;

use super::figures::TIME;
use super::history::History;
use dashpot_report::page::{Figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::sheet::{Panel, with_one_scale};
use dashpot_report::plot::style::{COMPARED, FIRST, LEFT, LIMIT, RIGHT, SECOND};
use dashpot_vehicle_run::signals::{SIDES, slug};
use dashpot_vehicle_run::{Indices, WheelIndices, WheelsetIndices};

const HEIGHT: u32 = 210;
/// Line width, in quarters of a pixel.
const WIDE: u32 = 5;

/// A signal of every wheelset.
struct Drawn<'a> {
    /// End of the signal's name.
    ending: &'a str,
    factor: f64,
    /// Name in the legend.
    name: &'a str,
    colour: RGBColor,
}

/// Wheelsets of a run.
pub(super) struct Wheelsets<'a> {
    pub(super) history: &'a History,
    pub(super) names: &'a [String],
    /// `None` for a run without indices, which has no limits either.
    pub(super) indices: Option<&'a Indices>,
}

impl Wheelsets<'_> {
    /// Lateral displacement and yaw.
    pub(super) fn displacements(&self) -> Figure {
        let drawn = [("lateral_m", "lateral", FIRST), ("yaw_rad", "yaw", SECOND)];
        let drawn = drawn.map(|(ending, name, colour)| Drawn {
            ending,
            factor: 1e3,
            name,
            colour,
        });
        self.figure("lateral, mm; yaw, mrad", &drawn, |_| Vec::new())
    }

    /// Vertical forces of the wheels with the load at standstill.
    pub(super) fn loads(&self) -> Figure {
        self.of_wheels("load_n", 1e-3, "Q, kN", |wheelset| {
            self.standstill(wheelset).into_iter().collect()
        })
    }

    /// Vertical forces of the wheels, filtered, with the load at standstill and the limit.
    pub(super) fn filtered_loads(&self) -> Figure {
        self.of_wheels("filtered_load_n", 1e-3, "Q, kN", |wheelset| {
            let limit = least(wheelset, |wheel| wheel.load_limit_n);
            let limit = limit.map(|limit| self.level("limit", 1e-3 * limit, LIMIT));
            self.standstill(wheelset).into_iter().chain(limit).collect()
        })
    }

    /// Lateral forces, filtered and averaged, with Prud'homme's limit on both sides.
    pub(super) fn lateral_forces(&self) -> Figure {
        let force = Drawn {
            ending: "filtered_lateral_force_n",
            factor: 1e-3,
            name: "force",
            colour: FIRST,
        };
        self.figure("lateral force, kN", &[force], |wheelset| {
            let limits = wheelset.lateral_force_limit_n.into_iter();
            let limits = limits.flat_map(|limit| [("", -limit), ("Prud'homme's limit", limit)]);
            limits
                .map(|(name, limit)| self.level(name, 1e-3 * limit, LIMIT))
                .collect()
        })
    }

    /// Contact positions on the wheels.
    pub(super) fn contact_positions(&self) -> Figure {
        self.of_wheels("contact_m", 1e3, "position, mm", |_| Vec::new())
    }

    /// `Y/Q` of the wheels.
    pub(super) fn derailment(&self) -> Figure {
        self.of_wheels("derailment", 1.0, "Y/Q", |_| Vec::new())
    }

    /// `Y/Q` of the wheels, filtered and averaged, with Nadal's limit.
    pub(super) fn filtered_derailment(&self) -> Figure {
        self.of_wheels("filtered_derailment", 1.0, "Y/Q", |wheelset| {
            let limits = SIDES.map(|side| self.nadal(&wheelset.wheelset, side));
            match limits {
                [Some(left), Some(right)] if left == right => {
                    vec![self.level("Nadal's limit", left, LIMIT)]
                }
                limits => {
                    let names = ["Nadal's limit, left", "Nadal's limit, right"];
                    let limits = names.into_iter().zip(limits);
                    limits
                        .filter_map(|(name, limit)| Some(self.level(name, limit?, LIMIT)))
                        .collect()
                }
            }
        })
    }

    /// Nadal's limit of a wheel.
    fn nadal(&self, wheelset: &str, side: &str) -> Option<f64> {
        let mut limits = self.indices?.nadal_limits.iter();
        let found = limits.find(|nadal| {
            let mut wheels = nadal.wheels.iter();
            wheels.any(|wheel| wheel.wheelset == wheelset && wheel.side == side)
        });
        found.map(|nadal| nadal.limit)
    }

    /// Load of a wheel at standstill.
    fn standstill(&self, wheelset: &WheelsetIndices) -> Option<Curve> {
        let load_n = least(wheelset, |wheel| wheel.load_static_n)?;
        Some(self.level("standstill", 1e-3 * load_n, COMPARED))
    }

    /// A dashed line over the whole run.
    fn level(&self, name: &str, value: f64, colour: RGBColor) -> Curve {
        let ends = self.history.ends_s().map(|time_s| (time_s, value));
        Curve::new(name, colour, ends).wide(6).dashed()
    }

    /// A signal of the left and the right wheel.
    fn of_wheels(
        &self,
        ending: &str,
        factor: f64,
        y: &str,
        limits: impl Fn(&WheelsetIndices) -> Vec<Curve>,
    ) -> Figure {
        let endings = SIDES.map(|side| format!("{side}_{ending}"));
        let mut sides = SIDES.into_iter().zip([LEFT, RIGHT]).zip(&endings);
        let drawn: Vec<Drawn<'_>> = sides
            .by_ref()
            .map(|((name, colour), ending)| Drawn {
                ending,
                factor,
                name,
                colour,
            })
            .collect();
        self.figure(y, &drawn, limits)
    }

    fn figure(
        &self,
        y: &str,
        drawn: &[Drawn<'_>],
        limits: impl Fn(&WheelsetIndices) -> Vec<Curve>,
    ) -> Figure {
        let panels = self.names.iter().map(|wheelset| {
            let indices = self.indices.into_iter();
            let mut all = indices.flat_map(|indices| &indices.wheelsets);
            let own = all.find(|own| own.wheelset == *wheelset);
            let curves = drawn.iter().map(|drawn| {
                let signal = format!("{}_{}", slug(wheelset), drawn.ending);
                let points = self.history.over_time(&signal, drawn.factor);
                Curve::new(drawn.name, drawn.colour, points).wide(WIDE)
            });
            let limits = own.map_or_else(Vec::new, &limits);
            Panel {
                title: wheelset.clone(),
                ..panel("time, s", y, curves.chain(limits).collect())
            }
        });
        Figure {
            panels: with_one_scale(panels.collect()),
            height: HEIGHT,
            cursor_group: Some(TIME),
        }
    }
}

/// Smallest value of the two wheels.
fn least(wheelset: &WheelsetIndices, value: impl Fn(&WheelIndices) -> Option<f64>) -> Option<f64> {
    wheelset.wheels.iter().filter_map(value).reduce(f64::min)
}
