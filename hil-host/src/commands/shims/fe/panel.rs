//! Panel of a valve, shared by all drawings.

use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::sheet::{Panel, Scale};
use plotters::prelude::SeriesLabelPosition;

use super::Solved;
use crate::commands::shims::capital::capital;

/// Creates a panel for a valve.
pub(super) fn panel(solved: &Solved, x_label: &str, y_label: &str, curves: Vec<Curve>) -> Panel {
    Panel {
        title: format!("{} valve", capital(solved.location.name)),
        x_label: x_label.into(),
        y_label: y_label.into(),
        legend: Some(SeriesLabelPosition::UpperLeft),
        sides: false,
        x_scale: Scale::Linear,
        scale: Scale::Linear,
        keeps_to_values: false,
        y_range: None,
        curves,
    }
}
