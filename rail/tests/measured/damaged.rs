//! Damaged files: each error says what is wrong, where, and what is allowed. No text causes a panic.

use dashpot_rail::profile::measured::{self, Format, Options, ProfileError};
use dashpot_rail::profile::{Body, CurveError};
use proptest::prelude::*;

use crate::common::{EXACT, RAILS, WHEELS, rail, rail_readings, text, wheel, wheel_readings};

/// Formats `error` as the command does after the file name.
fn message(error: &ProfileError) -> String {
    let line = error.line().map(|line| format!(":{line}"));
    let column = error.column().map(|column| format!(": column {column}"));
    format!(
        "{}{}: {error}",
        line.unwrap_or_default(),
        column.unwrap_or_default()
    )
}

fn assert_says(kind: &str, error: &ProfileError, expected: &[&str]) {
    let message = message(error);
    for part in expected {
        assert!(message.contains(part), "{kind}: {message}");
    }
}

#[test]
fn columns_say_what_is_wrong_where_and_what_is_allowed() {
    let good = wheel_readings();
    type Change<'a> = &'a dyn Fn(&mut Vec<(f64, f64)>);
    let with = |change: Change<'_>| {
        let mut rows = good.clone();
        change(&mut rows);
        text(&rows)
    };
    let cases: [(&str, String, &[&str]); 10] = [
        (
            "few",
            with(&|rows| rows.truncate(12)),
            &["too few points: 12", "30 or more"],
        ),
        (
            "gap",
            with(&|rows| drop(rows.drain(100..115))),
            &[":103: gap: 8.", "5 mm"],
        ),
        (
            "folded",
            with(&|rows| rows[70].0 -= 1.2),
            &[":74: folded back by 0.70 mm", "0.3 mm"],
        ),
        (
            "wrong side up",
            with(&|rows| rows.iter_mut().for_each(|row| row.1 = -row.1)),
            &["wrong side up", "positive z_mm", "mirror z"],
        ),
        (
            "wrong side",
            with(&|rows| rows.iter_mut().for_each(|row| row.0 = -row.0)),
            &[
                "wrong side: the flange must lie at negative y_mm",
                "mirror y",
            ],
        ),
        (
            "origin",
            with(&|rows| rows.iter_mut().for_each(|row| row.0 += 70.0)),
            &["y_mm from 1.0 to 130.0", "0 at the tread datum"],
        ),
        (
            "word",
            text(&good).replace("-30,", "x,"),
            &["column y_mm", "\"x\" is not a number"],
        ),
        (
            "infinite",
            text(&good).replace("-30,", "inf,"),
            &["column y_mm", "\"inf\""],
        ),
        (
            "columns",
            text(&good).replace("-30,", "-30,1,"),
            &[":81: 3 columns, allowed: 2 (y_mm, z_mm)"],
        ),
        (
            "tread only",
            text(&good[80..]),
            &["no flange", "15 mm or more"],
        ),
    ];
    for (kind, text, expected) in cases {
        assert_says(kind, &wheel(&text).unwrap_err(), expected);
    }
    let mut head = rail_readings();
    head.iter_mut().for_each(|row| row.1 = -row.1);
    assert_eq!(rail(&text(&head)).unwrap_err(), ProfileError::HeadDown);
    let options = EXACT.with_smoothing_m(f64::NAN);
    let error = measured::parse("wheel.csv", &text(&good), Body::Wheel, &options).unwrap_err();
    assert!(
        matches!(error, ProfileError::Curve(CurveError::Smoothing { .. })),
        "{error}"
    );
}

#[test]
fn miniprof_files_say_what_is_wrong_where_and_what_is_allowed() {
    let (name, good) = WHEELS[1];
    let cases: [(&str, String, &[&str]); 8] = [
        (
            "no X",
            good.replace("ColumnDef=X,Y", "ColumnDef=A,Y"),
            &[":8: ColumnDef = A,Y, allowed: column names that include X and Y"],
        ),
        (
            "points",
            good.replace("XYPoints=", "XYPoints=many "),
            &[":13: XYPoints = many", "the number of rows"],
        ),
        (
            "cut short",
            good.lines()
                .take(150)
                .map(|line| format!("{line}\n"))
                .collect(),
            &["cut short: 136 points, but XYPoints states "],
        ),
        (
            "cut within a row",
            good[..good.trim_end().rfind(' ').unwrap()].to_owned(),
            &[": 1 columns, allowed: 2 (X, Y)"],
        ),
        (
            "taper line",
            good.replace("Taperline=70", "Taperline=7000"),
            &[":12: WheelDiameterTaperline = 7000.0000, allowed: 40 to 100 mm"],
        ),
        (
            "header",
            good.replace("Stock=", "Stock"),
            &[":2: \"Stock\", allowed: Key=Value, up to an empty line"],
        ),
        (
            "several parts",
            format!("[FileInfo]\n{good}"),
            &[":1: \"[FileInfo]\", allowed: one profile per file"],
        ),
        (
            "cell",
            good.replace(" 70.000000 ", " 7o.0 "),
            &[": column X: \"7o.0\" is not a number"],
        ),
    ];
    for (kind, text, expected) in cases {
        let error = measured::parse(name, &text, Body::Wheel, &EXACT).unwrap_err();
        assert_says(kind, &error, expected);
    }
}

#[test]
fn simpack_files_say_what_is_wrong_where_and_what_is_allowed() {
    let (name, good) = WHEELS[2];
    let cases: [(&str, String, &[&str]); 9] = [
        (
            "a rail",
            good.replace("type    = 1", "type    = 0"),
            &[":4: type = 0, allowed: 1, a wheel"],
        ),
        (
            "switch",
            good.replace("mirror.y       = 1", "mirror.y       = yes"),
            &[":16: mirror.y = yes, allowed: 0 or 1"],
        ),
        (
            "unit",
            good.replace("units.len.f    = +1.0e+03", "units.len.f    = 0"),
            &[":19: units.len.f = 0, allowed: 1e-3 to 1e6"],
        ),
        (
            "shift",
            good.replace("shift.y        = +2.0e+00", "shift.y        = two"),
            &[":11: shift.y = two, allowed: a number"],
        ),
        (
            "cut short",
            good[..good.rfind("  point.end").unwrap()].to_owned(),
            &[
                "cut short: no complete section `point`",
                "rows y z between point.begin and point.end",
            ],
        ),
        (
            "sections crossed",
            good.replace("  point.end", "  spline.end"),
            &["spline.end", "the end of the current section"],
        ),
        (
            "columns",
            good.replace(" 1.0\n  point.end", " 1.0 1.0\n  point.end"),
            &["4 columns, allowed: 2 or 3 (y, z, weight)"],
        ),
        (
            "cell",
            good.replace("  point.end", "    1 z\n  point.end"),
            &[": column z: \"z\" is not a number"],
        ),
        (
            "stray",
            good.replace("header.end", "header.end\nstray"),
            &[":6: \"stray\", allowed: section.begin, section.end or key = value"],
        ),
    ];
    for (kind, text, expected) in cases {
        let error = measured::parse(name, &text, Body::Wheel, &EXACT).unwrap_err();
        assert_says(kind, &error, expected);
    }
    // Without its sections, no text is a SIMPACK file.
    let error = measured::parse("a.prw", "1 2\n", Body::Wheel, &EXACT).unwrap_err();
    assert_says("bare", &error, &[":1: \"1 2\", allowed: section.begin"]);
}

/// Reads a text in every format and checks the invariants of the resulting profiles.
fn read_as_anything(text: &str, mirror: usize) {
    use dashpot_rail::profile::measured::Mirror;
    for format in Format::ALL {
        for body in [Body::Wheel, Body::Rail] {
            let options = Options::default()
                .with_format(Some(format))
                .with_mirror(Some(Mirror::ALL[mirror]));
            let Ok((profile, reading)) = measured::parse("any", text, body, &options) else {
                continue;
            };
            let points = profile.points();
            assert!(points.windows(2).all(|pair| pair[0].y_m < pair[1].y_m));
            assert!(points.iter().all(|point| point.z_m.is_finite()));
            assert!(reading.overhanging + reading.folded < reading.points);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn no_text_makes_a_reader_panic(
        text in any::<String>(),
        lines in "([-0-9.,;e \t\n\"=#!']|nan|inf|header|spline|point|\\.begin|\\.end|ColumnDef=|MINIPROF|\n\n){0,200}",
        mirror in 0..4_usize,
    ) {
        read_as_anything(&text, mirror);
        read_as_anything(&lines, mirror);
    }

    #[test]
    fn no_damage_makes_a_reader_panic(
        file in 0..8_usize,
        place in any::<prop::sample::Index>(),
        patch in "[-+0-9.e=,a-z_\n\"' ]{0,8}",
        mirror in 0..4_usize,
    ) {
        let (_, text) = [WHEELS, RAILS].concat()[file];
        let mut bytes = text.as_bytes().to_vec();
        let start = place.index(bytes.len());
        let end = (start + patch.len()).min(bytes.len());
        bytes.splice(start..end, patch.bytes());
        read_as_anything(&String::from_utf8_lossy(&bytes), mirror);
    }
}
