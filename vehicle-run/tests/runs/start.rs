//! Starts on track that is not ideal.

use dashpot_files::case::{Case, CaseOptions};
use dashpot_vehicle_run::{Run, Warning, recorded};

/// Warnings of a coach on a track, with the start that the case states or with the default.
fn warnings(track: &str, start: &str) -> Vec<Warning> {
    let text = format!(
        "name = \"start\"\nvehicle = \"coach\"\ntrack = \"{track}\"\nspeed_km_h = 100\nduration_s = 0.01\n{start}"
    );
    let case: Case = CaseOptions::parse("case.toml", &text)
        .unwrap()
        .case()
        .unwrap();
    let run = Run::new(&case).unwrap();
    let record = recorded::record(&case, run, Some(&[]), &|| false).unwrap();
    record.warnings
}

#[test]
fn by_default_a_vehicle_starts_on_ideal_track() {
    for track in [
        "ideal",
        "straight",
        "straight-german",
        "curve-r200",
        "curve-r600",
    ] {
        assert_eq!(warnings(track, ""), [], "{track}");
    }
}

/// The ramp of this track is 50 m long.
#[test]
fn a_start_on_irregular_rails_is_a_warning() {
    let found = warnings("straight", "start_m = 100");
    let [
        warning @ Warning::StartOnIrregularity { distance_m, .. },
        ..,
    ] = &found[..]
    else {
        panic!("{found:?}");
    };
    assert!((distance_m - 110.78).abs() < 1e-9, "{distance_m}");
    let text = warning.to_string();
    assert!(
        text.starts_with("wheelset 1 starts 110.8 m along the track, where the "),
        "{text}"
    );
    assert!(text.ends_with("Start earlier (start_m)"), "{text}");
}

#[test]
fn a_start_in_a_curve_is_a_warning() {
    let found = warnings("curve-r600", "start_m = 300");
    let [
        warning @ Warning::StartInCurve {
            curvature_per_m, ..
        },
        ..,
    ] = &found[..]
    else {
        panic!("{found:?}");
    };
    assert!(
        (curvature_per_m - 1.0 / 600.0).abs() < 1e-12,
        "{curvature_per_m}"
    );
    assert_eq!(
        warning.to_string(),
        "wheelset 1 starts 310.8 m along the track, where the curvature is 0.00167 1/m and the cant 120 mm; the \
         vehicle starts as on straight track, so the first forces include those of a step that the track does not \
         have. Start earlier (start_m)"
    );
}

/// The irregularities of this track are 1000 m long.
#[test]
fn a_run_beyond_the_irregularities_is_a_warning() {
    let found = warnings("straight", "start_m = 999.9");
    assert!(
        found
            .iter()
            .all(|warning| !matches!(warning, Warning::IrregularitiesEnd { .. })),
        "a short part beyond the end is allowed: {found:?}"
    );
    let text = "name = \"end\"\nvehicle = \"coach\"\ntrack = \"straight\"\nspeed_km_h = 90\nduration_s = 1\n\
                start_m = 995";
    let case: Case = CaseOptions::parse("case.toml", text)
        .unwrap()
        .case()
        .unwrap();
    let run = Run::new(&case).unwrap();
    let found = recorded::record(&case, run, Some(&[]), &|| false)
        .unwrap()
        .warnings;
    let ends = |warning: &&Warning| matches!(warning, Warning::IrregularitiesEnd { .. });
    let given = found.iter().find(ends).unwrap();
    // 5 m of 25 m are before the end.
    assert!(given.to_string().contains("0.8 of the 1.0 s"), "{given}");
    // What is foreseen without a run is what the run finds.
    let foreseen = dashpot_vehicle_run::foreseen(&case, &case.track.build().unwrap()).unwrap();
    assert_eq!(foreseen.to_string(), given.to_string());
}
