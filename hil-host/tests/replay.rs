//! `dashpot replay` and `dashpot verify` as their users run them.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn dashpot(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dashpot"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn error_of(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs a replay of `bytes`; returns its output and what is in the output file.
fn replay_of(bytes: &[u8], more: &[&str]) -> (Output, Option<String>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), bytes).unwrap();
    let mut arguments = vec![
        "replay",
        "--damper",
        "reduced-vertical",
        "--input",
        "in.csv",
        "--output",
        "out.csv",
    ];
    arguments.extend(more);
    let output = dashpot(&arguments, folder.path());
    let written = std::fs::read_to_string(folder.path().join("out.csv")).ok();
    let left: Vec<PathBuf> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| !path.ends_with("in.csv") && !path.ends_with("out.csv"))
        .collect();
    assert!(left.is_empty(), "left behind: {left:?}");
    (output, written)
}

#[test]
fn a_ramp_ends_at_damping_times_velocity() {
    // 10 mm/s through 2a = 1 mm: C v = 1200 N once the springs are stretched.
    let (output, written) = replay_of(
        b"\xef\xbb\xbf# a logger's comment\r\nname,displacement_m,time_s\r\na,0.0,10.0\r\nb,0.005,10.5\r\nc,0.01,11.0\r\n",
        &["--scalar", "f64", "--format", "json"],
    );
    assert!(output.status.success(), "{}", error_of(&output));
    let written = written.unwrap();
    let mut lines = written.lines();
    assert_eq!(lines.next(), Some("time_s,displacement_m,force_n"));
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 1001);
    assert_eq!(rows[0], [10.0, 0.0, 0.0]);
    let last = &rows[1000];
    assert_eq!(last[0], 11.0);
    assert!((last[1] - 0.01).abs() < 1e-12);
    assert!((last[2] - 1200.0).abs() < 1e-3, "{last:?}");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["ticks"], 1001);
    assert_eq!(report["input_limited"], false);
}

#[test]
fn bad_recordings_say_where_and_leave_no_output() {
    let cases: [(&[u8], &[&str]); 9] = [
        (
            b"time_s,displacement_m\n0,0\n0.1,0\n0.05,0\n",
            &["in.csv:4: column time_s", "does not grow"],
        ),
        (
            b"time_s,displacement_m\n0,0\n0.1,NaN\n",
            &["in.csv:3: column displacement_m", "`NaN`"],
        ),
        (
            b"time_s,displacement_m\n0,0\n0.1,\n",
            &["in.csv:3: column displacement_m", "not a finite number"],
        ),
        (
            b"time_s,displacement_m\n0,0\n0.1,1,2\n",
            &["line 3", "3 cells where the header has 2"],
        ),
        (
            b"time_s,force\n0,0\n",
            &["column displacement_m is missing"],
        ),
        (
            b"time_s,time_s,displacement_m\n0,0,0\n",
            &["column time_s is in the header 2 times"],
        ),
        (b"", &["empty"]),
        (b"time_s,displacement_m\n", &["no row after the header"]),
        (
            b"\x7fELF\x02\x01\x01\0\0\0\xff\xfe",
            &["column time_s is missing"],
        ),
    ];
    for (bytes, expected) in cases {
        let (output, written) = replay_of(bytes, &[]);
        let error = error_of(&output);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert_eq!(written, None, "{error}");
        for part in expected {
            assert!(error.contains(part), "`{error}` lacks `{part}`");
        }
    }
}

#[test]
fn a_failed_replay_keeps_the_output_that_was_there() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("in.csv"),
        "time_s,displacement_m\n0,0\n1,x\n",
    )
    .unwrap();
    std::fs::write(folder.path().join("out.csv"), "precious").unwrap();
    let arguments = ["replay", "--input", "in.csv", "--output", "out.csv"];
    let output = dashpot(&arguments, folder.path());
    assert_eq!(output.status.code(), Some(1));
    let kept = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert_eq!(kept, "precious");
    let onto_itself = ["replay", "--input", "in.csv", "--output", "in.csv"];
    let output = dashpot(&onto_itself, folder.path());
    assert!(error_of(&output).contains("is the input too"));
}

#[cfg(unix)]
#[test]
fn a_pipe_is_written_to_and_a_link_followed() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("in.csv"), "time_s,displacement_m\n0,0\n0.002,0\n").unwrap();
    std::fs::write(at("real.csv"), "old").unwrap();
    symlink("real.csv", at("link.csv")).unwrap();
    let arguments = ["replay", "--input", "in.csv", "--output", "link.csv"];
    assert!(dashpot(&arguments, folder.path()).status.success());
    assert!(
        std::fs::symlink_metadata(at("link.csv"))
            .unwrap()
            .is_symlink()
    );
    let written = std::fs::read_to_string(at("real.csv")).unwrap();
    assert_eq!(written.lines().count(), 4);

    assert!(
        Command::new("mkfifo")
            .arg(at("pipe"))
            .status()
            .unwrap()
            .success()
    );
    let pipe = at("pipe");
    let reader = std::thread::spawn(move || std::fs::read_to_string(pipe).unwrap());
    let arguments = ["replay", "--input", "in.csv", "--output", "pipe"];
    assert!(dashpot(&arguments, folder.path()).status.success());
    assert!(std::fs::metadata(at("pipe")).unwrap().file_type().is_fifo());
    assert_eq!(reader.join().unwrap(), written);
}

#[test]
fn a_gap_is_crossed_in_a_straight_line() {
    let (output, written) = replay_of(
        b"time_s,displacement_m\n0,0\n0.001,0\n0.101,0.0001\n",
        &["--step-us", "10000"],
    );
    assert!(output.status.success());
    let rows: Vec<String> = written
        .unwrap()
        .lines()
        .skip(1)
        .map(str::to_owned)
        .collect();
    assert_eq!(rows.len(), 11);
    let x: f64 = rows[5].split(',').nth(1).unwrap().parse().unwrap();
    assert!((x - 1e-4 * 0.049 / 0.1).abs() < 1e-15);
}

#[test]
fn verify_reports_each_step_and_can_fail() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::from("time_s,displacement_m\n");
    for tick in 0..=500 {
        let time = f64::from(tick) * 2e-3;
        let x = 5e-3 * (std::f64::consts::TAU * 1.4 * time).sin();
        text.push_str(&format!("{time},{x}\n"));
    }
    std::fs::write(folder.path().join("in.csv"), text).unwrap();
    let arguments = [
        "verify",
        "--damper",
        "paper",
        "--input",
        "in.csv",
        "--step-us",
        "1000",
        "--format",
        "json",
    ];
    let output = dashpot(&arguments, folder.path());
    assert!(output.status.success(), "{}", error_of(&output));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = report["deviations"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert!(row["nrmse"].as_f64().unwrap() < 1e-3, "{row}");
        assert!(
            row["largest_error_over_peak"].as_f64().unwrap() < 1e-2,
            "{row}"
        );
    }
    let mut strict = arguments.to_vec();
    strict.extend(["--at-most", "1e-12"]);
    let output = dashpot(&strict, folder.path());
    assert_eq!(output.status.code(), Some(1));
    assert!(error_of(&output).contains("--at-most"));
}

#[test]
fn wrong_use_is_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        &["replay"][..],
        &["replay", "--input", "a", "--output", "b", "--step-us", "0"],
        &["nonsense"],
    ] {
        assert_eq!(dashpot(arguments, folder.path()).status.code(), Some(2));
    }
}

#[test]
fn damper_files_name_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("in.csv"),
        "time_s,displacement_m\n0,0\n1,1\n",
    )
    .unwrap();
    for (set, expected) in [
        ("mount.clearence_m=1e-3", "did you mean `clearance_m`"),
        ("mount.stiffness_n_per_m=-1", "mount.stiffness_n_per_m = -1"),
        ("mount.stiffness_n_per_m", "no `=`"),
        (
            "geometry.rod_diameter_m=0.07",
            "0 to 0.95 of piston_diameter_m",
        ),
        (
            "valves.foot_compression.clamp_radius_m=0.2",
            "below free_radius_m",
        ),
    ] {
        let arguments = [
            "replay", "--set", set, "--input", "in.csv", "--output", "out.csv",
        ];
        let output = dashpot(&arguments, folder.path());
        let error = error_of(&output);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains(expected), "`{error}` lacks `{expected}`");
    }
    let output = dashpot(
        &[
            "replay", "--damper", "papr", "--input", "in.csv", "--output", "o",
        ],
        folder.path(),
    );
    assert!(error_of(&output).contains("did you mean `paper`"));
}

/// A million rows in 4 MiB of heap, where holding them takes 16: the system refuses more.
#[cfg(target_os = "linux")]
#[test]
fn a_million_rows_replay_in_bounded_memory() {
    use std::io::Write;
    const ROWS: u32 = 1_000_000;
    let folder = tempfile::tempdir().unwrap();
    let input = std::fs::File::create(folder.path().join("in.csv")).unwrap();
    let mut input = std::io::BufWriter::new(input);
    writeln!(input, "time_s,displacement_m").unwrap();
    for row in 0..ROWS {
        let time_s = f64::from(row) * 1e-3;
        writeln!(input, "{time_s:.3},{:.6}", 1e-2 * (8.8 * time_s).sin()).unwrap();
    }
    input.into_inner().unwrap();
    let limited = |arguments: &str| {
        Command::new("sh")
            .arg("-c")
            .arg(format!(
                "ulimit -c 0 && ulimit -d 4096 && exec \"$0\" {arguments}"
            ))
            .arg(env!("CARGO_BIN_EXE_dashpot"))
            .current_dir(folder.path())
            .output()
            .unwrap()
    };
    let output = limited("replay --input in.csv --output out.csv");
    assert!(output.status.success(), "{}", error_of(&output));
    let written = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert_eq!(written.lines().count(), 1 + ROWS as usize);
    // The limit bites: verification keeps every tick.
    let output = limited("verify --input in.csv");
    assert!(!output.status.success());
    assert!(
        error_of(&output).contains("memory allocation"),
        "{}",
        error_of(&output)
    );
}
