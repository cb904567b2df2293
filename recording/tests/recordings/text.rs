//! Variants of text recordings: detected properties, chosen options and errors.

use std::io::{Cursor, Write};
use std::path::Path;

use dashpot_recording::{
    Channel, Channels, DecimalMark, MeasuredSample, Measurement, Quantity, Recording, Separator,
};
use flate2::Compression;
use flate2::write::GzEncoder;

/// Name and unit of a channel; empty for the default.
struct Choice(&'static str, &'static str);

/// Selects channels by name and unit.
fn channels(time: Choice, displacement: Choice, force: Choice) -> Channels {
    let channel = |quantity: Quantity, Choice(name, unit): Choice| Channel {
        name: Some(name.to_owned()).filter(|name| !name.is_empty()),
        unit: quantity.unit(unit),
        reversed: false,
    };
    Channels {
        time: channel(Quantity::Time, time),
        displacement: channel(Quantity::Displacement, displacement),
        force: channel(Quantity::Force, force),
        ..Channels::default()
    }
}

fn german() -> Channels {
    channels(Choice("Zeit", ""), Choice("Weg", ""), Choice("Kraft", ""))
}

fn measured(bytes: &[u8], channels: &Channels) -> Result<Vec<[f64; 3]>, String> {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    let rows = Measurement::read(Path::new("run7.csv"), source, channels)
        .and_then(|mut measurement| measurement.read_all());
    let row = |row: MeasuredSample| [row.time_s, row.displacement_m, row.force_n];
    rows.map(|rows| rows.into_iter().map(row).collect())
        .map_err(|error| error.to_string())
}

fn error_of(text: &str, channels: &Channels) -> String {
    measured(text.as_bytes(), channels).expect_err("an invalid file")
}

/// Rows of all valid files below: time (s), displacement (m) and force (N).
const ROWS: [[f64; 3]; 3] = [
    [0.0, 0.0, 0.0],
    [1e-3, 1.5e-3, 1250.0],
    [2e-3, -0.25e-3, -800.0],
];

#[test]
fn separators_decimal_marks_and_units_are_detected() {
    let texts = [
        "time_s,displacement_m,force_n\n0,0,0\n0.001,0.0015,1250\n0.002,-0.00025,-8e2\n",
        // Other columns, in any order, and a separator at the end of rows are ignored.
        "force_kn;note;displacement_mm;time_ms\r\n0;a;0;0;\r\n1.25;b,c;1.5;1;\r\n-0.8;;-0.25;2;\r\n",
        "# logger 7\ntime [ms]\tdisplacement [mm]\tforce [kN]\n0\t0\t0\n1,0\t1,5\t1,25\n2,0\t-0,25\t-0,8\n",
        "time;displacement;force\ns;mm;daN\n0;0;0\n1E-3;1.5;125\n2E-3;-.25;-80\n",
        "time;displacement;force\n[us];[\u{b5}m];[kN]\n0;0;0\n1000;1500;1,25\n2000;-250;-0,8\n",
        "\"time [s]\",\"displacement [mm]\",\"force (N)\"\n0,0,0\n\"0,001\",\"1,5\",1250\n\"0,002\",\"-0,25\",-800\n",
        "time_ms  displacement_mm   force_n\n 0  0 0\n 1  1.5  1250\n  2 -0.25 -800 \n",
        "time / ms|displacement / mm|force / N\n0|0|0\n1|1.5|1250\n2|-0.25|-800\n",
    ];
    for text in texts {
        let rows = measured(text.as_bytes(), &Channels::default());
        assert_eq!(rows.as_deref(), Ok(&ROWS[..]), "{text}");
    }
}

#[test]
fn columns_are_chosen_by_name_or_number() {
    let text = "Zeit [ms];Weg [mm];Kraft [kN]\n0;0;0\n1;1,5;1,25\n2;-0,25;-0,8\n";
    let choices = [
        german(),
        channels(
            Choice("Zeit [ms]", ""),
            Choice("Weg [mm]", "mm"),
            Choice("3", ""),
        ),
        channels(Choice("1", "ms"), Choice("2", ""), Choice("Kraft", "kN")),
    ];
    for choice in choices {
        assert_eq!(measured(text.as_bytes(), &choice).as_deref(), Ok(&ROWS[..]));
    }
    // Without a header, columns can be chosen only by number.
    let (_, bare) = text.split_once('\n').unwrap();
    let numbers = channels(Choice("1", "ms"), Choice("2", "mm"), Choice("3", "kN"));
    assert_eq!(
        measured(bare.as_bytes(), &numbers).as_deref(),
        Ok(&ROWS[..])
    );
    // A chosen unit replaces the one stated in the file.
    let micro = channels(Choice("Zeit", ""), Choice("Weg", "um"), Choice("Kraft", ""));
    let rows = measured(text.as_bytes(), &micro).unwrap();
    assert_eq!(rows[1][1], 1.5e-6);
}

#[test]
fn reversed_channels_change_their_sign() {
    let mut channels = Channels::default();
    channels.displacement.reversed = true;
    channels.force.reversed = true;
    let text = b"time_s,displacement_m,force_n\n0,1e-3,-5\n";
    assert_eq!(measured(text, &channels), Ok(vec![[0.0, -1e-3, 5.0]]));
}

#[test]
fn encodings_and_gzip_are_detected() {
    let text = "Zeit [\u{b5}s];Weg [\u{b5}m];Kraft [kN];Temperatur [\u{b0}C]\n\
        0;0;0;20\n1000;1500;1,25;20\n2000;-250;-0,8;20\n";
    let utf_16 = |bytes: fn(u16) -> [u8; 2], mark: &str| -> Vec<u8> {
        let text = format!("{mark}{text}");
        text.encode_utf16().flat_map(bytes).collect()
    };
    let latin_1: Vec<u8> = text.chars().map(|c| c as u8).collect();
    let with_mark = format!("\u{feff}{text}").into_bytes();
    let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
    gzip.write_all(&utf_16(u16::to_le_bytes, "\u{feff}"))
        .unwrap();
    // Two members, as `cat a.gz b.gz` creates.
    let (first, second) = text.split_at(50);
    let members = [first, second].map(|part| {
        let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
        gzip.write_all(part.as_bytes()).unwrap();
        gzip.finish().unwrap()
    });
    let files = [
        text.as_bytes().to_vec(),
        with_mark,
        latin_1,
        utf_16(u16::to_le_bytes, "\u{feff}"),
        utf_16(u16::to_be_bytes, "\u{feff}"),
        utf_16(u16::to_le_bytes, ""),
        utf_16(u16::to_be_bytes, ""),
        gzip.finish().unwrap(),
        members.concat(),
    ];
    for (number, bytes) in files.into_iter().enumerate() {
        let rows = measured(&bytes, &german());
        assert_eq!(rows.as_deref(), Ok(&ROWS[..]), "file {number}");
    }
}

#[test]
fn damaged_compression_is_reported() {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
    let rows: String = (0..5000)
        .map(|i| format!("{i},{}\n", i * 7919 % 1000))
        .collect();
    write!(gzip, "time_s,displacement_m\n{rows}").unwrap();
    let complete = gzip.finish().unwrap();
    let mut wrong_checksum = complete.clone();
    let index = wrong_checksum.len() - 6;
    wrong_checksum[index] ^= 1;
    for bytes in [
        &complete[..complete.len() / 2],
        &complete[..complete.len() - 4],
        &wrong_checksum,
    ] {
        let source = Box::new(Cursor::new(bytes.to_vec()));
        let read = Recording::read(Path::new("run7.csv.gz"), source)
            .and_then(|mut recording| recording.read_all());
        let error = read.expect_err("damaged").to_string();
        let expected = "run7.csv.gz: cannot read: the gzip compression is damaged or cut off";
        assert!(error.starts_with(expected), "{error}");
    }
}

#[test]
fn ambiguous_properties_are_errors() {
    let none = Channels::default();
    let cases = [
        (
            "time,displacement_m,force_n\n0,0,0\n",
            "the file does not state the unit of time",
        ),
        (
            "time_s,displacement [furlong],force_n\n0,0,0\n",
            "the unknown unit `furlong` for displacement; known units of displacement: m, cm, mm, um, in",
        ),
        (
            "time_s;displacement_m;force_n\ns;mm;N\n0;0;0\n",
            "column displacement_m has the unit `mm`, but its name ends with another unit",
        ),
        (
            "time_s,displacement [m],displacement [mm],force_n\n0,0,0,0\n",
            "displacement: several channels match: `displacement [m]`, `displacement [mm]`",
        ),
        (
            "time_s,x,force_n\n0,0,0\n",
            "column displacement_m is missing; the file has `time_s`, `x`, `force_n`",
        ),
        (
            "0.5,1,2\n0.6,1,2\n",
            "no header says which column is the time",
        ),
        (
            "0,1,2\n1,2,3\n",
            "`0 1 2` could be the header or the first row",
        ),
        (
            "time_s;displacement_m;force_n\n0,1;0.2;0\n",
            "run7.csv:2: column displacement_m: `0.2` has a decimal point, unlike the numbers before it",
        ),
        (
            "time_s;displacement_m;force_n\n0;1.234,5;0\n",
            "run7.csv:2: column displacement_m: `1.234,5` is not a finite number",
        ),
    ];
    for (text, expected) in cases {
        let error = error_of(text, &none);
        assert!(error.contains(expected), "`{error}` lacks `{expected}`");
    }
    let same = channels(
        Choice("", ""),
        Choice("2", "m"),
        Choice("displacement_m", "N"),
    );
    let error = error_of("time_s,displacement_m\n0,0\n", &same);
    assert!(
        error.contains("displacement and force: both are column"),
        "{error}"
    );
}

#[test]
fn chosen_options_replace_detected_properties() {
    let mut chosen = channels(Choice("1", "s"), Choice("2", "m"), Choice("3", "N"));
    chosen.text.header = Some(false);
    let rows = measured(b"0,1,2\n1,2,3\n", &chosen);
    assert_eq!(rows, Ok(vec![[0.0, 1.0, 2.0], [1.0, 2.0, 3.0]]));
    chosen.text.header = Some(true);
    // pandas names unnamed columns 0, 1, 2 and so on.
    let error = error_of("0,1,2\n1,2,3\n", &chosen);
    let expected = "time: `1` is the name of column #2 and the number of another; write #2 or #1";
    assert!(error.contains(expected), "{error}");
    let mut chosen = channels(Choice("#1", "s"), Choice("#2", "m"), Choice("#3", "N"));
    chosen.text.header = Some(true);
    assert_eq!(
        measured(b"0,1,2\n1,2,3\n", &chosen),
        Ok(vec![[1.0, 2.0, 3.0]])
    );

    let mut preamble = Channels::default();
    preamble.text.skip_lines = 2;
    let text = "Versuch;7\n\ntime_s;displacement_m;force_n\n0;0;x\n";
    assert!(error_of(text, &preamble).starts_with("run7.csv:4: column force_n: `x`"));

    let mut pointed = Channels::default();
    pointed.text.decimal_mark = Some(DecimalMark::Point);
    let error = error_of("time_s;displacement_m;force_n\n0,5;0;0\n", &pointed);
    assert!(error.contains("`0,5` has a decimal comma"), "{error}");
    pointed.text.separator = Some(Separator::Comma);
    let error = error_of("time_s;displacement_m;force_n\n0;0;0\n", &pointed);
    assert!(error.contains("column time_s is missing"), "{error}");
}

#[test]
fn rows_with_missing_values_are_errors_or_omitted() {
    let text = "time_s,displacement_m,force_n\n0,0,0\n1,,5\n2,nan,5\n3,0,5\n";
    let error = error_of(text, &Channels::default());
    let expected = "run7.csv:3: column displacement_m: `` is not a finite number";
    assert!(error.starts_with(expected), "{error}");
    let skipping = Channels {
        skip_invalid: true,
        ..Channels::default()
    };
    let source = Box::new(Cursor::new(text.as_bytes().to_vec()));
    let mut measurement = Measurement::read(Path::new("run7.csv"), source, &skipping).unwrap();
    assert_eq!(measurement.read_all().unwrap().len(), 2);
    let left_out = serde_json::to_value(measurement.gaps().left_out).unwrap();
    assert_eq!(
        left_out,
        serde_json::json!({ "rows": 2, "first": { "line": 3 } })
    );
    // A word is not a missing value.
    let error = error_of(&text.replace("nan", "off"), &skipping);
    assert!(
        error.starts_with("run7.csv:4: column displacement_m: `off`"),
        "{error}"
    );
}
