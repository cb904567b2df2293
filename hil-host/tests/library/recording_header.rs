//! What is reported of a recording that is another kind of file.

use std::io::Cursor;
use std::path::Path;

use dashpot_hil::files::recording::Recording;

/// What reading all of `bytes` says.
fn error_of(bytes: &[u8]) -> String {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    Recording::read(Path::new("run7.csv"), source)
        .and_then(|mut recording| recording.read_all())
        .expect_err("another kind of file")
        .to_string()
}

fn utf_16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    text.encode_utf16().flat_map(bytes).collect()
}

#[test]
fn another_kind_of_file_is_reported_by_name() {
    let header = "time_s,displacement_m\n0,0\n";
    let with_mark = format!("\u{feff}{header}");
    let cases: [(&[u8], &str); 10] = [
        (
            b"time_s;displacement_m\n0.1;0.2\n",
            "run7.csv: the cells are separated by semicolons (found `time_s;displacement_m`)",
        ),
        (
            b"time_s;displacement_m\r\n0,1;0,2\r\n",
            "the cells are separated by semicolons and the numbers have a decimal comma",
        ),
        (
            b"time_s;displacement_m\n",
            "the cells are separated by semicolons (found",
        ),
        (
            b"time_s\tdisplacement_m\n0.1\t0.2\n",
            "the cells are separated by tabs (found `time_s\\tdisplacement_m`)",
        ),
        (
            b"time_s\tdisplacement_m\n0,1\t0,2\n",
            "the cells are separated by tabs and the numbers have a decimal comma",
        ),
        (
            &utf_16(&with_mark, u16::to_le_bytes),
            "the file is UTF-16 text (it starts with that byte order mark)",
        ),
        (
            &utf_16(&with_mark, u16::to_be_bytes),
            "the file is UTF-16 text (it starts with that byte order mark)",
        ),
        (
            &utf_16(header, u16::to_le_bytes),
            "the file is UTF-16 text (between the letters are zero bytes)",
        ),
        (
            &utf_16(header, u16::to_be_bytes),
            "the file is UTF-16 text (between the letters are zero bytes)",
        ),
        (
            b"\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x2b\xc9\xcc\x4d\x8d\x2f\x06",
            "the file is compressed with gzip (it starts with 1f 8b)",
        ),
    ];
    for (bytes, expected) in cases {
        let error = error_of(bytes);
        assert!(error.contains(expected), "`{error}` lacks `{expected}`");
        let accepted = "accepted is UTF-8 text with a header that names time_s and displacement_m, \
                        cells separated by commas, numbers with a decimal point";
        assert!(error.ends_with(accepted), "{error}");
        assert!(error.chars().all(|c| !c.is_control() && c != '\u{fffd}'));
    }
}

#[test]
fn a_decimal_comma_under_an_accepted_header_is_reported() {
    let error = error_of(b"time_s,displacement_m\n0,0,0,001\n");
    assert!(
        error.contains("line 2: 4 cells where the header has 2; numbers with a decimal comma"),
        "{error}"
    );
    let error = error_of(b"time_s,displacement_m\n0,\"0,001\"\n");
    assert!(
        error.contains(
            "run7.csv:2: column displacement_m: `0,001` is not a finite number; it has a decimal comma"
        ),
        "{error}"
    );
    let error = error_of(b"time_s,displacement_m\n0,0.001 m\n");
    assert!(error.ends_with("is not a finite number"), "{error}");
}

/// LF or CRLF, comments and blank lines between, with or without an end of the last line.
#[test]
fn lines_are_counted_as_an_editor_does() {
    for ends in ["\n", "\r\n"] {
        for (text, line) in [
            ("time_s,displacement_m\n0,x", 2),
            ("time_s,displacement_m\n0,x\n", 2),
            (
                "\u{feff}# a\n# b\ntime_s,displacement_m\n0,0\n1,x\n2,0\n",
                5,
            ),
            ("time_s,displacement_m\n0,0\n\n# c\n1,x\n", 5),
        ] {
            let error = error_of(text.replace('\n', ends).as_bytes());
            let expected = format!("run7.csv:{line}: column displacement_m: `x`");
            assert!(error.starts_with(&expected), "{text:?} {ends:?}: {error}");
        }
        let text = "time_s,displacement_m\n0,0\n1,2,3\n".replace('\n', ends);
        let error = error_of(text.as_bytes());
        assert!(error.contains("line 3: 3 cells where"), "{ends:?}: {error}");
    }
}

/// A separator or a zero byte here and there does not make another kind of file.
#[test]
fn a_column_that_is_missing_is_reported_as_such() {
    assert!(error_of(b"\"\"\n0\n").contains("column time_s is missing"));
    for header in ["time_s,force_n", "time_s,x;m,y;m", "time_s,a\0b"] {
        let error = error_of(format!("{header}\n0,0\n").as_bytes());
        let expected = "run7.csv: column displacement_m is missing from the header (found `time_s,";
        assert!(error.starts_with(expected), "{error}");
    }
}
