//! The sample files of `tests/data/`, and texts in two columns.

use dashpot_rail::profile::measured::{self, Options, ProfileError, Reading};
use dashpot_rail::profile::{Body, Profile, s1002, uic60};

/// S1002 in every format: name and text.
pub const WHEELS: [(&str, &str); 4] = [
    ("s1002.csv", include_str!("../data/s1002.csv")),
    ("s1002.whl", include_str!("../data/s1002.whl")),
    ("s1002.prw", include_str!("../data/s1002.prw")),
    ("s1002.wheel", include_str!("../data/s1002.wheel")),
];

/// UIC 60 in every format: name and text. In the last file, `y` points toward the track centre.
pub const RAILS: [(&str, &str); 4] = [
    ("uic60.csv", include_str!("../data/uic60.csv")),
    ("uic60.ban", include_str!("../data/uic60.ban")),
    ("uic60.prr", include_str!("../data/uic60.prr")),
    ("uic60.rail", include_str!("../data/uic60.rail")),
];

/// Interpolates every point.
pub const EXACT: Options = Options {
    format: None,
    mirror: None,
    smoothing_m: 0.0,
};

/// Parses a wheel in two columns with default smoothing.
pub fn wheel(text: &str) -> Result<(Profile, Reading), ProfileError> {
    measured::parse("wheel.csv", text, Body::Wheel, &Options::default())
}

/// Parses a rail in two columns with default smoothing.
pub fn rail(text: &str) -> Result<(Profile, Reading), ProfileError> {
    measured::parse("rail.csv", text, Body::Rail, &Options::default())
}

/// S1002 every 0.5 mm, rounded to two decimals as by a profile gauge, mm.
pub fn wheel_readings() -> Vec<(f64, f64)> {
    (-138..=120)
        .map(|i| f64::from(i) * 0.5)
        .map(|s| (rounded(s), rounded(s1002::depth_mm(s))))
        .collect()
}

/// UIC 60 every 0.5 mm of arc length to a depth of 36 mm, rounded to two decimals, mm.
pub fn rail_readings() -> Vec<(f64, f64)> {
    let half = |i: i32| {
        let [y, z] = uic60::position_mm(f64::from(i.abs()) * 0.5);
        (rounded(y * f64::from(i.signum())), rounded(z))
    };
    (-136..=136).map(half).filter(|row| row.1 < 36.0).collect()
}

fn rounded(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

/// Formats `rows` as the file of a profile gauge. The first row is line 3.
pub fn text(rows: &[(f64, f64)]) -> String {
    let rows: Vec<String> = rows.iter().map(|(y, z)| format!("{y},{z}")).collect();
    format!("# a gauge\ny_mm,z_mm\n{}\n", rows.join("\n"))
}
