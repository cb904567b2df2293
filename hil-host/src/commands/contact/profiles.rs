//! Wheel and rail profiles of `dashpot contact`: built-in or from files.

use std::path::Path;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use dashpot_rail::profile::measured::{self, Format, Mirror, Options, Reading};
use dashpot_rail::profile::{Body, Profile};

use crate::commands::failure::Outcome;
use crate::commands::streams;
use dashpot_files::profile;

/// Selection of wheel and rail profiles.
#[derive(Debug, Clone, clap::Args)]
pub struct ProfileArguments {
    /// Wheel profile: `s1002` or a file; `-` for standard input.
    ///
    /// MiniProf (.whl), SIMPACK (.prw), GENSYS (.wheel), or two columns y_mm, z_mm from the tread datum, field side and
    /// down positive.
    #[arg(long, default_value = "s1002", value_name = "NAME|FILE")]
    pub wheel: String,
    /// Rail profile: `uic60` or a file; `-` for standard input.
    ///
    /// MiniProf (.ban), SIMPACK (.prr), GENSYS (.rail), or two columns y_mm, z_mm, field side and down positive.
    #[arg(long, default_value = "uic60", value_name = "NAME|FILE")]
    pub rail: String,
    /// Format of the wheel file, if it cannot be detected from its content and name.
    #[arg(long, value_name = "FORMAT", value_parser = formats())]
    pub wheel_format: Option<Format>,
    /// Format of the rail file, if it cannot be detected from its content and name.
    #[arg(long, value_name = "FORMAT", value_parser = formats())]
    pub rail_format: Option<Format>,
    /// Axes of the wheel file whose sign is inverted: y for a profile of the other side.
    #[arg(long, value_name = "AXES", value_parser = mirrors())]
    pub wheel_mirror: Option<Mirror>,
    /// Axes of the rail file whose sign is inverted: y for a profile of the other side. Required for a GENSYS rail:
    /// none if its y points to the field side, y if it points to the track centre.
    #[arg(long, value_name = "AXES", value_parser = mirrors())]
    pub rail_mirror: Option<Mirror>,
    /// Smoothing of profiles from files: wavelength whose amplitude is halved, m; 0 passes through every point.
    #[arg(long, default_value_t = measured::DEFAULT_SMOOTHING_M)]
    pub smoothing_m: f64,
}

fn formats() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name)).try_map(|name| name.parse())
}

fn mirrors() -> impl TypedValueParser<Value = Mirror> {
    PossibleValuesParser::new(Mirror::ALL.map(Mirror::name)).try_map(|name| name.parse())
}

/// A wheel and a rail, with reading details.
pub(super) struct Profiles {
    pub wheel: Profile,
    pub rail: Profile,
    pub readings: Readings,
}

/// Reading details of wheel and rail; `None` for a built-in profile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Readings {
    pub wheel: Option<Reading>,
    pub rail: Option<Reading>,
}

impl ProfileArguments {
    /// Loads the two profiles.
    ///
    /// # Errors
    /// A profile does not exist, a file is invalid, or an option is out of range.
    pub(super) fn load(&self) -> Outcome<Profiles> {
        let smoothing_m = self.smoothing_m;
        streams::refuse_second_standard_input(&[
            ("--wheel", Path::new(&self.wheel)),
            ("--rail", Path::new(&self.rail)),
        ])?;
        let options = |format, mirror| {
            Options::default()
                .with_format(format)
                .with_mirror(mirror)
                .with_smoothing_m(smoothing_m)
        };
        let wheel_options = options(self.wheel_format, self.wheel_mirror);
        let rail_options = options(self.rail_format, self.rail_mirror);
        let (wheel, of_wheel) = profile::load(&self.wheel, Body::Wheel, &wheel_options)?;
        let (rail, of_rail) = profile::load(&self.rail, Body::Rail, &rail_options)?;
        Ok(Profiles {
            wheel,
            rail,
            readings: Readings {
                wheel: of_wheel,
                rail: of_rail,
            },
        })
    }
}
