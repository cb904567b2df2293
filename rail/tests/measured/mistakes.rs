//! Files in another unit and files with unsorted points: the error names the mistake.

use dashpot_rail::profile::Body;
use dashpot_rail::profile::measured::{self, Mirror, ProfileError};

use crate::common::{EXACT, RAILS, WHEELS, rail, rail_readings, text, wheel, wheel_readings};

type Rows = Vec<(f64, f64)>;

fn scaled(rows: &Rows, factor: f64) -> Rows {
    rows.iter().map(|(y, z)| (y * factor, z * factor)).collect()
}

/// The same rows in a random order, which depends on nothing but their number.
fn shuffled(rows: &Rows) -> Rows {
    let mut rows = rows.clone();
    let mut seed = 7_u64;
    for i in (1..rows.len()).rev() {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        rows.swap(i, (seed >> 33) as usize % (i + 1));
    }
    rows
}

#[test]
fn a_file_in_another_unit_is_named_as_such() {
    for (factor, part) in [(1e-3, "metres"), (1.0 / 25.4, "inches")] {
        for error in [
            wheel(&text(&scaled(&wheel_readings(), factor))).unwrap_err(),
            rail(&text(&scaled(&rail_readings(), factor))).unwrap_err(),
        ] {
            assert!(matches!(error, ProfileError::Unit { .. }), "{error}");
            assert!(error.to_string().contains(part), "{error}");
        }
    }
}

#[test]
fn every_format_names_a_file_in_metres() {
    // Divides every number of the data rows by 1000. The SIMPACK rail is in metres already; its units are stated.
    let in_metres = |text: &str| {
        let lines = text.lines().map(|line| {
            let cells: Vec<&str> = line
                .split([' ', ','])
                .filter(|cell| !cell.is_empty())
                .collect();
            let numbers: Result<Vec<f64>, _> =
                cells.iter().map(|cell| cell.parse::<f64>()).collect();
            match numbers {
                Ok(numbers) if numbers.len() >= 2 => numbers
                    .iter()
                    .map(|number| format!("{:.7} ", number * 1e-3))
                    .collect::<String>(),
                _ => line.to_owned(),
            }
        });
        lines.map(|line| line + "\n").collect::<String>()
    };
    for (body, files) in [(Body::Wheel, WHEELS), (Body::Rail, RAILS)] {
        for (name, text) in files {
            let options = EXACT.with_mirror(Some(Mirror::None));
            let error = measured::parse(name, &in_metres(text), body, &options).unwrap_err();
            let ProfileError::Unit { width_mm, .. } = error else {
                panic!("{name}: {error}");
            };
            assert!((0.06..0.15).contains(&width_mm), "{name}: {width_mm}");
        }
    }
}

#[test]
fn a_simpack_file_without_its_unit_is_too_wide() {
    let (name, text) = WHEELS[2];
    let text = text.replace("units.len.f", "units.len.unknown");
    let error = measured::parse(name, &text, Body::Wheel, &EXACT).unwrap_err();
    assert!(
        matches!(error, ProfileError::Unit { width_mm, .. } if width_mm > 1e5),
        "{error}"
    );
    assert!(error.to_string().contains("units.len.f"), "{error}");
}

#[test]
fn unsorted_points_are_named_with_the_first_jump() {
    for (body, rows) in [
        (Body::Wheel, wheel_readings()),
        (Body::Rail, rail_readings()),
    ] {
        let read = |rows: &Rows| measured::parse("x.csv", &text(rows), body, &EXACT);
        assert!(read(&rows).is_ok());
        // In random order, in order of depth, and as two halves that both begin in the middle.
        let mut by_depth = rows.clone();
        by_depth.sort_by(|p, q| p.1.total_cmp(&q.1));
        let middle = rows.len() / 2;
        let mut halves = rows[middle..].to_vec();
        halves.extend(rows[..middle].iter().rev());
        let mut swapped = rows[middle..].to_vec();
        swapped.extend(&rows[..middle]);
        for unsorted in [shuffled(&rows), by_depth, halves, swapped] {
            let error = read(&unsorted).unwrap_err();
            let ProfileError::Unsorted { line, jump_mm } = error else {
                panic!("{error}");
            };
            // The first row is on line 3.
            let [p, q] = [line - 4, line - 3].map(|row| unsorted[row as usize]);
            assert!(
                ((q.0 - p.0).hypot(q.1 - p.1) - jump_mm).abs() < 1e-9,
                "{line}: {jump_mm}"
            );
            assert!(jump_mm > measured::MAX_GAP_MM);
        }
    }
}

#[test]
fn a_gap_is_not_called_a_lack_of_order() {
    let mut rows = wheel_readings();
    rows.drain(100..115);
    let error = wheel(&text(&rows)).unwrap_err();
    assert!(matches!(error, ProfileError::Gap { .. }), "{error}");
    let error = wheel(&text(&shuffled(&rows))).unwrap_err();
    assert!(!matches!(error, ProfileError::Unsorted { .. }), "{error}");
}
