//! One recording in every file format gives the same values.

use std::path::{Path, PathBuf};

use dashpot_files::FileError;
use dashpot_recording::Remedy;
use dashpot_recording::{Channel, Channels, MeasuredSample, Measurement, Quantity};

/// A file, and its channel names (time, displacement, force; empty for the default) with the units that the file does
/// not state.
pub struct Form {
    pub file: &'static str,
    names: [&'static str; 3],
    units: [&'static str; 3],
    group: &'static str,
}

const fn form(file: &'static str, names: [&'static str; 3]) -> Form {
    Form {
        file,
        names,
        units: [""; 3],
        group: "",
    }
}

/// The time channel of MDF4 is the master channel of the group, so it needs no name.
const MDF: [&str; 3] = ["", "Weg", "Kraft"];
const OWN: [&str; 3] = [""; 3];
const GERMAN: [&str; 3] = ["Zeit", "Weg", "Kraft"];

/// The files that `make.py` writes, except those with missing values.
pub const FORMS: [Form; 26] = [
    form("plain.mf4", MDF),
    form("deflated.mf4", MDF),
    form("transposed.mf4", MDF),
    form("converted.mf4", MDF),
    form("halves.mf4", MDF),
    Form {
        group: "Messung",
        ..form("groups.mf4", MDF)
    },
    Form {
        group: "Messung",
        ..form("unsorted.mf4", MDF)
    },
    form("none.parquet", OWN),
    form("snappy.parquet", OWN),
    form("gzip.parquet", OWN),
    form("brotli.parquet", OWN),
    form("lz4.parquet", OWN),
    form("zstd.parquet", OWN),
    form("pages.parquet", OWN),
    Form {
        units: ["s", "", "N"],
        ..form("plain.parquet", ["t", "Weg", "Kraft"])
    },
    form("stamps_us.parquet", ["zeit", "Weg [mm]", ""]),
    form("stamps_ns.parquet", ["zeit", "2", "force_n"]),
    Form {
        units: ["ns", "", ""],
        ..form("units.parquet", ["t", "x", "F"])
    },
    form("pandas.parquet", GERMAN),
    form("german.csv", GERMAN),
    form("utf_16.csv", GERMAN),
    form("german.csv.gz", GERMAN),
    form("german.csv.gz", ["Zeit [ms]", "#2", "3"]),
    form("indexed.csv", OWN),
    Form {
        units: ["s", "m", "N"],
        ..form("bare.csv", ["1", "2", "3"])
    },
    form("expected.csv", OWN),
];

/// Samples stored in this folder.
pub fn samples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings/samples")
}

impl Form {
    /// Channels of a file.
    pub fn channels(&self) -> Channels {
        let quantities = [Quantity::Time, Quantity::Displacement, Quantity::Force];
        let [time, displacement, force] = [0, 1, 2].map(|place| Channel {
            name: Some(self.names[place].to_owned()).filter(|name| !name.is_empty()),
            unit: quantities[place].unit(self.units[place]),
            reversed: false,
        });
        Channels {
            time,
            displacement,
            force,
            group: Some(self.group.to_owned()).filter(|group| !group.is_empty()),
            ..Channels::default()
        }
    }
}

/// All rows of a file.
pub fn rows(path: &Path, channels: &Channels) -> Result<Vec<MeasuredSample>, FileError> {
    Measurement::open(path, channels)?.read_all()
}

/// Asserts that every file format in `folder` has the rows of expected.csv there.
pub fn compare(folder: &Path) {
    let expected = rows(&folder.join("expected.csv"), &Channels::default()).unwrap();
    assert!(expected.len() >= 60);
    for form in &FORMS {
        let found = rows(&folder.join(form.file), &form.channels());
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(found.len(), expected.len(), "{}", form.file);
        // Decimals of text and unit factors are exact up to binary rounding.
        let near = |a: f64, b: f64| (a - b).abs() <= 2.0 * f64::EPSILON * b.abs();
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                near(found.time_s, expected.time_s)
                    && near(found.displacement_m, expected.displacement_m)
                    && near(found.force_n, expected.force_n),
                "{}: {found:?} instead of {expected:?}",
                form.file
            );
        }
    }
}

#[test]
fn every_form_has_the_same_rows() {
    compare(&samples());
}

/// Asserts that rows with a missing value are rejected, or skipped on request; `make.py` marks one row in a hundred.
pub fn compare_invalid(folder: &Path) {
    let expected = rows(&folder.join("expected.csv"), &Channels::default()).unwrap();
    for (file, names) in [("invalid.mf4", MDF), ("nulls.parquet", OWN)] {
        let path = folder.join(file);
        let mut channels = form(file, names).channels();
        let error = rows(&path, &channels).expect_err("a value is missing");
        assert_eq!(dashpot_recording::remedy(&error), Some(Remedy::SkipInvalid));
        let error = error.to_string();
        assert!(
            error.contains(&format!("{file}: row 11: column ")),
            "{error}"
        );
        channels.skip_invalid = true;
        let mut measurement = Measurement::open(&path, &channels).unwrap();
        let found = measurement.read_all().unwrap();
        let is_marked = |row: usize| row % 100 == 10;
        let left: Vec<_> = (0..expected.len()).filter(|row| !is_marked(*row)).collect();
        assert_eq!(found.len(), left.len());
        let times = |sample: &MeasuredSample| sample.time_s;
        assert!(
            left.iter()
                .map(|row| times(&expected[*row]))
                .eq(found.iter().map(times))
        );
        let left_out = measurement.gaps().left_out;
        assert_eq!(left_out.rows as usize, expected.len() - left.len());
    }
}

#[test]
fn rows_that_lack_a_value_are_refused_or_skipped() {
    compare_invalid(&samples());
}

/// The same contents are read through a pipe, in which seeking is impossible.
#[test]
fn streams_and_compressed_files_are_read_alike() {
    use std::io::Write;
    let folder = samples();
    for form in &FORMS {
        let bytes = std::fs::read(folder.join(form.file)).unwrap();
        let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        gzip.write_all(&bytes).unwrap();
        let expected = rows(&folder.join(form.file), &form.channels()).unwrap();
        let is_compressed = form.file.ends_with(".gz");
        for bytes in [bytes, gzip.finish().unwrap()]
            .into_iter()
            .take(2 - usize::from(is_compressed))
        {
            let source = Box::new(std::io::Cursor::new(bytes));
            let measurement = Measurement::read(Path::new("stream"), source, &form.channels());
            let found = measurement.unwrap().read_all().unwrap();
            assert_eq!(found, expected, "{}", form.file);
        }
    }
}
