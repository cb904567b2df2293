//! Plain rows are parsed without the CSV reader. A source that returns one byte at a time never has a whole line, so
//! that the CSV reader reads all rows: both ways must give the same samples, gaps and errors.

use std::fmt::Write;
use std::io::{self, Cursor, Read};
use std::path::Path;

use dashpot_recording::{Channels, DecimalMark, Recording, Separator, TextOptions};
use proptest::prelude::*;

/// Source that returns at most `length` bytes at a time.
struct Pieces {
    text: Cursor<Vec<u8>>,
    length: usize,
}

impl Read for Pieces {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = buffer.len().min(self.length);
        self.text.read(&mut buffer[..length])
    }
}

/// Everything that reading a text in pieces of `length` bytes gives, with the bits of the numbers.
fn read(text: &[u8], length: usize, channels: &Channels) -> String {
    let text = Cursor::new(text.to_vec());
    let source = Box::new(Pieces { text, length });
    let mut recording = match Recording::read_with(Path::new("run7"), source, channels) {
        Ok(recording) => recording,
        Err(error) => return error.to_string(),
    };
    let mut found = String::new();
    loop {
        match recording.next_sample() {
            Ok(Some(sample)) => {
                let (time, displacement) = (sample.time_s, sample.displacement_m);
                let bits = (time.to_bits(), displacement.to_bits());
                writeln!(found, "{bits:x?} {time} {displacement}").expect("text grows");
            }
            Ok(None) => return format!("{found}{:?}", recording.gaps()),
            Err(error) => return format!("{found}{error}"),
        }
    }
}

/// Compares the ways to read a text.
fn compare(text: &[u8], channels: &Channels) {
    let by_the_csv_reader = read(text, 1, channels);
    for length in [usize::MAX, 7, 100] {
        let found = read(text, length, channels);
        assert_eq!(
            found,
            by_the_csv_reader,
            "in pieces of {length} bytes: {:?}",
            String::from_utf8_lossy(text)
        );
    }
}

/// A cell: usually a number, rarely anything else.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        12 => "-?[0-9]{1,4}[.][0-9]{1,9}",
        4 => "-?[0-9]{1,4},[0-9]{1,9}",
        3 => "[-+]?[0-9]{0,22}([.][0-9]{0,22})?([eE][-+]?[0-9]{0,3})?",
        2 => " {0,2}-?[0-9]{1,3}[.,]?[0-9]{0,3} {0,2}",
        1 => "\"-?[0-9]{1,3}[.,;]?[0-9]{0,3}\"",
        1 => "[ -~\t\r\n\"#é]{0,5}",
        1 => "(nan|inf|-inf|NaN|)",
    ]
}

/// A row whose time usually follows from its index.
fn row(separator: &'static str) -> impl Strategy<Value = (bool, Vec<String>, String)> {
    let cells = prop_oneof![
        30 => prop::collection::vec(cell(), 2..=2),
        1 => prop::collection::vec(cell(), 0..5),
    ];
    let end = prop_oneof![
        20 => Just("\n".to_owned()),
        6 => Just("\r\n".to_owned()),
        1 => Just("\r".to_owned()),
        2 => Just(format!("{separator}\n")),
        1 => Just("\n\n# comment\n".to_owned()),
    ];
    (prop::bool::weighted(0.95), cells, end)
}

fn text(separator: &'static str) -> impl Strategy<Value = Vec<u8>> {
    let rows = prop::collection::vec(row(separator), 0..40);
    (
        rows,
        prop::bool::weighted(0.3),
        0_usize..20,
        prop::bool::ANY,
    )
        .prop_map(move |(rows, is_crlf, cut, has_extra)| {
            let extra = if has_extra { "no" } else { "" };
            let mut text = format!("time_s{separator}displacement_m");
            if has_extra {
                write!(text, "{separator}{extra}").expect("text grows");
            }
            text += "\n";
            for (index, (counts, mut cells, end)) in rows.into_iter().enumerate() {
                if counts && let Some(time) = cells.first_mut() {
                    *time = format!("{}.{}", index / 10, index % 10);
                }
                if has_extra {
                    cells.push("7x".to_owned());
                }
                let end = if is_crlf && end == "\n" { "\r\n" } else { &end };
                text += &(cells.join(separator) + end);
            }
            let mut bytes = text.into_bytes();
            // The last line may be cut off anywhere.
            bytes.truncate(bytes.len() - cut.min(bytes.len() / 2) * usize::from(cut % 2 == 1));
            bytes
        })
}

/// A text and its separator, rarely another one. The separator is given, because its detection looks at the rows that
/// have arrived, at most eight: it may differ for a text that arrives byte by byte.
fn separated_text() -> impl Strategy<Value = (Vec<u8>, Separator)> {
    prop_oneof![
        text(",").prop_map(|text| (text, Separator::Comma)),
        text(";").prop_map(|text| (text, Separator::Semicolon)),
        text("\t").prop_map(|text| (text, Separator::Tab)),
        text(" ").prop_map(|text| (text, Separator::Spaces)),
        text("  ").prop_map(|text| (text, Separator::Spaces)),
        text("|").prop_map(|text| (text, Separator::Bar)),
        text(",").prop_map(|text| (text, Separator::Semicolon)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(
        std::env::var("PROPTEST_CASES").map_or(512, |cases| cases.parse().expect("a number"))
    ))]

    #[test]
    fn plain_rows_are_read_as_by_the_csv_reader(
        (text, separator) in separated_text(),
        mark in prop_oneof![
            3 => Just(None), 1 => Just(Some(DecimalMark::Point)), 1 => Just(Some(DecimalMark::Comma)),
        ],
        skip_invalid in prop::bool::weighted(0.6),
    ) {
        let channels = Channels {
            text: TextOptions { decimal_mark: mark, separator: Some(separator), ..TextOptions::default() },
            skip_invalid,
            ..Channels::default()
        };
        compare(&text, &channels);
    }
}

/// Rows of every length end within a block, at its end and after it.
#[test]
fn rows_cut_between_blocks_are_read() {
    let mut text = "time_s;displacement_m\r\n".to_owned();
    for index in 0..30_000 {
        let decimals = index % 11;
        let x = f64::from(index).sin();
        let end = if index % 97 == 0 { "\n" } else { "\r\n" };
        write!(
            text,
            "{index};{x:.decimals$}{end}",
            decimals = decimals as usize
        )
        .expect("text grows");
    }
    let rows = text.lines().count() - 1;
    let channels = Channels::default();
    let whole = read(text.as_bytes(), usize::MAX, &channels);
    assert_eq!(whole.lines().count(), rows + 1);
    assert_eq!(whole, read(text.as_bytes(), 1, &channels));
    assert_eq!(whole, read(text.as_bytes(), 65_537, &channels));
}
