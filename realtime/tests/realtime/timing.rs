//! Tests of distributions against sorted samples, of bins, and of the machine description.

use std::fs;
use std::path::Path;
use std::time::{Duration, SystemTime};

use dashpot_realtime::timing::{Distribution, Machine};

fn distribution(spans_ns: impl IntoIterator<Item = f64>) -> Distribution {
    let mut result = Distribution::new();
    spans_ns.into_iter().for_each(|span| result.record_ns(span));
    result
}

#[test]
fn percentiles_match_sorted_samples() {
    let mut samples = Vec::new();
    let mut seed = 1_u64;
    for _ in 0..200_000 {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        samples.push(10.0 + ((seed >> 40) as f64).sqrt());
    }
    let figures = distribution(samples.iter().copied()).figures();
    let longest = samples.iter().copied().fold(0.0, f64::max);
    let index = samples.iter().position(|span| *span == longest).unwrap();
    assert_eq!(
        (figures.worst_ns, figures.worst_index),
        (longest, index as u64)
    );
    samples.sort_by(f64::total_cmp);
    for (fraction, found) in [
        (0.5, figures.p50_ns),
        (0.9, figures.p90_ns),
        (0.99, figures.p99_ns),
        (0.999, figures.p99_9_ns),
        (0.9999, figures.p99_99_ns),
    ] {
        let (found, expected) = (
            found.unwrap(),
            samples[(fraction * 200_000.0_f64).ceil() as usize - 1],
        );
        // Three significant digits.
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "{fraction}: {found} {expected}"
        );
    }
}

/// p50 needs 20 spans, p90 100 and so on, so that ten spans are expected beyond each percentile.
#[test]
fn percentiles_are_reported_only_with_ten_spans_beyond_them() {
    let reported = |count: usize| {
        let figures = distribution((0..count).map(|i| i as f64)).figures();
        [
            figures.p50_ns,
            figures.p90_ns,
            figures.p99_ns,
            figures.p99_9_ns,
            figures.p99_99_ns,
        ]
        .iter()
        .filter(|percentile| percentile.is_some())
        .count()
    };
    for (number, count) in [20, 100, 1_000, 10_000, 100_000].into_iter().enumerate() {
        assert_eq!(reported(count - 1), number, "{count} - 1 spans");
        assert_eq!(reported(count), number + 1, "{count} spans");
    }
    let json = serde_json::to_value(distribution([1.0]).figures()).unwrap();
    assert!(json["p50_ns"].is_null() && json["worst_ns"] == 1.0);
}

#[test]
fn the_first_of_equal_longest_spans_is_reported() {
    let figures = distribution([3.0, 7.0, 5.0, 7.0]).figures();
    assert_eq!((figures.worst_ns, figures.worst_index), (7.0, 1));
}

#[test]
fn bins_do_not_depend_on_the_spans() {
    let r10 = [1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0, 10.0];
    // Record a span in the middle of each bin of two decades, first alone, then with other spans.
    for decade in [10.0, 1e6] {
        for pair in r10.windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]) * decade;
            let alone = distribution([middle]).bins();
            let with_others = distribution([middle, 0.3, 2e10]).bins();
            assert_eq!((alone.len(), with_others.len()), (1, 3));
            assert_eq!(alone[0], with_others[1]);
            let border = alone[0].to_ns.unwrap();
            assert!((alone[0].from_ns / (pair[0] * decade) - 1.0).abs() < 1e-12);
            assert!((border / (pair[1] * decade) - 1.0).abs() < 1e-12);
            // A span at an edge belongs to the upper bin.
            assert_eq!(distribution([border]).bins()[0].from_ns, border);
        }
    }
    let ends = distribution([0.0, 1e11]).bins();
    assert_eq!((ends[0].from_ns, ends[0].to_ns), (0.0, Some(1.0)));
    assert_eq!((ends[1].from_ns, ends[1].to_ns), (1e10, None));
}

/// Reads the description of a machine at noon on 1 January 2026.
fn machine(root: &Path, core: Option<usize>) -> Machine {
    let noon = SystemTime::UNIX_EPOCH + Duration::from_secs(1_767_268_800);
    Machine::read(root, core, noon)
}

#[test]
fn a_machine_is_described_from_its_files() {
    let root = tempfile::tempdir().unwrap();
    let write = |path: &str, text: &str| {
        let path = root.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    write(
        "proc/cpuinfo",
        "processor\t: 0\nmodel name\t: Six Core 3000\n",
    );
    write("proc/sys/kernel/osrelease", "6.12.1-rt5\n");
    write("proc/loadavg", "0.50 1.25 2.00 1/100 4711\n");
    for (core, governor) in [(0, "performance\n"), (1, "powersave\n"), (2, "powersave\n")] {
        let path = format!("sys/devices/system/cpu/cpu{core}/cpufreq/scaling_governor");
        write(&path, governor);
    }
    let reported = machine(root.path(), None).to_string();
    for part in [
        "processor Six Core 3000",
        "kernel 6.12.1-rt5",
        "governor performance, powersave",
        "load average 0.50 1.25 2.00",
        "2026-01-01T12:00:00Z",
    ] {
        assert!(reported.contains(part), "{part}: {reported}");
    }
    let pinned = machine(root.path(), Some(1)).governor;
    assert_eq!(pinned.as_deref(), Some("powersave"));
}

#[test]
fn missing_properties_of_a_machine_are_unknown() {
    let root = tempfile::tempdir().unwrap();
    let empty = machine(root.path(), None);
    let reported = empty.to_string();
    for part in [
        "processor unknown",
        "kernel unknown",
        "governor unknown",
        "load average unknown",
    ] {
        assert!(reported.contains(part), "{part}: {reported}");
    }
    let json = serde_json::to_value(empty).unwrap();
    for key in ["processor", "kernel", "governor", "load_average"] {
        assert!(json[key].is_null(), "{key}: {json}");
    }
    // An incomplete load average is ignored.
    fs::create_dir(root.path().join("proc")).unwrap();
    fs::write(root.path().join("proc/loadavg"), "0.50 1.25").unwrap();
    assert_eq!(machine(root.path(), None).load_average, None);
}
