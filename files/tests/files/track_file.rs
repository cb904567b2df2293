//! Track files: tables, built-in tracks, and errors with file, line and name.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use dashpot_files::track::{self, IrregularityParameters, TRACKS, TrackParameters};
use dashpot_rail::track::measured::{self, Options};
use dashpot_rail::track::{Band, Defect, Generation, RailDeviation, Rails, Seeds, Spectrum};

fn parse(text: &str) -> Result<TrackParameters, track::TrackFileError> {
    track::parse("line.toml", text, Path::new(""))
}

const STRAIGHT: &str = "name = \"line\"\n\n[[part]]\nkind = \"straight\"\nlength_m = 100\n";

#[test]
fn parts_are_read() {
    let text = format!(
        "{STRAIGHT}
        [[part]]
        kind = \"transition\"
        length_m = 50
        [[part]]
        kind = \"circular\"
        length_m = 200
        radius_m = -400
        cant_m = -0.1\n"
    );
    let layout = parse(&text).unwrap().layout;
    assert_eq!(layout.length_m(), 350.0);
    assert_eq!(layout.at(50.0).curvature_per_m, 0.0);
    let middle = layout.at(125.0);
    assert!((middle.curvature_per_m + 0.5 / 400.0).abs() < 1e-15);
    assert!((middle.cant_m + 0.05).abs() < 1e-15);
    assert_eq!(layout.at(300.0).curvature_per_m, -1.0 / 400.0);
}

#[test]
fn defects_are_read() {
    let text = format!(
        "{STRAIGHT}
        [[defect]]
        kind = \"cosine-dip\"
        rails = \"left\"
        start_m = 1
        length_m = 2
        depth_m = 3e-3
        [[defect]]
        kind = \"alignment-bump\"
        rails = \"right\"
        start_m = 4
        length_m = 5
        offset_m = 6e-3
        [[defect]]
        kind = \"alignment-kink\"
        rails = \"both\"
        start_m = 7
        length_m = 8
        offset_m = 9e-3
        rounding_m = 1
        [[defect]]
        kind = \"twist\"
        start_m = 10
        base_m = 11
        plateau_m = 12
        cross_level_m = 13e-3
        rounding_m = 2\n"
    );
    let expected = vec![
        Defect::CosineDip {
            rails: Rails::Left,
            start_m: 1.0,
            length_m: 2.0,
            depth_m: 3e-3,
        },
        Defect::AlignmentBump {
            rails: Rails::Right,
            start_m: 4.0,
            length_m: 5.0,
            offset_m: 6e-3,
        },
        Defect::AlignmentKink {
            rails: Rails::Both,
            start_m: 7.0,
            length_m: 8.0,
            offset_m: 9e-3,
            rounding_m: 1.0,
        },
        Defect::Twist {
            start_m: 10.0,
            base_m: 11.0,
            plateau_m: 12.0,
            cross_level_m: 13e-3,
            rounding_m: 2.0,
        },
    ];
    let track = parse(&text).unwrap().build().unwrap();
    assert_eq!(track.defects(), expected);
}

#[test]
fn a_spectrum_has_its_seed_band_and_length() {
    let table = "[irregularity]
        spectrum = \"german-low\"
        seed = 7
        wavelength_m = [5, 60]
        length_m = 400
        ramp_m = 30
        spacing_m = 0.5\n";
    let track = parse(&format!("{STRAIGHT}{table}"))
        .unwrap()
        .build()
        .unwrap();
    let expected = Generation::new(Spectrum::german_low())
        .with_band(Band::new(5.0, 60.0))
        .with_seeds(Seeds::from(7))
        .with_length_m(400.0)
        .with_ramp_m(30.0)
        .with_spacing_m(Some(0.5));
    assert_eq!(track.irregularity(), &expected.irregularity().unwrap());
}

fn measured_text() -> String {
    let mut text = String::from("distance_m,vertical_mm\n");
    for i in 0..200 {
        let distance_m = 0.5 * f64::from(i);
        writeln!(text, "{distance_m},{:.3}", 3.0 * distance_m.sin()).unwrap();
    }
    text
}

#[test]
fn a_measured_file_is_relative_to_the_track_file() {
    let folder = tempfile::tempdir().unwrap();
    let text = measured_text();
    fs::create_dir(folder.path().join("measured")).unwrap();
    fs::write(folder.path().join("measured/line.csv"), &text).unwrap();
    let table = "[irregularity]\nfile = \"measured/line.csv\"\nshift_m = 40\nramp_m = 5\n";
    let path = folder.path().join("line.toml");
    fs::write(&path, format!("{STRAIGHT}{table}")).unwrap();
    let track = track::load(path.to_str().unwrap())
        .unwrap()
        .build()
        .unwrap();
    let options = Options::default().with_shift_m(40.0).with_ramp_m(5.0);
    let (expected, _) = measured::parse(&text, &options).unwrap();
    assert_eq!(track.irregularity(), &expected);
}

/// A vehicle of 30 m that starts 15 m before the irregularity ends its run before the smooth end of the irregularity.
#[test]
fn shipped_tracks_are_long_enough_for_their_cases() {
    let class_6 = Spectrum::fra(6).unwrap();
    let german = Spectrum::german_low();
    for (name, speed_km_h, time_s, radius_m, spectrum) in [
        ("straight", 200.0, 5.0, None, class_6),
        ("straight-short", 200.0, 5.0, None, class_6),
        ("straight-german", 200.0, 5.0, None, german),
        ("curve-r200", 100.0, 10.0, Some(200.0), class_6),
        ("curve-r300", 100.0, 10.0, Some(300.0), class_6),
        ("curve-r600", 100.0, 10.0, Some(600.0), class_6),
    ] {
        let parameters = track::load(name).unwrap();
        let IrregularityParameters::Generated { generation, .. } = &parameters.irregularity else {
            panic!("{name}: not generated");
        };
        let behind_m = speed_km_h / 3.6 * time_s;
        assert!(
            behind_m < generation.length_m - generation.ramp_m,
            "{name}: {behind_m}"
        );
        assert_eq!(generation.spectrum, spectrum);
        let end = parameters.layout.at(behind_m);
        let curvature_per_m = radius_m.map_or(0.0, |radius_m| 1.0 / radius_m);
        assert_eq!(end.curvature_per_m, curvature_per_m, "{name}");
        assert_eq!(end.cant_m, radius_m.map_or(0.0, |_| 0.12));
        let track = parameters.build().unwrap();
        assert_eq!(
            track.rails(-0.3 * behind_m),
            [RailDeviation::default(); 2],
            "{name}"
        );
        assert_ne!(
            track.rails(behind_m),
            [RailDeviation::default(); 2],
            "{name}"
        );
    }
    let ideal = track::load("ideal").unwrap().build().unwrap();
    assert_eq!(ideal.rails(300.0), [RailDeviation::default(); 2]);
    assert_eq!(TRACKS.len(), 7);
}

#[test]
fn errors_have_file_line_and_name() {
    let part = |keys: &str| format!("{STRAIGHT}\n[[part]]\n{keys}\n");
    let irregularity = |keys: &str| format!("{STRAIGHT}\n[irregularity]\n{keys}\n");
    let generated = |keys: &str| {
        irregularity(&format!(
            "spectrum = \"fra-6\"\nlength_m = 200\n{keys}wavelength_m = [3, 80]"
        ))
    };
    let cases = [
        (part("kind = \"circlar\""), "line 8, column 8"),
        (part("kind = \"circlar\""), "did you mean `circular`?"),
        (
            part("kind = \"circular\"\nlength_m = 1\nradus_m = 3"),
            "line 10, column 1",
        ),
        (
            part("kind = \"circular\"\nlength_m = 1\nradus_m = 3"),
            "did you mean `radius_m`?",
        ),
        (
            part("kind = \"circular\"\nlength_m = 1\nradius_m = 300"),
            "line.toml:7: part 2 of the layout: a circular part needs `cant_m`",
        ),
        (
            part("kind = \"straight\"\nlength_m = 1\nradius_m = 300"),
            "line.toml:7: part 2 of the layout: a straight part has no `radius_m`",
        ),
        (
            part("kind = \"circular\"\nlength_m = 1\nradius_m = 30\ncant_m = 0"),
            "line.toml:7: part 2 of the layout: magnitude of radius_m 30, allowed: 50 to 1000000",
        ),
        (
            part("kind = \"transition\"\nlength_m = 1"),
            "line.toml:7: part 2 of the layout: a transition must lie between two",
        ),
        (
            format!("{STRAIGHT}\n[[defect]]\nkind = \"twist\"\nrails = \"left\"\nstart_m = 1\n"),
            "line.toml:7: defect 1: a twist has no `rails`",
        ),
        (
            format!(
                "{STRAIGHT}\n[[defect]]\nkind = \"cosine-dip\"\nstart_m = 1\nlength_m = 1\ndepth_m = 1e-3\n"
            ),
            "line.toml:7: defect 1: a cosine dip needs `rails`",
        ),
        (
            format!(
                "{STRAIGHT}\n[[defect]]\nkind = \"cosine-dip\"\nrails = \"both\"\nstart_m = 1\nlength_m = 1\ndepth_m \
                 = 1\n"
            ),
            "line.toml:7: defect 1: depth_m 1, allowed: -0.2 to 0.2",
        ),
        (
            irregularity("spectrum = \"german-hgh\""),
            "line.toml:7: irregularity: spectrum `german-hgh`",
        ),
        (
            irregularity("spectrum = \"german-hgh\""),
            "did you mean `german-high`?",
        ),
        (
            irregularity("spectrum = \"fra-7\""),
            "line.toml:7: irregularity: FRA class 7, allowed: 1 to 6",
        ),
        (
            generated(""),
            "line.toml:7: irregularity: missing `seed`: a spectrum needs",
        ),
        (
            generated("seed = 1\nshift_m = 3\n"),
            "line.toml:7: irregularity: `shift_m` given with `spectrum`, allowed: with `file`",
        ),
        (
            irregularity("file = \"a.csv\"\nseed = 1"),
            "line.toml:7: irregularity: `seed` given with `file`, allowed: with `spectrum`",
        ),
        (
            irregularity(""),
            "line.toml:7: irregularity: give either `spectrum` or `file`",
        ),
    ];
    for (text, expected) in cases {
        let message = parse(&text).unwrap_err().to_string();
        assert!(message.contains("line.toml"), "{message}");
        assert!(message.contains(expected), "{message}\nexpected {expected}");
    }
}

#[test]
fn errors_from_building_have_file_and_line() {
    let table = "\n[irregularity]\nspectrum = \"fra-6\"\nseed = 1\nlength_m = 200\nwavelength_m = [80, 3]\n";
    let error = parse(&format!("{STRAIGHT}{table}"))
        .unwrap()
        .build()
        .unwrap_err();
    let message = error.to_string();
    let expected = "line.toml:7: irregularity: band.shortest_m 80, allowed: 0.3 to";
    assert!(message.starts_with(expected), "{message}");

    let table = "\n[irregularity]\nfile = \"none.csv\"\n";
    let error = parse(&format!("{STRAIGHT}{table}"))
        .unwrap()
        .build()
        .unwrap_err();
    let message = error.to_string();
    let expected = "line.toml:7: none.csv: cannot read";
    assert!(message.starts_with(expected), "{message}");

    let folder = tempfile::tempdir().unwrap();
    let wrong = measured_text().replace("\n1,", "\nx,");
    fs::write(folder.path().join("wrong.csv"), wrong).unwrap();
    let table = "\n[irregularity]\nfile = \"wrong.csv\"\n";
    let parameters = track::parse("line.toml", &format!("{STRAIGHT}{table}"), folder.path());
    let message = parameters.unwrap().build().unwrap_err().to_string();
    let expected = "wrong.csv:4: column distance_m: \"x\"";
    assert!(message.contains(expected), "{message}");
}

#[test]
fn an_unknown_track_suggests_a_similar_one() {
    let message = track::load("curve-r20").unwrap_err().to_string();
    let expected = "track `curve-r20`: no such track or file; give a TOML file or a track: ideal, straight, \
                    straight-short, straight-german, curve-r200, curve-r300, curve-r600; did you mean `curve-r200`?";
    assert_eq!(message, expected);
}
