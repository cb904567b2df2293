//! Text with lines before its header.

use std::io::Cursor;
use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::{Channel, Channels, Recording, Remedy, TextOptions, remedy};

const LABVIEW: &str = "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\n\
                       ***End_of_Header***\t\n\t\nChannels\t1\t\nSamples\t3\t\nX0\t0.0\t\nDelta_X\t0.5\t\n\
                       ***End_of_Header***\t\t\nX_Value\tdisplacement [mm]\tComment\n0.0\t1.5\tstart\n0.5\t2.5\n\
                       1.0\t3.5\n";

fn read(text: &str, skip_lines: u64, time: &str) -> Result<Vec<f64>, FileError> {
    let channels = Channels {
        time: Channel {
            name: Some(time.into()),
            unit: dashpot_recording::Quantity::Time.unit("s"),
            ..Channel::default()
        },
        text: TextOptions {
            skip_lines,
            ..TextOptions::default()
        },
        ..Channels::default()
    };
    let source = Box::new(Cursor::new(text.as_bytes().to_vec()));
    let rows = Recording::read_with(Path::new("run7.lvm"), source, &channels)
        .and_then(|mut recording| recording.read_all())?;
    Ok(rows.iter().map(|row| row.displacement_m).collect())
}

/// The error states a number of lines that works.
#[test]
fn a_title_is_named_with_its_number_of_lines() {
    let titled = "Rig 7\nOperator;N. N.\n\nt;displacement_mm;F\n0;1,5;2\n1;2,5;3\n2;3,5;4\n";
    for (text, lines, first, time) in [
        (LABVIEW, 11, "LabVIEW Measurement", "X_Value"),
        (titled, 3, "Rig 7", "t"),
        (&titled.replace('\n', "\r\n"), 3, "Rig 7", "t"),
    ] {
        let error = read(text, 0, time).expect_err("a title");
        assert_eq!(remedy(&error), Some(Remedy::SkipTitle { lines }));
        let expected = format!(
            "run7.lvm: the file begins with a title, `{first}`; its table starts at line {}",
            lines + 1
        );
        assert_eq!(error.to_string(), expected);
        let read = read(text, lines, time).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read, [1.5e-3, 2.5e-3, 3.5e-3]);
    }
}

/// A row may lack its last cell only if that is the comment of LabVIEW.
#[test]
fn only_comments_may_be_left_out() {
    let error = read(&LABVIEW.replace("Comment", "Force"), 11, "X_Value").expect_err("a short row");
    assert!(
        error
            .to_string()
            .contains("line 14: 2 cells, but the header has 3"),
        "{error}"
    );
}
