//! What is reported of a recording that is another kind of file.

use std::io::Cursor;
use std::path::Path;

use dashpot_recording::Recording;

/// What reading all of `bytes` says.
fn error_of(bytes: &[u8]) -> String {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    Recording::read(Path::new("run7.csv"), source)
        .and_then(|mut recording| recording.read_all())
        .expect_err("another kind of file")
        .to_string()
}

#[test]
fn another_kind_of_file_is_reported_by_name() {
    let cases: [(&[u8], &str); 4] = [
        (
            b"PK\x03\x04\x14\0\x06\0",
            "it is a zip archive or a workbook of Excel",
        ),
        (
            b"\x28\xb5\x2f\xfd\x04\0\0\0",
            "it is compressed with Zstandard",
        ),
        (b"MATLAB 5.0 MAT-file", "it is a MAT-file of version 5"),
        (
            b"\x89HDF\r\n\x1a\n\0",
            "it is HDF5 or a MAT-file of version 7.3",
        ),
    ];
    for (bytes, expected) in cases {
        let error = error_of(bytes);
        assert!(error.starts_with("run7.csv: it is "), "{error}");
        assert!(error.contains(expected), "`{error}` lacks `{expected}`");
        assert!(error.contains("read are text (CSV), MDF4 and Parquet"));
    }
}

#[test]
fn a_decimal_comma_between_commas_is_reported() {
    let error = error_of(b"time_s,displacement_m\n0,0,0,001\n");
    assert!(
        error.contains("line 2: 4 cells where the header has 2; numbers with a decimal comma"),
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
    assert!(error_of(b"\"\"\n0\n").contains("no header says which column is the time"));
    for header in ["time_s,force_n", "time_s,x;m,y;m", "time_s,a\0b"] {
        let error = error_of(format!("{header}\n0,0\n").as_bytes());
        let expected = "run7.csv: column displacement_m is missing; there are `time_s`, `";
        assert!(error.starts_with(expected), "{error}");
    }
}
