//! Formats of written files.

use std::path::Path;

use dashpot_recording::writer::FileFormat;

#[test]
fn the_extension_decides_the_format() {
    let format = |path: &str| FileFormat::from_path(Path::new(path));
    for path in ["-", "forces.csv", "forces", "forces.parquet.csv", "mf4"] {
        assert_eq!(format(path), Ok(FileFormat::Text), "{path}");
    }
    #[cfg(feature = "parquet")]
    for path in ["forces.parquet", "forces.csv.PARQUET"] {
        assert_eq!(format(path), Ok(FileFormat::Parquet), "{path}");
    }
    #[cfg(feature = "mdf")]
    for path in ["forces.mf4", "FORCES.MF4"] {
        assert_eq!(format(path), Ok(FileFormat::Mdf4), "{path}");
    }
}

/// A file of another format than its extension says would mislead.
#[cfg(not(any(feature = "parquet", feature = "mdf")))]
#[test]
fn missing_formats_are_errors() {
    for (path, feature) in [("forces.parquet", "parquet"), ("forces.mf4", "mdf")] {
        let error = FileFormat::from_path(Path::new(path)).expect_err("a missing feature");
        let expected = format!(
            "{path}: this build cannot write this format because it lacks the feature `{feature}`; allowed: .csv"
        );
        assert_eq!(error, expected);
    }
}
