//! Options for the wheels and rails of a vehicle.

use dashpot_files::contact::ContactOptions;

/// Wheels and rails; each option replaces the value of the files.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct WheelRailArguments {
    /// Profile of all wheels: `s1002` or a file (see `dashpot contact --help`) [default: that of the vehicle].
    #[arg(long, value_name = "NAME|FILE")]
    wheel: Option<String>,
    /// Profile of both rails: `uic60` or a file [default: that of the case, or uic60].
    #[arg(long, value_name = "NAME|FILE")]
    rail: Option<String>,
    /// Profile of the left rail, if it differs.
    #[arg(long, value_name = "NAME|FILE")]
    left_rail: Option<String>,
    /// Profile of the right rail, if it differs.
    #[arg(long, value_name = "NAME|FILE")]
    right_rail: Option<String>,
    /// Inclination of the rails: 0.025 is 1:40 [default: that of the case, or 0.025].
    #[arg(long, value_name = "RATIO")]
    rail_inclination: Option<f64>,
    /// Track gauge, m [default: that of the case, or 1.435].
    #[arg(long, value_name = "M")]
    gauge_m: Option<f64>,
}

impl WheelRailArguments {
    /// Replaces the values in `options` by the given ones.
    pub fn add_to(&self, options: &mut ContactOptions) {
        let mut given = ContactOptions::default();
        given.wheel.clone_from(&self.wheel);
        given.rail.clone_from(&self.rail);
        given.left_rail.clone_from(&self.left_rail);
        given.right_rail.clone_from(&self.right_rail);
        given.rail_inclination = self.rail_inclination;
        given.gauge_m = self.gauge_m;
        options.replace_by(given);
    }

    /// The given values.
    pub fn options(&self) -> ContactOptions {
        let mut options = ContactOptions::default();
        self.add_to(&mut options);
        options
    }
}
