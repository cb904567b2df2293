//! `dashpot replay` as its users run it.

use std::process::Command;

use assert_cmd::assert::{Assert, OutputAssertExt};
use predicates::str::contains;

use crate::common::{dashpot, error_of, files_in, json_of, program, text_of};

/// Replays `bytes`; returns its output and the contents of the output file.
fn replay_of(bytes: &[u8], more: &[&str]) -> (Assert, Option<String>) {
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
    let known = ["in.csv", "out.csv"];
    let left = files_in(folder.path());
    assert!(
        left.iter().all(|name| known.contains(&name.as_str())),
        "left behind: {left:?}"
    );
    (output, written)
}

#[test]
fn a_ramp_ends_at_damping_times_velocity() {
    // 10 mm/s over a clearance of 2a = 1 mm: C v = 1200 N once the springs are stretched.
    let (output, written) = replay_of(
        b"\xef\xbb\xbf# a logger's \
         comment\r\nname,displacement_m,time_s\r\na,0.0,10.0\r\nb,0.005,10.5\r\nc,0.01,11.0\r\n",
        &["--scalar", "f64", "--format", "json"],
    );
    let output = output.success();
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
    let report = json_of(&output);
    assert_eq!(report["ticks"], 1001);
    assert_eq!(report["input_limited"], false);
}

#[test]
fn bad_recordings_are_reported_with_their_location_and_leave_no_output() {
    let cases: [(&[u8], &[&str]); 9] = [
        (
            b"time_s,displacement_m\n0,0\n0.1,0\n0.05,0\n",
            &["in.csv:4: column time_s", "does not increase"],
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
            &["line 3", "3 cells, but the header has 2"],
        ),
        (
            b"time_s,force\n0,0\n",
            &["column displacement_m is missing"],
        ),
        (
            b"time_s,time_s,displacement_m\n0,0,0\n",
            &["column time_s appears 2 times in the header"],
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
        output.code(1);
        assert_eq!(written, None, "{error}");
        for part in expected {
            assert!(error.contains(part), "`{error}` lacks `{part}`");
        }
    }
}

#[test]
fn a_failed_replay_keeps_the_existing_output() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("in.csv"),
        "time_s,displacement_m\n0,0\n1,x\n",
    )
    .unwrap();
    std::fs::write(folder.path().join("out.csv"), "precious").unwrap();
    let arguments = ["replay", "--input", "in.csv", "--output", "out.csv"];
    dashpot(&arguments, folder.path()).code(1);
    let kept = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert_eq!(kept, "precious");
    let onto_itself = ["replay", "--input", "in.csv", "--output", "in.csv"];
    dashpot(&onto_itself, folder.path()).stderr(contains("this is also an input file"));
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
    dashpot(&arguments, folder.path()).success();
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
    dashpot(&arguments, folder.path()).success();
    assert!(std::fs::metadata(at("pipe")).unwrap().file_type().is_fifo());
    assert_eq!(reader.join().unwrap(), written);
}

#[test]
fn a_gap_is_crossed_in_a_straight_line() {
    let (output, written) = replay_of(
        b"time_s,displacement_m\n0,0\n0.001,0\n0.101,0.0001\n",
        &["--step-us", "10000"],
    );
    output.success();
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

/// A displacement that is 10.5 mm off is followed at the rate limit of 2 mm per tick, and the report covers this
/// motion.
#[test]
fn energy_is_that_of_the_motion_followed() {
    for scalar in ["f32", "f64"] {
        let (output, written) = replay_of(
            b"time_s,displacement_m\n0,0\n0.001,0.0105\n0.002,0.001\n0.003,0\n",
            &["--scalar", scalar, "--format", "json"],
        );
        let output = output.success();
        let forces: Vec<f64> = written
            .unwrap()
            .lines()
            .skip(1)
            .map(|line| line.rsplit(',').next().unwrap().parse().unwrap())
            .collect();
        let followed = [0.0, 2e-3, 1e-3, 0.0];
        let energy: f64 = (1..4)
            .map(|i| 0.5 * (forces[i] + forces[i - 1]) * (followed[i] - followed[i - 1]))
            .sum();
        assert!(energy > 1.0, "the damper is felt: {forces:?}");
        let report = json_of(&output);
        let reported = report["energy_j"].as_f64().unwrap();
        assert!(
            (reported / energy - 1.0).abs() < 1e-6,
            "{reported} {energy}"
        );
        assert_eq!(report["limited_inputs"], 1);
    }
}

#[test]
fn held_and_limited_input_is_reported() {
    // 1e39 overflows to infinity in single precision.
    let motion = b"time_s,displacement_m\n5,0\n5.001,1e39\n5.002,0\n5.003,0.012\n5.004,0.001\n";
    let (output, _) = replay_of(motion, &["--format", "json"]);
    let report = json_of(&output);
    for (key, value) in [
        ("rejected_inputs", 2),
        ("held_inputs", 1),
        ("limited_inputs", 1),
    ] {
        assert_eq!(report[key], value, "{key}");
    }
    assert_eq!(report["input_held"], true);
    assert_eq!(report["input_limited"], true);
    assert_eq!(report["first_rejected_s"], 5.001);
    let (output, _) = replay_of(motion, &[]);
    let text = text_of(&output);
    for part in [
        "input held at 1 tick:",
        "input rate-limited at 1 tick:",
        "limits.rate_m_per_s = 2\n",
        "first at 5.001 s",
    ] {
        assert!(text.contains(part), "`{text}` lacks `{part}`");
    }
    let (output, _) = replay_of(b"time_s,displacement_m\n0,0\n1,0.001\n", &[]);
    assert!(!text_of(&output).contains("warning"), "{output:?}");
}

/// Ticks are counted even beyond the range of the state's counter.
#[test]
fn rejected_ticks_are_all_counted() {
    let motion = b"time_s,displacement_m\n0,0\n70,1000\n";
    let (output, _) = replay_of(motion, &["--format", "json"]);
    let report = json_of(&output);
    assert_eq!(report["rejected_inputs"], 70_000, "{report}");
    assert!(report["held_inputs"].as_u64() > Some(69_000), "{report}");
}

/// Replays a million rows in a heap that the system limits to 4 MiB; storing the rows would take 16 MiB.
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
            .arg(program())
            .current_dir(folder.path())
            .assert()
    };
    limited("replay --input in.csv --output out.csv").success();
    let written = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert_eq!(written.lines().count(), 1 + ROWS as usize);
    // The limit works: `verify`, which stores the whole recording, fails.
    limited("verify --input in.csv")
        .failure()
        .stderr(contains("out of memory"));
}
