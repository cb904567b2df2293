//! Table `[contact]` of a case file, before its files are read.

use std::path::Path;

use serde::Deserialize;

use super::choice::{Choice, ChoiceKeys};
use crate::overrides::explain;
use crate::shipped::resolve_name;

/// Declares the options once: their fields, their keys, and what replaces them.
macro_rules! options {
    ($($(#[$doc:meta])* $key:ident: $type:ty,)*) => {
        /// Wheels, rails and friction of a case. Every value is optional; those of the wheels replace the vehicle's.
        #[derive(Debug, Clone, PartialEq, Default, Deserialize)]
        #[serde(deny_unknown_fields)]
        #[non_exhaustive]
        pub struct ContactOptions {
            $($(#[$doc])* pub $key: Option<$type>,)*
        }

        impl ContactOptions {
            /// Keys of the table, in the order of the fields.
            pub const KEYS: &[&str] = &[$(stringify!($key)),*];

            /// Keys that have a value.
            pub(crate) fn given(&self) -> Vec<&'static str> {
                let all = [$((stringify!($key), self.$key.is_some())),*];
                let given = all.into_iter().filter(|(_, is_given)| *is_given);
                given.map(|(key, _)| key).collect()
            }

            /// Sets each value that `other` has.
            fn merge(&mut self, other: Self) {
                $(if other.$key.is_some() {
                    self.$key = other.$key;
                })*
            }
        }
    };
}

options! {
    /// Profile of all wheels: `s1002` or a file. It also replaces the wheels that differ in the vehicle file.
    wheel: String,
    /// Format of the wheel file; by default it is detected.
    wheel_format: String,
    /// Axes of the wheel file to mirror: `none`, `y`, `z` or `yz`.
    wheel_mirror: String,
    /// Wavelength whose amplitude the smoothing of the wheel file halves, m.
    wheel_smoothing_m: f64,
    /// Wheels that differ from `wheel`, or from the vehicle's.
    other_wheel: Vec<OtherWheel>,
    /// Distance between the backs of the two flanges, m.
    back_to_back_m: f64,
    /// Distance from the back of the flange to the tread datum, m.
    back_to_datum_m: f64,
    /// Profile of both rails: `uic60` or a file.
    rail: String,
    /// Format of the rail file.
    rail_format: String,
    /// Axes of the rail file to mirror.
    rail_mirror: String,
    /// Wavelength whose amplitude the smoothing of the rail file halves, m.
    rail_smoothing_m: f64,
    /// Profile of the left rail.
    left_rail: String,
    /// Format of the file of the left rail.
    left_rail_format: String,
    /// Axes of the file of the left rail to mirror.
    left_rail_mirror: String,
    /// Wavelength whose amplitude the smoothing of the left rail halves, m.
    left_rail_smoothing_m: f64,
    /// Profile of the right rail.
    right_rail: String,
    /// Format of the file of the right rail.
    right_rail_format: String,
    /// Axes of the file of the right rail to mirror.
    right_rail_mirror: String,
    /// Wavelength whose amplitude the smoothing of the right rail halves, m.
    right_rail_smoothing_m: f64,
    /// Inclination of the rails towards the track centre: 0.025 is 1:40.
    rail_inclination: f64,
    /// Track gauge, m.
    gauge_m: f64,
    /// Depth below the top of the rails at which the gauge is measured, m.
    gauge_depth_m: f64,
    /// Gauge at distances along the track: `[distance, gauge]`, m; linear in between.
    gauge_over_distance: Vec<[f64; 2]>,
    /// Friction coefficient of both rails; the same as `friction` of the case.
    friction: f64,
    /// Friction coefficient of the left rail.
    left_friction: f64,
    /// Friction coefficient of the right rail.
    right_friction: f64,
    /// Friction coefficients at distances along the track: `[distance, left, right]`, m; linear in between.
    friction_over_distance: Vec<[f64; 3]>,
    /// Ratio of the friction coefficients at infinite and zero sliding speed; 1 for constant friction.
    residual_friction_ratio: f64,
    /// Sliding speed at which the falling part of the friction has dropped to 1/e, m/s.
    friction_decay_speed_m_per_s: f64,
}

/// Side of a wheelset or track.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// Left in the running direction.
    Left,
    /// Right in the running direction.
    Right,
}

/// Wheel profile of one wheelset, or of one of its wheels.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct OtherWheel {
    /// Name of the wheelset, with its number.
    pub wheelset: String,
    /// Side of the wheel; `None` for both.
    pub side: Option<Side>,
    /// Profile: `s1002` or a file.
    pub wheel: String,
    /// Format of the file.
    pub wheel_format: Option<String>,
    /// Axes of the file to mirror.
    pub wheel_mirror: Option<String>,
    /// Wavelength whose amplitude the smoothing halves, m.
    pub wheel_smoothing_m: Option<f64>,
}

/// Keys of a wheel profile.
pub(super) const WHEEL_KEYS: ChoiceKeys = ChoiceKeys {
    profile: "wheel",
    format: "wheel_format",
    mirror: "wheel_mirror",
    smoothing_m: "wheel_smoothing_m",
};

impl OtherWheel {
    /// Resolves the name of a file relative to `folder`.
    pub(super) fn resolve_files(&mut self, folder: &Path) {
        self.wheel = resolve_name(folder, &self.wheel);
    }

    pub(super) fn choice(&self) -> Choice<'_> {
        Choice {
            keys: ChoiceKeys {
                profile: "other_wheel",
                ..WHEEL_KEYS
            },
            name: Some(&self.wheel),
            format: self.wheel_format.as_deref(),
            mirror: self.wheel_mirror.as_deref(),
            smoothing_m: self.wheel_smoothing_m,
        }
    }
}

impl ContactOptions {
    /// Keys whose values may be file names.
    pub(crate) const FILES: [&str; 4] = ["wheel", "rail", "left_rail", "right_rail"];

    /// Replaces each value that `other` has. A new profile resets the options for reading the previous one; a new
    /// `wheel` also resets [`other_wheel`](Self::other_wheel).
    pub fn replace_by(&mut self, other: Self) {
        if other.wheel.is_some() {
            (self.wheel_format, self.wheel_mirror) = (None, None);
            (self.wheel_smoothing_m, self.other_wheel) = (None, None);
        }
        if other.rail.is_some() {
            (self.rail_format, self.rail_mirror) = (None, None);
            self.rail_smoothing_m = None;
        }
        if other.left_rail.is_some() {
            (self.left_rail_format, self.left_rail_mirror) = (None, None);
            self.left_rail_smoothing_m = None;
        }
        if other.right_rail.is_some() {
            (self.right_rail_format, self.right_rail_mirror) = (None, None);
            self.right_rail_smoothing_m = None;
        }
        self.merge(other);
    }

    /// Sets the value of a key like [`Self::replace_by`].
    ///
    /// # Errors
    /// Returns an error message for an unknown key or a value of the wrong kind.
    pub fn set(&mut self, key: &str, value: toml::Value) -> Result<(), String> {
        let table = toml::Table::from_iter([(key.to_owned(), value)]);
        let one: Self = table
            .try_into()
            .map_err(|error| explain(&error).replace('\n', " "))?;
        self.replace_by(one);
        Ok(())
    }

    /// Resolves the names of files relative to `folder`, the directory of the file that contains the table.
    pub(crate) fn resolve_files(&mut self, folder: &Path) {
        let names = [
            &mut self.wheel,
            &mut self.rail,
            &mut self.left_rail,
            &mut self.right_rail,
        ];
        for name in names.into_iter().flatten() {
            *name = resolve_name(folder, name);
        }
        for other in self.other_wheel.iter_mut().flatten() {
            other.resolve_files(folder);
        }
    }

    pub(super) fn wheel_choice(&self) -> Choice<'_> {
        Choice {
            keys: WHEEL_KEYS,
            name: self.wheel.as_deref(),
            format: self.wheel_format.as_deref(),
            mirror: self.wheel_mirror.as_deref(),
            smoothing_m: self.wheel_smoothing_m,
        }
    }

    pub(super) fn rail_choice(&self) -> Choice<'_> {
        Choice {
            keys: ChoiceKeys {
                profile: "rail",
                format: "rail_format",
                mirror: "rail_mirror",
                smoothing_m: "rail_smoothing_m",
            },
            name: self.rail.as_deref(),
            format: self.rail_format.as_deref(),
            mirror: self.rail_mirror.as_deref(),
            smoothing_m: self.rail_smoothing_m,
        }
    }

    /// Choices of the left and the right rail.
    pub(super) fn rail_choices(&self) -> [Choice<'_>; 2] {
        let left = Choice {
            keys: ChoiceKeys {
                profile: "left_rail",
                format: "left_rail_format",
                mirror: "left_rail_mirror",
                smoothing_m: "left_rail_smoothing_m",
            },
            name: self.left_rail.as_deref(),
            format: self.left_rail_format.as_deref(),
            mirror: self.left_rail_mirror.as_deref(),
            smoothing_m: self.left_rail_smoothing_m,
        };
        let right = Choice {
            keys: ChoiceKeys {
                profile: "right_rail",
                format: "right_rail_format",
                mirror: "right_rail_mirror",
                smoothing_m: "right_rail_smoothing_m",
            },
            name: self.right_rail.as_deref(),
            format: self.right_rail_format.as_deref(),
            mirror: self.right_rail_mirror.as_deref(),
            smoothing_m: self.right_rail_smoothing_m,
        };
        [left, right]
    }
}
