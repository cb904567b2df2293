//! Regression: a text cut off inside the last number of its last line (1250.5 to 125) was read silently.

use std::io::{Cursor, Write};
use std::path::Path;

use dashpot_recording::{Channels, ForceHistory, Measurement};

use crate::common::{dashpot, json_of, text_of};

/// Returns the number of the line that is reported as incomplete.
fn unended(bytes: &[u8]) -> Option<u64> {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    let mut measurement =
        Measurement::read(Path::new("run.csv"), source, &Channels::default()).unwrap();
    assert!(!measurement.read_all().unwrap().is_empty());
    measurement.gaps().unended_line
}

fn in_utf_16(text: &str) -> Vec<u8> {
    let units = text.encode_utf16();
    [0xfffe_u16.swap_bytes()]
        .into_iter()
        .chain(units)
        .flat_map(u16::to_le_bytes)
        .collect()
}

fn in_gzip(bytes: &[u8]) -> Vec<u8> {
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gzip.write_all(bytes).unwrap();
    gzip.finish().unwrap()
}

#[test]
fn an_incomplete_last_line_is_named() {
    let header = "time_s,displacement_m,force_n";
    let cases = [
        (format!("{header}\n0,0,1\n1,0,1250.5\n"), None),
        (format!("{header}\n0,0,1\n1,0,125"), Some(3)),
        (format!("{header}\r\n0,0,1\r\n1,0,1250.5\r\n"), None),
        (format!("{header}\r\n0,0,1\r\n1,0,125"), Some(3)),
        (format!("{header}\r0,0,1\r1,0,1250.5\r"), None),
        (format!("# logger\n\n{header}\n0,0,1\n1,0,125"), Some(5)),
        // A single row.
        (format!("{header}\n0,0,125"), Some(2)),
        (format!("{header}\ns,m,N\n0,0,125"), Some(3)),
        // The last line is not a row.
        (format!("{header}\n0,0,1\n1,0,1250.5\n# end\n"), None),
        (format!("{header}\n0,0,1\n1,0,1250.5\n\n\n"), None),
        // A closing quote shows that the number is complete, but not that the row is.
        (format!("{header}\n0,0,1\n1,0,\"125\""), Some(3)),
    ];
    for (text, expected) in cases {
        assert_eq!(unended(text.as_bytes()), expected, "{text:?}");
        assert_eq!(unended(&in_gzip(text.as_bytes())), expected, "{text:?}");
        let marked = [b"\xef\xbb\xbf", text.as_bytes()].concat();
        // A comment must start its line, so a text that begins with one gets no mark.
        if !text.starts_with('#') {
            assert_eq!(unended(&marked), expected, "{text:?} with a mark");
            assert_eq!(unended(&in_utf_16(&text)), expected, "{text:?} in UTF-16");
        }
    }
    // This text is longer than the part that is examined first.
    let rows: String = (0..9000).map(|i| format!("{i},0.5,1250.5\n")).collect();
    let text = format!("{header}\n{rows}");
    assert_eq!(unended(text.as_bytes()), None);
    assert_eq!(unended(&text.as_bytes()[..text.len() - 3]), Some(9001));
}

/// `vehicle --outside` reports the incomplete last line of recorded forces in the same way.
#[test]
fn recorded_forces_name_an_incomplete_last_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("force.csv");
    for (rows, expected) in [("0,0\n1,125", Some(3)), ("0,0\n1,1250.5\n", None)] {
        std::fs::write(&path, format!("time_s,force_n\n{rows}")).unwrap();
        let history = ForceHistory::open(&path, 0.0..=1.0).unwrap();
        assert_eq!(history.unended_line(), expected);
    }
}

#[test]
fn the_commands_warn() {
    let folder = tempfile::tempdir().unwrap();
    let rows: String = (0..200)
        .map(|i| format!("{},{},1\n", f64::from(i) / 1e3, 1e-3 * f64::from(i % 7)))
        .collect();
    let text = format!("time_s,displacement_m,force_n\n{rows}0.2,0.0012,1");
    std::fs::write(folder.path().join("run.csv"), text).unwrap();
    let warning = "warning: the last line, line 202, has no line end: the file may have been cut off inside its last \
     number";
    for arguments in [
        &["replay", "--input", "run.csv", "--output", "force.csv"][..],
        &["verify", "--input", "run.csv"],
        &["channels", "run.csv"],
    ] {
        let text = text_of(&dashpot(arguments, folder.path()).success());
        assert!(text.contains(warning), "{arguments:?}: {text}");
        let json = [arguments, &["--format", "json"]].concat();
        let report = json_of(&dashpot(&json, folder.path()).success());
        let gaps = match arguments[0] {
            "channels" => &report,
            _ => &report["gaps"],
        };
        assert_eq!(gaps["unended_line"], 202);
    }
    let whole = std::fs::read_to_string(folder.path().join("run.csv")).unwrap() + "\n";
    std::fs::write(folder.path().join("run.csv"), whole).unwrap();
    let ended = dashpot(&["channels", "run.csv"], folder.path()).success();
    assert!(!text_of(&ended).contains("line end"));
}
