//! Files of one wheel and one rail in every format give the same profiles, which agree with their definitions.

use dashpot_rail::profile::measured::{self, Format, Mirror, Options, ProfileError, Reading};
use dashpot_rail::profile::{Body, Profile, s1002, uic60};

use crate::common::{EXACT, RAILS, WHEELS};

/// Options for `uic60.rail`, in which `y` points to the track centre.
const GENSYS_RAIL: Options = EXACT.with_mirror(Some(Mirror::Y));

fn read_rail(name: &str, text: &str) -> (Profile, Reading) {
    let options = if name.ends_with(".rail") {
        GENSYS_RAIL
    } else {
        EXACT
    };
    measured::parse(name, text, Body::Rail, &options).unwrap()
}

fn read_wheel(name: &str, text: &str) -> (Profile, Reading) {
    measured::parse(name, text, Body::Wheel, &EXACT).unwrap()
}

/// Asserts that two profiles have the same samples within a micrometre.
fn assert_same(name: &str, profile: &Profile, expected: &Profile) {
    assert_eq!(profile.points().len(), expected.points().len(), "{name}");
    for (p, q) in profile.points().iter().zip(expected.points()) {
        let off = (p.y_m - q.y_m).hypot(p.z_m - q.z_m);
        assert!(off < 1e-6, "{name}: {p:?}, expected {q:?}");
    }
}

#[test]
fn a_wheel_is_the_same_in_every_format() {
    let (expected, _) = read_wheel(WHEELS[0].0, WHEELS[0].1);
    for (name, text) in WHEELS {
        let (profile, reading) = read_wheel(name, text);
        assert_eq!(profile.name(), "s1002");
        assert_same(name, &profile, &expected);
        // Only the MiniProf file contains the back and the face of the wheel.
        let overhanging = if name.ends_with(".whl") { 6 } else { 0 };
        assert_eq!(reading.overhanging, overhanging, "{name}");
        assert_eq!((reading.folded, reading.turned), (0, false), "{name}");
    }
    for i in -6800..6000 {
        let y_mm = f64::from(i) * 0.01;
        let off = expected.at(y_mm * 1e-3).z_m * 1e3 - s1002::depth_mm(y_mm);
        // Sections B and C join with a kink, which a spline smooths over 0.8 mm.
        assert!(off.abs() < 5e-3, "{y_mm}: {off} mm");
    }
}

#[test]
fn a_rail_is_the_same_in_every_format() {
    let (expected, _) = read_rail(RAILS[0].0, RAILS[0].1);
    for (name, text) in RAILS {
        let (profile, reading) = read_rail(name, text);
        assert_same(name, &profile, &expected);
        // Only the MiniProf file contains the web and the foot of the rail. It is upside down.
        let is_miniprof = name.ends_with(".ban");
        let overhanging = if is_miniprof { 15 } else { 0 };
        assert_eq!(reading.overhanging, overhanging, "{name}");
        assert_eq!((reading.folded, reading.turned), (0, is_miniprof), "{name}");
    }
    // The gauge side extends deeper than the field side, so no reader has swapped them.
    let ends = [
        expected.points()[0],
        expected.points()[expected.points().len() - 1],
    ];
    assert!(ends[0].z_m > 0.035 && ends[1].z_m < 0.0301, "{ends:?}");
    for i in 0..600 {
        let [y_mm, z_mm] = uic60::position_mm(f64::from(i) * 0.1);
        if z_mm < 29.0 {
            for y_mm in [y_mm, -y_mm] {
                let sample = expected.at(y_mm * 1e-3);
                let off = (sample.z_m * 1e3 - z_mm) * sample.angle_rad.cos();
                assert!(off.abs() < 5e-3, "{y_mm}: {off} mm");
            }
        }
    }
}

#[test]
fn the_content_determines_the_format_before_the_extension() {
    let formats = [
        Format::Columns,
        Format::MiniProf,
        Format::Simpack,
        Format::Gensys,
    ];
    assert_eq!(formats, Format::ALL);
    for files in [WHEELS, RAILS] {
        for ((name, text), format) in files.into_iter().zip(formats) {
            let extension = name.split('.').nth(1);
            assert_eq!(Format::detect(text, extension), format, "{name}");
            let by_content = if format == Format::Gensys {
                Format::Columns
            } else {
                format
            };
            assert_eq!(Format::detect(text, None), by_content, "{name}");
            assert_eq!(format.name().parse(), Ok(format));
        }
    }
    assert_eq!(Format::detect("0 1\n", Some("BAN")), Format::MiniProf);
    assert_eq!(Format::detect("0 1\n", Some("prr")), Format::Simpack);
    let unknown = "vampire".parse::<Format>().unwrap_err().to_string();
    assert!(
        unknown.contains("vampire") && unknown.contains("gensys"),
        "{unknown}"
    );
}

#[test]
fn a_stated_format_overrides_the_content() {
    let gensys = EXACT.with_format(Some(Format::Gensys));
    let (name, text) = WHEELS[3];
    let (expected, _) = read_wheel(name, text);
    let (stated, _) = measured::parse("s1002.txt", text, Body::Wheel, &gensys).unwrap();
    assert_same("stated", &stated, &expected);
    let unstated = measured::parse("s1002.txt", text, Body::Wheel, &EXACT).unwrap_err();
    assert_eq!(unstated, ProfileError::FlangeOutside);
}

#[test]
fn a_mirror_changes_the_side_in_the_axes_of_the_file() {
    let mirrored = |mirror| EXACT.with_mirror(Some(mirror));
    let deeper_at = |options: &Options, (name, text): (&str, &str)| {
        let (rail, _) = measured::parse(name, text, Body::Rail, options).unwrap();
        let points = rail.points();
        points[0].z_m > points[points.len() - 1].z_m
    };
    // Without a mirror, the deeper gauge side is at negative y.
    for file in [RAILS[0], RAILS[1], RAILS[2]] {
        assert!(deeper_at(&EXACT, file), "{}", file.0);
        assert!(!deeper_at(&mirrored(Mirror::Y), file), "{}", file.0);
    }
    // A MiniProf rail may be either way up: a rotation by 180 degrees changes nothing, one mirrored axis swaps the
    // sides.
    assert!(deeper_at(&mirrored(Mirror::Yz), RAILS[1]));
    assert!(!deeper_at(&mirrored(Mirror::Z), RAILS[1]));
    let over = |mirror| {
        let (name, text) = RAILS[0];
        measured::parse(name, text, Body::Rail, &mirrored(mirror)).unwrap_err()
    };
    assert_eq!(over(Mirror::Z), ProfileError::HeadDown);
    for mirror in Mirror::ALL {
        assert_eq!(mirror.name().parse(), Ok(mirror));
    }
    assert!("x".parse::<Mirror>().is_err());
}

#[test]
fn the_side_of_a_gensys_rail_must_be_stated() {
    let (name, text) = RAILS[3];
    let error = measured::parse(name, text, Body::Rail, &EXACT).unwrap_err();
    assert_eq!(error, ProfileError::MirrorNotStated);
    assert!(error.to_string().contains("option mirror"), "{error}");
}

#[test]
fn an_old_miniprof_header_is_free_text_up_to_the_empty_line() {
    let (_, text) = WHEELS[1];
    let (_, rows) = text.split_once("\r\n\r\n").unwrap();
    let old =
        format!("MINIPROF 101 148 1994 3 24\nStock.......:\n32.5 28.1 10.8  (Sd/Sh/qR)\n\n{rows}");
    assert_eq!(Format::detect(&old, None), Format::MiniProf);
    let (expected, _) = read_wheel(WHEELS[0].0, WHEELS[0].1);
    assert_same("old", &read_wheel("old.whl", &old).0, &expected);
    // Without a header, the extension determines the format.
    assert_same("bare", &read_wheel("bare.whl", rows).0, &expected);
}

#[test]
fn the_steps_of_a_simpack_file_are_applied_in_order() {
    let (_, text) = RAILS[2];
    let with = |key: &str, value: &str| {
        let text = text.replace("point.begin", &format!("{key} = {value}\n  point.begin"));
        measured::parse("uic60.prr", &text, Body::Rail, &EXACT).unwrap()
    };
    let points = with("comment", "'none'").1.points;
    // Bounds apply after the rotation, in the unit of the file, m: the field side ends at 20 mm.
    let text_of_bounds = "-1\n  bound.y.max = 0.020\n  bound.y.min";
    let (cut, reading) = with("bound.y.min", &format!("{text_of_bounds} = -1"));
    let last = cut.points()[cut.points().len() - 1];
    assert!(
        reading.points < points && last.y_m <= 0.020 && last.y_m > 0.019,
        "{last:?}"
    );
    // Removes points within 1 mm of the previous kept point: every other one at a spacing of 0.8 mm.
    let (_, thinned) = with("point.dist.min", "1e-3");
    assert_eq!(thinned.points, points.div_ceil(2));
    // The bounds apply while z still points up: points deeper than 20 mm are removed.
    let (shallow, _) = with("bound.z.max", "1\n  bound.z.min = -0.020");
    let deepest = shallow
        .points()
        .iter()
        .map(|point| point.z_m)
        .fold(0.0, f64::max);
    assert!((0.019..0.021).contains(&deepest), "{deepest}");
}
