//! `dashpot` without a command, and the recording it ships.

use std::path::Path;
use std::sync::LazyLock;

use dashpot_files::Scalar;
use dashpot_testbench::accuracy_limits::ACCURACY_LIMITS;
use dashpot_testbench::excitation::Excitation;

use crate::common::{dashpot, error_of, json_of, text_of};

/// Text output of the command, and its page.
static SHOWN: LazyLock<(String, String)> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let output = dashpot(&[], folder.path());
    let page = std::fs::read_to_string(folder.path().join("dashpot-report.html")).unwrap();
    (text_of(&output), page)
});

/// Checks the promised accuracy.
fn check_limit(row: &serde_json::Value) {
    let scalar = if row["scalar"] == "f32" {
        Scalar::F32
    } else {
        Scalar::F64
    };
    let step_s = row["step_s"].as_f64().unwrap();
    let limit = ACCURACY_LIMITS[0].nrmse(step_s, scalar).unwrap();
    assert_eq!(row["nrmse_limit"].as_f64(), Some(limit));
    let nrmse = row["nrmse"].as_f64().unwrap();
    assert!(nrmse > 0.0 && nrmse < limit, "{row}");
}

#[test]
fn the_page_is_whole_self_contained_and_accurate() {
    let folder = tempfile::tempdir().unwrap();
    let output = dashpot(&["--format", "json"], folder.path()).success();
    let report = json_of(&output);
    let rows = report["accuracy"].as_array().unwrap();
    assert_eq!(rows.len(), 8);
    for row in rows {
        check_limit(row);
        assert!(row["median_ns_per_step"].as_f64().unwrap() > 0.0);
    }
    let page = std::fs::read_to_string(folder.path().join("dashpot-report.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    // Nine figures with thirteen plots, each with its data.
    assert_eq!(page.matches("<figure>").count(), 9);
    for part in [
        "class=\"plot\" role=\"img\"",
        "<script type=\"application/json\">",
    ] {
        assert_eq!(page.matches(part).count(), 13, "{part}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// The ride is synthetic: nothing on the page or in the report may call it recorded or measured. Values measured in the
/// paper and times measured here are called measured.
#[test]
fn only_measured_values_are_called_measured() {
    let (report, page) = &*SHOWN;
    assert!(report.contains("synthetic ride"), "{report}");
    let captions: Vec<&str> = page
        .split("<figcaption>")
        .skip(1)
        .filter_map(|rest| rest.split_once("</figcaption>"))
        .map(|(caption, _)| caption)
        .collect();
    assert_eq!(captions.len(), 9);
    for caption in &captions[1..] {
        assert!(caption.contains("synthetic "), "{caption}");
    }
    for words in [
        "runs on a synthetic ride of",
        "paper on the synthetic ride",
        "in-service on the synthetic ride",
        "test, measured",
        "measured on this machine",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // The live page above records what the reader does.
    let (_, below) = page.split_once("<article class=\"report\">").unwrap();
    let (below, _) = below.split_once("</article>").unwrap();
    for text in [report, below] {
        assert!(!text.contains("recorded"), "{text:.200}");
    }
    let help = text_of(&dashpot(&["--help"], Path::new(".")));
    assert!(help.contains("synthetic ride"), "{help}");
}

/// Values in the text are those of the damper files.
#[test]
fn the_page_lists_the_parameters_of_the_presets() {
    let (_, page) = &*SHOWN;
    for words in [
        "69.8 mm piston and 28 mm rod",
        "orifice of 2 mm",
        "adds 1 mm clearance, seats of 40 MN/m, valve preloads of 0.5, 0.3 (piston) and 0 MPa (foot), leakage \
         through a piston gap of 30 µm, a relief valve that opens at 5 MPa, seal friction of 100 N",
        "oil column with 0.05 % entrained air",
        // 5 MPa on 3.2107e-3 and 3.8265e-3 m2, plus 100 N.
        "opens at 5 MPa: 16 kN in extension, 19 kN in compression",
        "±24.875 mm at 0.64 Hz",
        "33, 41 and 30 times",
    ] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn a_page_that_cannot_be_written_fails() {
    let folder = tempfile::tempdir().unwrap();
    let output = dashpot(&["--output", "none/x.html"], folder.path()).code(1);
    let message = error_of(&output);
    assert!(
        message.contains("none/x.html: cannot write: there is no folder none"),
        "{message}"
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// The shipped recording is the synthetic ride at its time stamps, as its header says.
#[test]
fn the_shipped_ride_is_what_its_header_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../data/excitations/ride_made.csv");
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.starts_with("\u{feff}# MADE"));
    let ride = Excitation::Ride.displacements_m(1e-4);
    let (mut last, mut gaps, mut rows) = (None, 0, 0);
    for line in text.split_terminator('\n').skip(5) {
        let (time, x) = line.strip_suffix('\r').unwrap().split_once(',').unwrap();
        let (time, x): (f64, f64) = (time.parse().unwrap(), x.parse().unwrap());
        let index = (time / 1e-4).round() as usize;
        assert!((x - ride[index]).abs() < 5.1e-9, "{line}");
        if let Some(last) = last {
            let apart = index - last;
            gaps += usize::from(apart > 24);
            assert!(apart >= 16 && (apart <= 24 || apart >= 400), "{line}");
        }
        last = Some(index);
        rows += 1;
    }
    assert_eq!(gaps, 1);
    assert!(rows > 2400, "{rows}");
}
