//! Measured tracks: valid and damaged files.

use dashpot_rail::track::measured::{
    self, MAX_INTERVAL_M, MIN_INTERVAL_M, MIN_ROWS, MeasuredTrackError, Options, Reading,
};
use dashpot_rail::track::{Irregularity, RailDeviation};
use proptest::prelude::*;

/// Deviations of the four channels, m.
fn waves(distance_m: f64) -> [f64; 4] {
    [
        4e-3 * (0.5 * distance_m).sin(),
        3e-3 * (0.3 * distance_m).cos(),
        2e-3 * (0.7 * distance_m).sin(),
        1e-3 * (0.4 * distance_m).cos(),
    ]
}

/// Returns a file with rows at these distances.
fn file(distances_m: impl Iterator<Item = f64>) -> String {
    let mut text = String::from("distance_m,vertical_m,lateral_m,cross_level_m,gauge_m\n");
    for distance_m in distances_m {
        let [vertical, lateral, cross_level, gauge] = waves(distance_m);
        text += &format!("{distance_m},{vertical},{lateral},{cross_level},{gauge}\n");
    }
    text
}

fn even() -> String {
    file((0..=400).map(|i| 0.25 * f64::from(i)))
}

fn read(text: &str) -> Result<(Irregularity, Reading), MeasuredTrackError> {
    measured::parse(text, &Options::default())
}

fn assert_has_the_waves(text: &str, shift_m: f64, allowed_m: f64) {
    let options = Options::default().with_shift_m(shift_m);
    let (irregularity, reading) = measured::parse(text, &options).unwrap();
    let read = reading.channels;
    assert!(read.vertical && read.lateral && read.cross_level && read.gauge);
    for i in 0..790 {
        let distance_m = 10.5 + 0.1 * f64::from(i);
        let [found, slopes] = irregularity.channels(distance_m + shift_m);
        let expected = waves(distance_m);
        let found = [
            found.vertical,
            found.lateral,
            found.cross_level,
            found.gauge,
        ];
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < allowed_m,
                "{distance_m}: {found} {expected}"
            );
        }
        let slope = 2e-3 * (0.5 * distance_m).cos();
        assert!(
            (slopes.vertical - slope).abs() < 10.0 * allowed_m,
            "{distance_m}"
        );
    }
}

#[test]
fn rows_at_equal_and_unequal_distances_are_read() {
    assert_has_the_waves(&even(), 0.0, 1e-6);
    assert_has_the_waves(&even(), 1000.0, 1e-6);
    let uneven = (0..=400).map(|i| 0.25 * f64::from(i) + 0.08 * f64::from(i).sin());
    assert_has_the_waves(&file(uneven), 0.0, 3e-6);
}

#[test]
fn distances_may_start_anywhere() {
    let rows = |first_m: f64| file((0..=400).map(|i| first_m + 0.25 * f64::from(i)));
    let (irregularity, reading) = read(&rows(1200.0)).unwrap();
    assert_eq!(reading.distances_m, [1200.0, 1300.0]);
    for distance_m in [1215.0, 1250.1, 1284.9] {
        let found = irregularity.channels(distance_m)[0];
        let [vertical, lateral, ..] = waves(distance_m);
        assert!((found.vertical - vertical).abs() < 1e-6, "{distance_m}");
        assert!((found.lateral - lateral).abs() < 1e-6, "{distance_m}");
    }
}

#[test]
fn the_shortest_and_longest_intervals_and_the_fewest_rows_are_allowed() {
    let with_interval = |interval_m: f64| {
        let text = file((0..MIN_ROWS).map(|i| 1.0 + interval_m * i as f64));
        let ramped = Options::default().with_ramp_m(2.0 * interval_m);
        measured::parse(&text, &ramped).map(|(_, reading)| reading.rows)
    };
    for interval_m in [MIN_INTERVAL_M, MAX_INTERVAL_M] {
        assert_eq!(with_interval(interval_m).unwrap(), MIN_ROWS);
    }
    // Decimals are rounded, but not by a thousandth of an interval.
    for interval_m in [0.999 * MIN_INTERVAL_M, 1.001 * MAX_INTERVAL_M] {
        let error = with_interval(interval_m).unwrap_err();
        let is_interval = matches!(error, MeasuredTrackError::Interval { line: 3, .. });
        assert!(is_interval, "{error}");
    }
}

#[test]
fn a_file_with_more_samples_than_fit_is_refused_with_their_number() {
    // Rows 5 m apart over 40 010 m, sampled every centimetre.
    let text = file((0..=8002).map(|i| 5.0 * f64::from(i)));
    let options = Options::default().with_spacing_m(Some(MIN_INTERVAL_M));
    let error = measured::parse(&text, &options).unwrap_err().to_string();
    assert!(error.contains("4001001"), "{error}");
}

#[test]
fn columns_may_be_in_any_order_in_mm_or_absent() {
    let mut text = String::from("\u{feff}# made\r\n gauge_mm , distance_m\r\n");
    for i in 0..=200 {
        text += &format!("2.5, {}\r\n# between\r\n\r\n", 100.0 + 0.25 * f64::from(i));
    }
    let (irregularity, reading) = read(&text).unwrap();
    let read = reading.channels;
    assert!(!read.vertical && !read.lateral && !read.cross_level && read.gauge);
    assert_eq!((reading.rows, reading.distances_m), (201, [100.0, 150.0]));
    let [left, right] = irregularity.at(125.0);
    assert!((left.lateral_m + 1.25e-3).abs() < 1e-15 && (right.lateral_m - 1.25e-3).abs() < 1e-15);
    assert_eq!((left.vertical_m, right.vertical_m), (0.0, 0.0));
}

#[test]
fn distances_are_in_metres_only() {
    let text = even().replace("distance_m,", "distance_mm,");
    let error = read(&text).unwrap_err();
    assert_eq!(error.line(), Some(1));
    let text = error.to_string();
    assert!(text.starts_with("unknown column \"distance_mm\""), "{text}");
}

#[test]
fn the_file_is_ramped_at_its_ends_and_zero_beyond() {
    let (irregularity, _) = read(&even()).unwrap();
    assert_eq!(irregularity.ends_m(), [0.0, 100.0]);
    assert_eq!(irregularity.spacing_m(), 0.25);
    for distance_m in [-10.0, 110.0] {
        assert_eq!(irregularity.at(distance_m), [RailDeviation::default(); 2]);
    }
    for distance_m in [5.0, 95.0] {
        let found = irregularity.channels(distance_m)[0].lateral;
        assert!((found - 0.5 * waves(distance_m)[1]).abs() < 1e-9, "{found}");
    }
    assert!(irregularity.channels(0.0)[0].lateral.abs() < 1e-15);
}

#[test]
fn errors_of_files_state_line_column_and_bounds() {
    let good = even();
    let header = good.lines().next().unwrap();
    let with_header = |text: &str| good.replace(header, text);
    let cases = [
        (
            String::new(),
            ":1: columns none, allowed: distance_m and one or more of vertical",
        ),
        (
            with_header("distance_m,vertical_m,lateral_m,level_m,gauge_m"),
            ":1: unknown column \"level_m\", allowed: distance_m, and vertical, lateral, cross_level and gauge, each \
             with _m or _mm, separated by commas",
        ),
        (
            good.replace(',', ";"),
            ":1: unknown column \"distance_m;vertical_m;lateral_m;cross_level_m;gauge_m\", allowed: distance_m, and",
        ),
        (
            with_header("distance_m,vertical_m,lateral_m,vertical_mm,gauge_m"),
            ":1: column \"vertical_mm\": vertical appears twice, allowed: once",
        ),
        (
            "distance_m\n1\n".to_owned(),
            ":1: columns distance_m, allowed: distance_m and one",
        ),
        (
            "# a\n\nvertical_m,gauge_m\n1\n".to_owned(),
            ":3: columns vertical_m, gauge_m, allowed: distance_m and",
        ),
        (
            good.replace("\n25,", "\n25,0,"),
            ":102: 6 cells, allowed: 5, as in the header",
        ),
        (
            good.replace("\n25,", "\n# one\n\n25 m,"),
            ":104: column distance_m: \"25 m\", allowed: a number from -10000000 to 10000000",
        ),
        (good.replace("\n25,", "\n25,nan,"), ":102: 6 cells"),
        (
            "distance_m,gauge_mm\n0,1\n0.25,NaN\n".to_owned(),
            ":3: column gauge_mm: \"NaN\", allowed: a number from -500 to 500",
        ),
        (
            "distance_m,gauge_m\n0,1.5\n".to_owned(),
            ":2: column gauge_m: \"1.5\", allowed: a number from -0.5 to 0.5",
        ),
        (
            good.replace("\n25,", "\n24.75,"),
            ":102: column distance_m: 0 m after the previous row, allowed: rising distances, 0.01 to 5 m apart",
        ),
        (
            good.replace("\n25,", "\n20,"),
            ":102: column distance_m: -4.75 m after the previous row",
        ),
        (
            good.replace("\n100,", "\n105,"),
            ":402: column distance_m: 5.25 m after the previous row, allowed: rising distances, 0.01 to 5 m",
        ),
        (
            good.lines()
                .take(8)
                .map(|line| format!("{line}\n"))
                .collect(),
            "too few rows: 7, allowed: 8 or more",
        ),
    ];
    for (text, expected) in cases {
        let error = read(&text).unwrap_err();
        let line = error
            .line()
            .map_or(String::new(), |line| format!(":{line}: "));
        let column = error
            .column()
            .map_or(String::new(), |name| format!("column {name}: "));
        let message = format!("{line}{column}{error}");
        assert!(message.starts_with(expected), "{message}\n{expected}");
    }
    for (options, expected) in [
        (
            Options::default().with_ramp_m(51.0),
            "ramp_m 51, allowed: 0.25 to 50",
        ),
        (
            Options::default().with_ramp_m(0.0),
            "ramp_m 0, allowed: 0.25",
        ),
        (
            Options::default().with_spacing_m(Some(0.0)),
            "spacing_m 0, allowed: 0.01 to 5",
        ),
        (Options::default().with_shift_m(f64::NAN), "shift_m NaN"),
    ] {
        let error = measured::parse(&good, &options).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
}

/// Checks that a track that is read without error is valid.
fn read_as_anything(text: &str) {
    if let Ok((irregularity, reading)) = read(text) {
        assert!(reading.rows >= measured::MIN_ROWS);
        let [from, to] = irregularity.ends_m();
        for i in 0..=100 {
            let distance_m = from + (to - from) * f64::from(i) / 100.0;
            for rail in irregularity.at(distance_m) {
                assert!(rail.vertical_m.is_finite() && rail.lateral_slope.is_finite());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn no_text_makes_the_reader_panic(text in any::<String>(), rows in "([-0-9.,;e \t\r\n\"#]|nan|inf){0,200}") {
        read_as_anything(&text);
        read_as_anything(&format!("distance_m,vertical_m\n{rows}"));
    }

    #[test]
    fn no_damage_makes_the_reader_panic(place in any::<prop::sample::Index>(), patch in "[-+0-9.e,a-z_\n\"# ]{0,8}") {
        let mut bytes = even().into_bytes();
        let start = place.index(bytes.len());
        let end = (start + patch.len()).min(bytes.len());
        bytes.splice(start..end, patch.bytes());
        read_as_anything(&String::from_utf8_lossy(&bytes));
    }
}
