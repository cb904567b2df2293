//! Errors for files that are not recordings.

use std::io::Cursor;
use std::path::Path;

use dashpot_recording::Recording;

/// Returns the error from reading all of `bytes`.
fn error_of(bytes: &[u8]) -> String {
    let source = Box::new(Cursor::new(bytes.to_vec()));
    Recording::read(Path::new("run7.csv"), source)
        .and_then(|mut recording| recording.read_all())
        .expect_err("an invalid file")
        .to_string()
}

#[test]
fn unsupported_formats_are_named() {
    let cases: [(&[u8], &str); 9] = [
        (
            b"PK\x03\x04\x14\0\x06\0",
            "the file is a zip archive or an Excel workbook",
        ),
        (
            b"\x28\xb5\x2f\xfd\x04\0\0\0",
            "the file is compressed with Zstandard",
        ),
        (b"MATLAB 5.0 MAT-file", "the file is a MAT-file (version 5)"),
        (
            b"\x89HDF\r\n\x1a\n\0",
            "the file is HDF5 or a MAT-file (version 7.3)",
        ),
        (
            b"MDF     3.30    made    \0\0\0\0",
            "the file is an MDF file of a version before 4; save it as MDF4",
        ),
        (
            b"UnFinMF 3.30    made    \0\0\0\0",
            "the file is an MDF file of a version before 4; save it as MDF4",
        ),
        (
            b"ARROW1\0\0\xff\xff\xff\xff",
            "the file is an Arrow file (Feather); save it as Parquet",
        ),
        (
            b"FEA1\0\0\0\0",
            "the file is an old Feather file (version 1)",
        ),
        (
            b"\xff\xff\xff\xff\x78\0\0\0",
            "the file is an Arrow stream; save it as Parquet",
        ),
    ];
    for (bytes, expected) in cases {
        let error = error_of(bytes);
        assert!(error.starts_with("run7.csv: the file is "), "{error}");
        assert!(error.contains(expected), "`{error}` lacks `{expected}`");
        assert!(error.contains("supported: text (CSV), MDF4 and Parquet"));
    }
}

#[test]
fn decimal_commas_in_comma_separated_cells_are_reported() {
    let error = error_of(b"time_s,displacement_m\n0,0,0,001\n");
    assert!(
        error
            .contains("line 2: 4 cells, but the header has 2; if the numbers have a decimal comma"),
        "{error}"
    );
    let error = error_of(b"time_s,displacement_m\n0,0.001 m\n");
    assert!(error.ends_with("is not a finite number"), "{error}");
}

/// Covers LF and CRLF, comments, blank lines, and a last line with and without a line end.
#[test]
fn line_numbers_match_those_of_an_editor() {
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
        assert!(error.contains("line 3: 3 cells, but"), "{ends:?}: {error}");
    }
}

/// Stray separators and zero bytes do not lead to the error for unsupported formats.
#[test]
fn a_missing_column_is_reported() {
    assert!(error_of(b"\"\"\n0\n").contains("no header says which column is the time"));
    for header in ["time_s,force_n", "time_s,x;m,y;m", "time_s,a\0b"] {
        let error = error_of(format!("{header}\n0,0\n").as_bytes());
        let expected = "run7.csv: column displacement_m is missing; the file has `time_s`, `";
        assert!(error.starts_with(expected), "{error}");
    }
}
