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
    /// Wheel profile of the left side, if it differs from the right one; also with its field side positive.
    #[arg(long, value_name = "NAME|FILE")]
    pub left_wheel: Option<String>,
    /// Rail profile of the left side, if it differs from the right one; also with its field side positive.
    #[arg(long, value_name = "NAME|FILE")]
    pub left_rail: Option<String>,
    /// Format of the left wheel file.
    #[arg(long, value_name = "FORMAT", value_parser = formats(), requires = "left_wheel")]
    pub left_wheel_format: Option<Format>,
    /// Format of the left rail file.
    #[arg(long, value_name = "FORMAT", value_parser = formats(), requires = "left_rail")]
    pub left_rail_format: Option<Format>,
    /// Axes of the left wheel file whose sign is inverted.
    #[arg(long, value_name = "AXES", value_parser = mirrors(), requires = "left_wheel")]
    pub left_wheel_mirror: Option<Mirror>,
    /// Axes of the left rail file whose sign is inverted.
    #[arg(long, value_name = "AXES", value_parser = mirrors(), requires = "left_rail")]
    pub left_rail_mirror: Option<Mirror>,
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

/// A wheel or a rail, with reading details; `None` for a built-in profile.
#[derive(Debug, Clone)]
pub(super) struct Loaded {
    pub profile: Profile,
    pub reading: Option<Reading>,
}

/// Wheels and rails of both sides.
pub(super) struct Profiles {
    pub wheel: Loaded,
    pub rail: Loaded,
    /// Wheel and rail of the left side, each only if it was given.
    pub left_wheel: Option<Loaded>,
    pub left_rail: Option<Loaded>,
}

impl ProfileArguments {
    /// Loads the profiles.
    ///
    /// # Errors
    /// A profile does not exist, a file is invalid, or an option is out of range.
    pub(super) fn load(&self) -> Outcome<Profiles> {
        let smoothing_m = self.smoothing_m;
        let named = [
            ("--wheel", Some(&self.wheel)),
            ("--rail", Some(&self.rail)),
            ("--left-wheel", self.left_wheel.as_ref()),
            ("--left-rail", self.left_rail.as_ref()),
        ];
        let paths: Vec<(&str, &Path)> = named
            .into_iter()
            .filter_map(|(option, name)| Some((option, Path::new(name?))))
            .collect();
        streams::refuse_second_standard_input(&paths)?;
        let load = |name: &str, body, format, mirror| -> Outcome<Loaded> {
            let options = Options::default()
                .with_format(format)
                .with_mirror(mirror)
                .with_smoothing_m(smoothing_m);
            let (profile, reading) = profile::load(name, body, &options)?;
            Ok(Loaded { profile, reading })
        };
        let left = |name: &Option<String>, body, format, mirror| {
            let name = name.as_ref();
            name.map(|name| load(name, body, format, mirror))
                .transpose()
        };
        Ok(Profiles {
            wheel: load(
                &self.wheel,
                Body::Wheel,
                self.wheel_format,
                self.wheel_mirror,
            )?,
            rail: load(&self.rail, Body::Rail, self.rail_format, self.rail_mirror)?,
            left_wheel: left(
                &self.left_wheel,
                Body::Wheel,
                self.left_wheel_format,
                self.left_wheel_mirror,
            )?,
            left_rail: left(
                &self.left_rail,
                Body::Rail,
                self.left_rail_format,
                self.left_rail_mirror,
            )?,
        })
    }
}
