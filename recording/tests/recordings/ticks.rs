//! Recordings resampled to ticks: rounding, gaps and limits.

use std::fmt::Write;
use std::io::Cursor;
use std::path::Path;
use std::rc::Rc;

use dashpot_recording::tick_grid::{MeasuredGrid, MeasuredTick, Tick, TickGrid, rounding_s};
use dashpot_recording::{Channels, Measurement, Recording, Sample};

/// Returns a motion from pairs of time (s) and displacement (m).
fn motion(rows: &[(f64, f64)]) -> Recording {
    let sample = |&(time_s, displacement_m): &(f64, f64)| Sample {
        time_s,
        displacement_m,
    };
    let samples = rows.iter().map(sample).collect();
    Recording::from_samples(Path::new("motion"), Rc::new(samples))
}

/// Returns a motion at rest from its times (s).
fn rest(times_s: &[f64]) -> Recording {
    let rows: Vec<(f64, f64)> = times_s.iter().map(|&time_s| (time_s, 0.5)).collect();
    motion(&rows)
}

fn grid(recording: Recording, step_s: f64) -> TickGrid {
    TickGrid::new(recording, step_s).expect("a first row")
}

fn ticks(recording: Recording, step_s: f64) -> Vec<Tick> {
    grid(recording, step_s).read_all().expect("valid rows")
}

/// Returns the error after `valid` ticks.
fn error_after(valid: usize, recording: Recording, step_s: f64) -> String {
    let mut grid = grid(recording, step_s);
    for _ in 0..valid {
        let tick = grid.next_tick().expect("a valid row");
        assert!(tick.is_some());
    }
    let tick = grid.next_tick();
    tick.expect_err("an invalid row").to_string()
}

/// Returns the ticks of a measurement with these times (s), at constant displacement and force.
fn measured(times_s: &[f64], step_s: f64) -> Vec<MeasuredTick> {
    let mut text = String::from("time_s,displacement_m,force_n\n");
    for time_s in times_s {
        writeln!(text, "{time_s},0.5,100").expect("a text grows");
    }
    let source = Box::new(Cursor::new(text.into_bytes()));
    let measurement = Measurement::read(Path::new("x.csv"), source, &Channels::default());
    let measurement = measurement.expect("a valid header");
    let mut grid = MeasuredGrid::new(measurement, step_s).expect("a first row");
    assert_eq!(grid.start_s(), times_s[0]);
    std::iter::from_fn(|| grid.next_tick().expect("valid rows")).collect()
}

/// The rounding is one billionth of the step plus four units of the last place of the time.
#[test]
fn rounding_grows_with_the_step_and_the_distance_from_time_zero() {
    assert_eq!(rounding_s(0.0, 2.0), 2e-9);
    // 4 * 2^-52 * 2^20 = 2^-30.
    let million_s = f64::from(1 << 20);
    assert_eq!(rounding_s(million_s, 0.0), 2.0_f64.powi(-30));
    assert_eq!(rounding_s(-million_s, 0.0), 2.0_f64.powi(-30));
    assert_eq!(rounding_s(million_s, 1.0), 2.0_f64.powi(-30) + 1e-9);
}

/// At such times (seconds since 1970), a double resolves only 0.24 us.
#[test]
fn samples_of_a_logger_with_the_time_of_day_stay_on_their_ticks() {
    let rows: Vec<(f64, f64)> = (0..1000)
        .map(|row| {
            let time_s = format!("1700000000.{:03}", row + 1);
            (time_s.parse().expect("a number"), f64::from(row % 7))
        })
        .collect();
    let found = ticks(motion(&rows[..999]), 1e-3);
    let displacements_m: Vec<f64> = found.iter().map(|tick| tick.displacement_m).collect();
    let expected: Vec<f64> = rows[..999].iter().map(|row| row.1).collect();
    assert_eq!(displacements_m, expected);
}

#[test]
fn a_sample_counts_for_its_tick_if_it_is_early_by_no_more_than_the_rounding() {
    let early_s = 1.0 - rounding_s(1.0, 1.0);
    assert_eq!(early_s + rounding_s(1.0, 1.0), 1.0);
    let found = ticks(motion(&[(0.0, 1.0), (early_s, 2.0)]), 1.0);
    let expected = [(0.0, 1.0), (1.0, 2.0)];
    assert_eq!(
        found,
        expected.map(|(time_s, displacement_m)| Tick {
            time_s,
            displacement_m
        })
    );
    let too_early_s = 1.0 - 2.0 * rounding_s(1.0, 1.0);
    assert_eq!(ticks(rest(&[0.0, too_early_s]), 1.0).len(), 1);
}

#[test]
fn displacements_are_linear_between_samples_from_the_first_sample_on() {
    let rows = [(2.0, 1.0), (2.5, 2.0), (4.0, -1.0)];
    let found = grid(motion(&rows), 0.5);
    assert_eq!(found.start_s(), 2.0);
    let displacements_m = found.displacements_m().expect("valid rows");
    assert_eq!(displacements_m, [1.0, 2.0, 1.0, 0.0, -1.0]);
}

/// Rows at 0 s and, after a gap of `gap_s` (s), one per second; the row with this number after the gap repeats a time.
fn backward_after_gap(gap_s: f64, number: u32) -> Recording {
    let mut times_s = vec![0.0];
    times_s.extend((0..=number).map(|row| gap_s + f64::from(row.min(number - 1))));
    rest(&times_s)
}

/// If the clock of the logger jumps forward and back, the ticks between must not be computed.
#[test]
fn a_jump_back_within_1000_rows_after_a_long_gap_is_reported_before_the_gap_is_filled() {
    let step_s = 1.0;
    // The gap is longer than 1000 ticks. The first row after it is not counted, because it ends the gap.
    let error = error_after(1, backward_after_gap(1001.0, 1000), step_s);
    assert!(error.contains("time 2000 s does not increase"), "{error}");
    // One row later is too late to be noticed at the start of the gap.
    let error = error_after(2002, backward_after_gap(1001.0, 1001), step_s);
    assert!(error.contains("time 2001 s does not increase"), "{error}");
    // A gap of exactly 1000 ticks is filled at once. The error follows when its row is reached.
    let error = error_after(1001, backward_after_gap(1000.0, 1), step_s);
    assert!(error.contains("time 1000 s does not increase"), "{error}");
}

/// The limit of long gaps counts ticks, not seconds, and not the time since zero.
#[test]
fn a_gap_is_long_by_its_ticks_wherever_it_lies() {
    let error = error_after(1, backward_after_gap(10.0, 1), 1.0 / 128.0);
    assert!(error.contains("time 10 s does not increase"), "{error}");
    let late_s = [1e4, 1.2e4, 1.2e4];
    let error = error_after(1, rest(&late_s), 1.0);
    assert!(error.contains("time 12000 s does not increase"), "{error}");
    // An interval of one tick is short.
    let late_s = [1e4, 1e4 + 1.0, 1e4 + 2.0, 1e4 + 2.0];
    let error = error_after(3, rest(&late_s), 1.0);
    assert!(error.contains("time 10002 s does not increase"), "{error}");
}

#[test]
fn gaps_of_more_than_ten_million_ticks_are_errors() {
    let step_s = 0.5;
    let longest_s = 1e7 * step_s;
    let mut allowed = grid(rest(&[3.0, 3.0 + longest_s]), step_s);
    for _ in 0..2 {
        assert!(allowed.next_tick().expect("an allowed gap").is_some());
    }
    let error = error_after(1, rest(&[3.0, 3.5 + longest_s]), step_s);
    let expected = "time jumps from 3 s to 5000003.5 s: 10000001 ticks without a sample";
    assert!(error.contains(expected), "{error}");
}

#[test]
fn recordings_of_more_than_864_million_ticks_are_errors() {
    let step_s = 0.5;
    let start_s = 3.0;
    let end_s = start_s + 864e6 * step_s;
    // Ends in gaps of the longest allowed length; the rows after such a gap are read before it is filled.
    let times_s = |end_s: f64| {
        let before = (0..=86).map(|row| start_s + f64::from(row) * 1e7 * step_s);
        before.chain([end_s]).collect::<Vec<f64>>()
    };
    let mut allowed = grid(rest(&times_s(end_s)), step_s);
    for _ in 0..2 {
        assert!(allowed.next_tick().expect("an allowed length").is_some());
    }
    let error = error_after(1, rest(&times_s(end_s + step_s)), step_s);
    let expected = "432000003.5 s is more than 864000000 ticks after the first sample";
    assert!(error.contains(expected), "{error}");
}

/// Rows at every eighth of a second from 3 s on, with one interval of `gap_s` (s) in the middle.
fn eighths(gap_s: f64) -> Vec<f64> {
    let eighth = |row: u32| f64::from(row) / 8.0;
    let before = (0..=16).map(eighth);
    let after = (0..=16).map(|row| 2.0 + gap_s + eighth(row));
    before.chain(after).map(|time_s| 3.0 + time_s).collect()
}

/// Number of ticks without a known force.
fn unknown(ticks: &[MeasuredTick]) -> usize {
    let is_unknown = |tick: &&MeasuredTick| tick.displacement_m.is_nan() && tick.force_n.is_nan();
    ticks.iter().filter(is_unknown).count()
}

#[test]
fn an_interval_is_a_gap_if_it_is_longer_than_five_ticks_and_five_medians() {
    // Five ticks and ten medians; then one sample interval longer. The ticks at the ends are at samples.
    assert_eq!(unknown(&measured(&eighths(1.25), 0.25)), 0);
    assert_eq!(unknown(&measured(&eighths(1.375), 0.25)), 5);
    // Ten ticks and five medians; then one tick longer.
    assert_eq!(unknown(&measured(&eighths(0.625), 0.0625)), 0);
    assert_eq!(unknown(&measured(&eighths(0.6875), 0.0625)), 10);
}
