//! Hertz constants and Kalker coefficients, compared with published tables and closed forms.

use dashpot_rail::contact::{Hertz, Steel};
use dashpot_rail::creep::{KalkerError, KalkerTable};

const HERTZ: &str = include_str!("../../data/hertz.csv");

#[test]
fn a_wheel_on_a_rail_head_has_the_known_ellipse() {
    let hertz = Hertz::new(&Steel::default(), 1.0 / 0.625, 1.0 / 0.30);
    let load = 101_340.0;
    let penetration = hertz.penetration_m(load);
    let [a, b] = hertz.semi_axes_m(penetration);
    let peak = 1.5 * load / (std::f64::consts::PI * a * b);
    assert!((a * 1e3 - 8.340).abs() < 1e-3, "{a}");
    assert!((b * 1e3 - 5.119).abs() < 1e-3, "{b}");
    assert!((peak * 1e-6 - 1133.0).abs() < 0.5, "{peak}");
    assert!((penetration * 1e3 - 0.0993).abs() < 5e-5, "{penetration}");
    assert!((hertz.load_n(penetration) / load - 1.0).abs() < 1e-12);
}

#[test]
fn a_ball_agrees_with_its_closed_form() {
    let steel = Steel::default();
    let plane = steel.young_modulus_pa / (2.0 * (1.0 - steel.poisson_ratio.powi(2)));
    let hertz = Hertz::new(&steel, 5.0, 5.0);
    let stiffness = 4.0 / 3.0 * plane * 0.2_f64.sqrt();
    assert!((hertz.stiffness_n_per_m_1_5 / stiffness - 1.0).abs() < 1e-12);
    assert!((hertz.a_factor_m_0_5 / 0.2_f64.sqrt() - 1.0).abs() < 1e-12);
}

#[test]
fn without_positive_curvatures_there_is_no_contact() {
    for (rolling, across) in [
        (0.0, 1.0),
        (1.0, -1.0),
        (f64::NAN, 1.0),
        (1.0, f64::INFINITY),
    ] {
        let hertz = Hertz::new(&Steel::default(), rolling, across);
        assert_eq!(hertz.load_n(1e-4), 0.0);
        assert_eq!(hertz.semi_axes_m(1e-4), [0.0; 2]);
    }
}

#[test]
fn hertz_s_table_is_reproduced() {
    let steel = Steel::default();
    let plane = steel.young_modulus_pa / (2.0 * (1.0 - steel.poisson_ratio.powi(2)));
    for line in HERTZ
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
    {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        // A + B = 2 per m, B - A follows from theta; the rolling direction has the smaller curvature.
        let difference = 2.0 * row[0].to_radians().cos();
        let hertz = Hertz::new(&steel, 2.0 - difference, 2.0 + difference);
        let circle = (3.0 * 1000.0 / (4.0 * plane * 2.0)).cbrt();
        let penetration = hertz.penetration_m(1000.0);
        let [a, b] = hertz.semi_axes_m(penetration);
        let approach = penetration / (circle * circle * 2.0);
        assert!(
            (a / circle - row[1]).abs() < 6e-5 * row[1].max(1.0),
            "{row:?} {}",
            a / circle
        );
        assert!((b / circle - row[2]).abs() < 6e-5, "{row:?} {}", b / circle);
        assert!((approach - row[4]).abs() < 6e-5, "{row:?} {approach}");
    }
}

const KALKER: &str = include_str!("../../data/kalker.csv");

/// Rows of Kalker's table, read independently of the library.
fn kalker_rows() -> Vec<[f64; 6]> {
    KALKER
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| {
            let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            cells.try_into().unwrap()
        })
        .collect()
}

#[test]
fn kalker_s_table_is_reproduced_at_every_poisson_ratio() {
    let rows = kalker_rows();
    assert_eq!(rows.len(), 57);
    for row in rows {
        let c = KalkerTable::new(row[1]).unwrap().at(row[0]);
        for (computed, table) in [c.c11, c.c22, c.c23, c.c33].into_iter().zip(&row[2..]) {
            assert!((computed / table - 1.0).abs() < 1e-9, "{row:?} {c:?}");
        }
    }
}

#[test]
fn interpolation_recovers_removed_rows() {
    // A table with every other ratio must reproduce the coefficients in between. It has twice the spacing, so at most
    // about sixteen times the error.
    let header = "a_over_b,nu,C11,C22,C23,C33\n".to_owned();
    let rows = kalker_rows();
    let half = rows
        .chunks(3)
        .step_by(2)
        .flatten()
        .fold(header, |text, row| {
            text + &row.map(|cell| cell.to_string()).join(",") + "\n"
        });
    for poisson_ratio in [0.0, 0.25, 0.5] {
        let table = KalkerTable::from_csv(&half, poisson_ratio).unwrap();
        for row in rows.chunks(3).skip(1).step_by(2).flatten() {
            if row[1] != poisson_ratio {
                continue;
            }
            let c = table.at(row[0]);
            for (computed, known) in [c.c11, c.c22, c.c23].into_iter().zip(&row[2..]) {
                let error = computed / known - 1.0;
                assert!(error.abs() < 0.015, "{row:?} {c:?} {error}");
            }
        }
    }
}

#[test]
fn a_wrong_kalker_table_is_rejected_with_line_and_column() {
    let message = |text: &str| KalkerTable::from_csv(text, 0.3).unwrap_err().to_string();
    for (from, to, expected) in [
        (
            "\n0.1,0.25,3.31,",
            "\n0.1,0.25,x,",
            "line 5: column C11: \"x\", allowed: a positive number",
        ),
        (
            "\n0.1,0.25,3.31,",
            "\n# a comment\n0.1,0.25,x,",
            "line 6: column C11: \"x\"",
        ),
        (
            "\n0.1,0.25,3.31,",
            "\n0.1,0.25,NaN,",
            "line 5: column C11: \"NaN\"",
        ),
        (
            "\n0.1,0.25,3.31,",
            "\n0.1,0.25,-3.31,",
            "line 5: column C11: \"-3.31\"",
        ),
        (
            "\n0.1,0.25,",
            "\n0.1,0.75,",
            "line 5: column nu: \"0.75\", allowed: a number from 0 to 0.5",
        ),
        (
            "\n0.1,0.25,3.31,",
            "\n0.1,0.25,",
            "line 5: 5 cells, allowed: 6",
        ),
        ("\n0.2,0,", "\n0.1,0,", "line 7: rows out of order"),
        ("\n0.1,0.25,", "\n0.1,0.2,", "line 8: rows out of order"),
        (
            "C22",
            "C12",
            "line 3: columns \"a_over_b,nu,C11,C12,C23,C33\"",
        ),
        (
            "\n10,0.5,12.9,16.0,18.0,0.228",
            "",
            "56 rows, allowed: three for each a_over_b",
        ),
    ] {
        let text = KALKER.replacen(from, to, 1);
        assert_ne!(text, KALKER, "{from:?} is not in the table");
        let message = message(&text);
        assert!(message.starts_with(expected), "{message} for {expected}");
    }
    assert_eq!(
        message(""),
        "0 rows, allowed: three for each a_over_b, with three or more values of a_over_b"
    );
    for poisson_ratio in [-0.01, 0.51, f64::NAN] {
        let error = KalkerTable::new(poisson_ratio).unwrap_err();
        assert!(matches!(error, KalkerError::PoissonRatio { .. }), "{error}");
    }
}

#[test]
fn slender_ellipses_approach_kalker_s_limits() {
    use std::f64::consts::PI;
    for nu in [0.0, 0.3, 0.5] {
        let table = KalkerTable::new(nu).unwrap();
        let c = table.at(1e-4);
        // The end of the table at 0.1 lies up to 4 % above the asymptotic limit.
        assert!(
            (c.c11 / (PI * PI / (4.0 * (1.0 - nu))) - 1.0).abs() < 0.04,
            "{c:?}"
        );
        assert!((c.c22 / (PI * PI / 4.0) - 1.0).abs() < 0.04, "{c:?}");
        for ratio in [0.1, 10.0] {
            let (below, above) = (
                table.at(ratio * (1.0 - 1e-9)),
                table.at(ratio * (1.0 + 1e-9)),
            );
            assert!((below.c11 / above.c11 - 1.0).abs() < 1e-7);
            assert!((below.c23 / above.c23 - 1.0).abs() < 1e-7);
        }
        for ratio in [1e-9, 1e-3, 0.05, 20.0, 1e3, 1e9] {
            let c = table.at(ratio);
            for value in [c.c11, c.c22, c.c23, c.c33] {
                assert!(
                    value.is_finite() && value > 0.0,
                    "nu {nu} ratio {ratio} {c:?}"
                );
            }
        }
    }
}
