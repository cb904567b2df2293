//! Remedies and texts of errors.

use std::io::Cursor;
use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::{
    Channels, Measurement, Quantity, Recording, Remedy, Sample, Separator, remedy,
};

fn error_with(text: &str, channels: &Channels) -> FileError {
    let source = Box::new(Cursor::new(text.as_bytes().to_vec()));
    Measurement::read(Path::new("run7.csv"), source, channels)
        .and_then(|mut measurement| measurement.read_all())
        .expect_err("an invalid file")
}

fn error_of(text: &str) -> FileError {
    error_with(text, &Channels::default())
}

#[test]
fn each_error_has_the_remedy_that_resolves_it() {
    let header = "time_s;displacement_m;force_n\n";
    for (text, expected) in [
        (
            "0.5;1;2\n",
            Some(Remedy::NumberChannel {
                quantity: Quantity::Time,
                count: 3,
            }),
        ),
        (
            "time_s;x;force_n\n0;0;0\n",
            Some(Remedy::NameChannel(Quantity::Displacement)),
        ),
        (
            "time;displacement_m;force_n\n0;0;0\n",
            Some(Remedy::GiveUnit(Quantity::Time)),
        ),
        (
            "time_s;displacement_m;force_n\ns;m;kN\n0;0;0\n",
            Some(Remedy::GiveUnit(Quantity::Force)),
        ),
        (
            "time_s;displacement [furlong];force_n\n0;0;0\n",
            Some(Remedy::OverrideUnit(Quantity::Displacement)),
        ),
        ("0;1;2\n", Some(Remedy::SayWhetherHeader)),
        (
            &format!("{header}0,1;0.2;0\n"),
            Some(Remedy::GiveDecimalMark),
        ),
        (&format!("{header}0;;0\n"), Some(Remedy::SkipInvalid)),
        (&format!("{header}0;x;0\n"), None),
        (&format!("{header}0;0\n"), None),
        ("", None),
    ] {
        let error = error_of(text);
        assert_eq!(remedy(&error), expected, "{text:?}: {error}");
    }
}

/// Among the groups of a file, text has none to choose.
#[test]
fn a_group_of_a_text_is_an_error_that_asks_for_another_group() {
    let grouped = Channels {
        group: Some("2".into()),
        ..Channels::default()
    };
    let error = error_with("time_s,displacement_m,force_n\n0,0,0\n", &grouped);
    assert_eq!(remedy(&error), Some(Remedy::NameGroup));
    let expected = "run7.csv: group `2` is missing or ambiguous; groups (by number or name): none in this file";
    assert_eq!(error.to_string(), expected);
}

/// A row with twice as many cells as the header has decimal commas only if commas separate its cells.
#[test]
fn the_wrong_number_of_cells_is_explained() {
    let hint = "; if the numbers have a decimal comma, quote them or separate the cells by another character";
    for (row, mark, separator, expected) in [
        ("0,0,0,0,0,0", ',', Separator::Comma, hint),
        ("0,0,0,0,0", ',', Separator::Comma, " (separated by commas)"),
        (
            "0;0;0;0;0;0",
            ';',
            Separator::Semicolon,
            " (separated by semicolons)",
        ),
        ("0\t0", '\t', Separator::Tab, " (separated by tabs)"),
        ("0|0", '|', Separator::Bar, " (separated by bars)"),
        ("0 0", ' ', Separator::Spaces, " (separated by spaces)"),
    ] {
        let mut channels = Channels::default();
        channels.text.separator = Some(separator);
        let header = "time_s,displacement_m,force_n".replace(',', &mark.to_string());
        let error = error_with(&format!("{header}\n{row}\n"), &channels).to_string();
        let cells = row.split(mark).count();
        let expected = format!("run7.csv: line 2: {cells} cells, but the header has 3{expected}");
        assert_eq!(error, expected);
    }
}

#[test]
fn a_message_lists_twelve_columns_and_counts_the_rest() {
    let header = |count: usize| {
        let names: Vec<String> = (1..=count).map(|number| format!("c{number}")).collect();
        names.join(",")
    };
    let listed = "`c1`, `c2`, `c3`, `c4`, `c5`, `c6`, `c7`, `c8`, `c9`, `c10`, `c11`, `c12`";
    for (count, expected) in [
        (12, listed.to_owned()),
        (13, format!("{listed}, 1 more")),
        (20, format!("{listed}, 8 more")),
    ] {
        let error = error_of(&format!("{}\n", header(count))).to_string();
        let expected = format!("run7.csv: column time_s is missing; the file has {expected}");
        assert_eq!(error, expected);
    }
}

/// Columns without a name are named by their number, from 1.
#[test]
fn a_column_without_a_name_is_named_by_its_number() {
    let mut channels = Channels::default();
    for (channel, number) in [
        (&mut channels.time, "1"),
        (&mut channels.displacement, "2"),
        (&mut channels.force, "3"),
    ] {
        channel.name = Some(number.into());
    }
    channels.time.unit = Quantity::Time.unit("s");
    channels.force.unit = Quantity::Force.unit("N");
    let error = error_with("0.5,1,2\n", &channels).to_string();
    let expected = "run7.csv: the file does not state the unit of 2";
    assert_eq!(error, expected);
    // The last number is that of the last column.
    channels.force.name = Some("4".into());
    let error = error_with("time_s,displacement_m,force_n\n0,0,0\n", &channels).to_string();
    let expected =
        "run7.csv: column 4 is missing; the file has `time_s`, `displacement_m`, `force_n`";
    assert_eq!(error, expected);
}

#[test]
fn skipping_more_lines_than_the_text_has_leaves_nothing() {
    let mut channels = Channels::default();
    channels.text.skip_lines = 9;
    let error = error_with("time_s,displacement_m,force_n\n0,0,0\n", &channels).to_string();
    assert!(error.starts_with("run7.csv: the file is empty"), "{error}");
}

/// The chosen name of a column is not completed by a standard name.
#[test]
fn only_columns_that_are_not_chosen_are_found_by_their_quantity() {
    let mut channels = Channels::default();
    channels.displacement.name = Some("way".into());
    let error = error_with("time [s],displacement [m],force [N]\n0,0,0\n", &channels);
    let expected =
        "run7.csv: column way is missing; the file has `time [s]`, `displacement [m]`, `force [N]`";
    assert_eq!(error.to_string(), expected);
}

#[test]
fn a_column_with_the_default_name_is_preferred() {
    let text = "time_s,displacement [m],displacement_m,force_n\n0,1,2,3\n";
    let source = Box::new(Cursor::new(text.as_bytes().to_vec()));
    let mut recording = Recording::read(Path::new("run7.csv"), source).expect("a text");
    let sample = recording.next_sample().expect("a valid row");
    assert_eq!(sample.expect("a row").displacement_m, 2.0);
}

/// The name of a quantity alone, or with its unit, is a standard name; other names that start with it are not.
#[test]
fn names_that_only_start_with_a_quantity_are_not_found() {
    for name in [
        "displacement_left_mm",
        "displacement_max",
        "displacements_mm",
        "displacementmm",
    ] {
        let error = error_of(&format!("time_s,{name} [mm],force_n\n0,0,0\n")).to_string();
        assert!(
            error.starts_with("run7.csv: column displacement_m is missing"),
            "{error}"
        );
    }
}

/// Brackets with anything but a unit belong to the name of a column.
#[test]
fn words_in_parentheses_or_after_a_slash_are_not_units() {
    let text = "time_s,displacement_m,force (left),force / max,force_n\n0,0,1,2,3\n";
    for (name, force_n) in [("force (left)", 1.0), ("force / max", 2.0)] {
        let mut channels = Channels::default();
        channels.force.name = Some(name.into());
        let error = error_with(text, &channels).to_string();
        let expected = format!("run7.csv: the file does not state the unit of {name}");
        assert_eq!(error, expected);
        channels.force.unit = Quantity::Force.unit("N");
        let source = Box::new(Cursor::new(text.as_bytes().to_vec()));
        let measurement = Measurement::read(Path::new("run7.csv"), source, &channels);
        let sample = measurement.expect("a text").next_sample();
        let sample = sample.expect("a valid row").expect("a row");
        assert_eq!(sample.force_n, force_n);
    }
}

/// An ending such as `_mm` is a unit only behind a name.
#[test]
fn units_have_names_and_end_the_names_of_columns() {
    let names = |quantity: Quantity| {
        let names: Vec<&str> = quantity.units().iter().map(|unit| unit.name()).collect();
        names.join(" ")
    };
    assert_eq!(names(Quantity::Time), "s ms us ns min");
    assert_eq!(names(Quantity::Displacement), "m cm mm um in");
    assert_eq!(names(Quantity::Force), "N daN kN MN lbf");
    let unit = |name: &str| Quantity::Displacement.unit_in_name(name);
    assert_eq!(unit("x_mm"), Quantity::Displacement.unit("mm"));
    assert_eq!(unit("_mm"), None);
    assert_eq!(unit("x_kn"), None);
}

/// A recording in memory has its place in errors too.
#[test]
fn errors_of_samples_in_memory_name_the_row() {
    let sample = |time_s: f64| Sample {
        time_s,
        displacement_m: 0.0,
    };
    let samples = std::rc::Rc::new(vec![sample(0.0), sample(1.0), sample(1.0)]);
    let mut recording = Recording::from_samples(Path::new("motion"), samples);
    let error = recording.read_all().expect_err("a repeated time");
    let expected =
        "motion: row 3: column time_s: time 1 s does not increase; the previous row has 1 s";
    assert_eq!(error.to_string(), expected);
}
