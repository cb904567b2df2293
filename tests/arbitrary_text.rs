//! No parser panics on arbitrary text or on damaged copies of our files. These are smoke versions of fuzz/.

use std::io::Write;
use std::path::Path;

use dashpot_files::damper::{self, PRESETS};
use dashpot_files::profile;
use dashpot_files::study::{STUDIES, StudyParameters};
use dashpot_rail::profile::Body;
use dashpot_rail::profile::measured::Options;
use proptest::prelude::*;

/// Returns `text` with its bytes from `offset` overwritten by `patch`, converted to text again.
fn damaged(text: &str, offset: usize, patch: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let start = offset % bytes.len();
    let end = (start + patch.len()).min(bytes.len());
    bytes.splice(start..end, patch.bytes());
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Accepted parameters must also build, or the error must name a field.
fn parse_and_build(text: &str) {
    if let Ok(parameters) = damper::parse("fuzz.toml", text, &[]) {
        let _ = parameters.build::<f64>(1e-3);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn damper_file_of_any_text(text in any::<String>()) {
        parse_and_build(&text);
    }

    #[test]
    fn damaged_preset(
        preset in 0..PRESETS.len(),
        offset in any::<usize>(),
        patch in "[-+0-9.e=\\[\\]a-z_\n\"]{0,6}",
    ) {
        parse_and_build(&damaged(PRESETS[preset].1, offset, &patch));
    }

    #[test]
    fn damaged_study(
        study in 0..STUDIES.len(),
        damages in prop::collection::vec((any::<usize>(), "[-+0-9.e=\\[\\]{},a-z_\n\"]{0,6}"), 1..4),
    ) {
        let mut text = STUDIES[study].1.to_owned();
        for (offset, patch) in damages {
            text = damaged(&text, offset, &patch);
        }
        if let Ok(study) = StudyParameters::parse("fuzz.toml", &text) {
            for sweep in &study.sweeps {
                let _ = sweep.options(&sweep.values(sweep.points() - 1));
            }
        }
    }

    #[test]
    fn overrides_of_any_text(set in any::<String>()) {
        let _ = damper::load("paper", &[set]);
    }

    #[test]
    fn measured_profile_of_any_bytes(
        mut bytes in prop::collection::vec(any::<u8>(), 0..400),
        rows in "([-0-9.,;e \t\n\"]|nan|inf){0,300}",
    ) {
        bytes.extend_from_slice(rows.as_bytes());
        for content in [&bytes[..], rows.as_bytes()] {
            let mut file = tempfile();
            file.write_all(content).unwrap();
            let path: &Path = file.path();
            let _ = profile::read(path, Body::Wheel, &Options::default());
        }
    }
}

fn tempfile() -> tempfile::NamedTempFile {
    tempfile::NamedTempFile::new().expect("a temporary file")
}
