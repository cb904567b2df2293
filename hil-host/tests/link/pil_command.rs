//! `dashpot pil` against a simulated target behind a TCP port: output files and errors.

use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_core::link::Response;
use dashpot_host_link::Link;
use predicates::str::contains;

use crate::common::{dashpot, files_in, json_of, json_on_stderr, text_of};
use crate::pil_common::{altered, desk, serve_tcp};

/// Number of ticks: half a second of motion forth and back, with a gap at the end.
const TICKS: usize = 601;

fn recording(folder: &Path) {
    let mut text = String::from("time_s,displacement_m\n");
    for sample in 0..=500 {
        let time_s = 2.0 + f64::from(sample) * 1e-3;
        text += &format!("{time_s:.3},{:.6}\n", 0.01 * (20.0 * time_s).sin());
    }
    text += "2.6,0\n";
    std::fs::write(folder.join("in.csv"), text).unwrap();
}

fn pil_with(
    target: impl FnOnce() -> Box<dyn Link> + Send + 'static,
    options: &[&str],
    folder: &Path,
) -> Assert {
    recording(folder);
    let link = format!("tcp:{}", serve_tcp(target));
    // On a busy machine an answer may be slow, but it always arrives.
    let wait = ["--timeout-ms", "60000"];
    let arguments = [
        &["pil", "--link", &link, "--input", "in.csv"],
        &wait[..],
        options,
    ]
    .concat();
    dashpot(&arguments, folder)
}

fn pil(options: &[&str], folder: &Path) -> Assert {
    pil_with(|| Box::new(desk()), options, folder)
}

const THREE: [&str; 6] = [
    "--damper",
    "paper",
    "--damper",
    "in-service",
    "--damper",
    "reduced-vertical",
];

fn rows(text: &str) -> Vec<Vec<String>> {
    let mut rows = csv::Reader::from_reader(text.as_bytes());
    let rows = rows
        .records()
        .map(|row| row.unwrap().iter().map(String::from).collect());
    rows.collect()
}

#[test]
fn the_output_has_a_row_for_each_tick() {
    let folder = tempfile::tempdir().unwrap();
    let output = pil(
        &[&THREE[..], &["--output", "out.csv"]].concat(),
        folder.path(),
    )
    .success();
    let report = text_of(&output);
    assert!(report.starts_with(&format!(
        "{TICKS} ticks of 1000 us through paper, in-service, reduced-vertical on"
    )));
    assert!(
        report.contains("warning: 1 gap in the recording"),
        "{report}"
    );
    assert!(report.ends_with("wrote out.csv\n"), "{report}");
    let text = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let header = "tick,time_s,displacement_m_0,target_force_n_0,host_force_n_0,status_0,\
                  displacement_m_1,target_force_n_1,host_force_n_1,status_1,\
                  displacement_m_2,target_force_n_2,host_force_n_2,status_2,clock_ticks,round_trip_ns,event";
    assert_eq!(text.lines().next(), Some(header));
    let rows = rows(&text);
    assert_eq!(rows.len(), TICKS);
    for (index, row) in rows.iter().enumerate() {
        assert_eq!(row[0], (index + 1).to_string());
        let time_s: f64 = row[1].parse().unwrap();
        assert!((time_s - (2.0 + index as f64 * 1e-3)).abs() < 1e-9);
        for place in 0..3 {
            let columns = &row[2 + 4 * place..];
            // Slot i runs i ticks behind slot 0.
            assert_eq!(columns[0], rows[index.saturating_sub(place)][2]);
            assert_eq!(columns[1], columns[2]);
        }
        assert!(row[15].parse::<u64>().unwrap() > 0);
        assert_eq!(row[16], "");
    }
    // The dampers differ, and so do their forces.
    assert!(
        rows.iter()
            .any(|row| row[3] != "0.0" && row[7] != row[3] && row[11] != row[7])
    );
}

#[test]
fn events_are_named_in_their_rows() {
    let folder = tempfile::tempdir().unwrap();
    // Duplication is the only fault that causes no timeout.
    let faults = ["--faults", "duplicate=0.05"];
    let output = pil(
        &[&faults[..], &["--output", "-", "--format", "json"]].concat(),
        folder.path(),
    )
    .success();
    let report = json_on_stderr(&output);
    let rows = rows(&text_of(&output));
    assert_eq!(rows.len(), TICKS);
    let named = rows.iter().filter(|row| row[16] == "duplicate").count() as u64;
    let made = report["injected_faults"]["duplicated"].as_u64().unwrap();
    assert!(named > 3 && named <= made, "{named}: {report}");
    assert!(rows.iter().any(|row| row[16].is_empty()));
}

#[test]
fn the_page_shows_each_slot_and_the_results() {
    let folder = tempfile::tempdir().unwrap();
    let options = [&THREE[..], &["--page", "run.html", "--format", "json"]].concat();
    let output = pil(&options, folder.path()).success();
    let report = json_of(&output);
    assert_eq!(report["files"], serde_json::json!(["run.html"]));
    assert_eq!(
        report["dampers"],
        serde_json::json!(["paper", "in-service", "reduced-vertical"])
    );
    let page = std::fs::read_to_string(folder.path().join("run.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"));
    for (place, damper) in ["paper", "in-service", "reduced-vertical"]
        .iter()
        .enumerate()
    {
        assert!(page.contains(&format!("</svg>slot {place}: {damper}</button>")));
        let row = format!("<td>{place}</td><td class=\"text\">{damper}</td>");
        assert!(page.contains(&row), "{row}");
    }
    // Forces, round trip times, and clock ticks as a histogram and over time.
    assert_eq!(page.matches("class=\"plot\"").count(), 4);
    let identical = "<span class=\"within\">✓ bit-identical to the host</span>";
    assert_eq!(page.matches(identical).count(), 3);
    assert!(!page.contains("Marks on the time axes"));
}

#[test]
fn a_paced_run_reports_missed_deadlines() {
    let folder = tempfile::tempdir().unwrap();
    let options = [
        "--paced", "--ticks", "30", "--output", "-", "--page", "run.html", "--format", "json",
    ];
    let output = pil(&options, folder.path()).success();
    let report = json_on_stderr(&output);
    let missed = report["pacing"]["missed_deadlines"].as_u64().unwrap();
    assert_eq!(report["pacing"]["response"]["count"], 30);
    let late = rows(&text_of(&output))
        .iter()
        .filter(|row| row[16] == "late")
        .count();
    assert_eq!(late as u64, missed);
    let page = std::fs::read_to_string(folder.path().join("run.html")).unwrap();
    assert!(page.contains("<td>missed deadlines</td>") && page.contains("Dashed: one step."));
}

#[test]
fn a_force_that_differs_fails_the_command_and_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = || -> Box<dyn Link> {
        // One bit is wrong in one force of tick 42.
        Box::new(altered(|header, mut response, frame| {
            if let Response::Forces(forces) = &mut response
                && forces.tick == 42
            {
                forces.forces_n[1] = f32::from_bits(forces.forces_n[1].to_bits() ^ 1);
            }
            frame.write(&(header, response))
        }))
    };
    let files = ["--output", "out.csv", "--page", "run.html"];
    pil_with(wrong, &files, folder.path())
        .code(1)
        .stderr(contains("1 forces or status words and 0 states differ"));
    assert_eq!(files_in(folder.path()), ["in.csv", "out.csv", "run.html"]);
    let text = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let differing: Vec<_> = rows(&text)
        .into_iter()
        .filter(|row| row[16] == "mismatch")
        .collect();
    assert_eq!(differing.len(), 1);
    assert_eq!(differing[0][0], "42");
    assert_ne!(differing[0][7], differing[0][8]);
    let page = std::fs::read_to_string(folder.path().join("run.html")).unwrap();
    // Only the slot that differs has its own figure.
    assert_eq!(
        page.matches("target minus host, and both forces.").count(),
        1
    );
    assert_eq!(
        page.matches("<span class=\"above\">✗ differ</span>")
            .count(),
        1
    );
}

#[test]
fn a_wrong_number_of_dampers_is_wrong_use() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["--output", "out.csv", "--page", "run.html"];
    pil(&[&THREE[..4], &files].concat(), folder.path())
        .code(2)
        .stderr(contains(
            "2 dampers, but the target has 3 slots; allowed: 1 for all slots, or 3",
        ));
    assert_eq!(files_in(folder.path()), ["in.csv"]);
}

#[test]
fn impossible_files_are_refused_before_the_target_is_contacted() {
    for (options, code, part) in [
        (
            &["--page", "none/run.html"][..],
            1,
            "none/run.html: cannot write: there is no folder none",
        ),
        (
            &["--output", "none/out.csv"],
            1,
            "none/out.csv: cannot write: there is no folder none",
        ),
        (
            &["--output", "in.csv"],
            2,
            "--output in.csv: this is also an input file",
        ),
        (
            &["--page", "./in.csv"],
            2,
            "--page ./in.csv: this is also an input file",
        ),
        (
            &["--output", "x", "--page", "x"],
            2,
            "--output and --page: both are x",
        ),
        (
            &["--output", "-", "--page", "-"],
            2,
            "--output and --page: both are -",
        ),
        (
            &["--damper", "-", "--damper", "-"],
            2,
            "`-` is standard input, which can be read for only one of them",
        ),
        (
            &["--core", "0"],
            2,
            "--fifo, --lock-memory, --core and --no-deep-sleep require --paced",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        recording(folder.path());
        // No process listens on this port.
        let command = ["pil", "--link", "tcp:localhost:1", "--input", "in.csv"];
        dashpot(&[&command[..], options].concat(), folder.path())
            .code(code)
            .stderr(contains(part));
        assert_eq!(files_in(folder.path()), ["in.csv"]);
    }
}
