//! A figure of a page, as wide as a desk or as a phone.

use plotters::prelude::SeriesLabelPosition;

use crate::report::DrawError;
use crate::report::plot::curves::Curve;
use crate::report::plot::sheet::{Layout, Panel, Scale, sheet};

/// Width of a figure on a desk (pixels).
const DESK_WIDTH: u32 = 1040;
/// Width of a figure on a phone (pixels), where panels stand one below the other.
const PHONE_WIDTH: u32 = 360;
/// Height of a panel on a phone (pixels).
const PHONE_HEIGHT: u32 = 280;

/// Panels that are shown together.
pub(crate) struct Figure {
    pub(crate) panels: Vec<Panel>,
    /// Height on a desk (pixels).
    pub(crate) height: u32,
}

impl Figure {
    /// Panels in one row, for a desk.
    ///
    /// # Errors
    /// The drawing fails.
    pub(super) fn desk(&self) -> Result<String, DrawError> {
        let columns = self.panels.len();
        let layout = Layout::row(columns, DESK_WIDTH / columns as u32, self.height);
        sheet(layout, &self.panels)
    }

    /// Panels in one column, for a phone.
    ///
    /// # Errors
    /// The drawing fails.
    pub(super) fn phone(&self) -> Result<String, DrawError> {
        sheet(Layout::column(PHONE_WIDTH, PHONE_HEIGHT), &self.panels)
    }
}

/// A panel whose curves fill the width.
pub(crate) fn panel(
    x: &str,
    y: &str,
    legend: Option<SeriesLabelPosition>,
    curves: Vec<Curve>,
) -> Panel {
    Panel {
        title: String::new(),
        x_label: x.into(),
        y_label: y.into(),
        legend,
        sides: false,
        scale: Scale::Linear,
        curves,
    }
}
