//! Hertz and Kalker against their tables and closed forms.

use dashpot_rail::contact::hertz::{Hertz, Steel};
use dashpot_rail::creep::kalker::{self, KalkerTable};

const HERTZ: &str = include_str!("../../../data/contact/hertz.csv");

#[test]
fn a_wheel_on_a_rail_head_has_the_known_ellipse() {
    let hertz = Hertz::new(&Steel::default(), 1.0 / 0.625, 1.0 / 0.30);
    let load = 101_340.0;
    let penetration = hertz.penetration(load);
    let (a, b) = hertz.semi_axes(penetration);
    let peak = 1.5 * load / (std::f64::consts::PI * a * b);
    assert!((a * 1e3 - 8.340).abs() < 1e-3, "{a}");
    assert!((b * 1e3 - 5.119).abs() < 1e-3, "{b}");
    assert!((peak * 1e-6 - 1133.0).abs() < 0.5, "{peak}");
    assert!((penetration * 1e3 - 0.0993).abs() < 5e-5, "{penetration}");
    assert!((hertz.load(penetration) / load - 1.0).abs() < 1e-12);
}

#[test]
fn a_ball_has_its_closed_form() {
    let steel = Steel::default();
    let plane = steel.young / (2.0 * (1.0 - steel.poisson.powi(2)));
    let hertz = Hertz::new(&steel, 5.0, 5.0);
    let stiffness = 4.0 / 3.0 * plane * 0.2_f64.sqrt();
    assert!((hertz.stiffness / stiffness - 1.0).abs() < 1e-12);
    assert!((hertz.rolling / 0.2_f64.sqrt() - 1.0).abs() < 1e-12);
}

#[test]
fn every_row_of_hertz_s_table_is_met() {
    let steel = Steel::default();
    let plane = steel.young / (2.0 * (1.0 - steel.poisson.powi(2)));
    for line in HERTZ
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
    {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        // A + B = 2 per m, B - A by theta; the rolling direction is the flatter one.
        let difference = 2.0 * row[0].to_radians().cos();
        let hertz = Hertz::new(&steel, 2.0 - difference, 2.0 + difference);
        let circle = (3.0 * 1000.0 / (4.0 * plane * 2.0)).cbrt();
        let penetration = hertz.penetration(1000.0);
        let (a, b) = hertz.semi_axes(penetration);
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

#[test]
fn kalker_s_rows_are_met_at_every_poisson_number() {
    for row in kalker::rows() {
        let c = KalkerTable::new(row[1]).at(row[0]);
        for (computed, table) in [c.c11, c.c22, c.c23, c.c33].into_iter().zip(&row[2..]) {
            assert!((computed / table - 1.0).abs() < 1e-9, "{row:?} {c:?}");
        }
    }
    assert_eq!(kalker::rows().len(), 57);
}

#[test]
fn between_rows_a_dropped_row_comes_back() {
    // A spline through every other row must give the rows between: twice the table's spacing,
    // so at most about sixteen times its error.
    use dashpot_rail::math::spline::Spline;
    for poisson in [0.0, 0.25, 0.5] {
        let rows: Vec<[f64; 6]> = kalker::rows()
            .into_iter()
            .filter(|r| r[1] == poisson)
            .collect();
        for column in 2..5 {
            let (x, y): (Vec<f64>, Vec<f64>) = rows
                .iter()
                .step_by(2)
                .map(|row| (row[0].ln(), row[column].ln()))
                .unzip();
            let half = Spline::fit(&x, &y, 0.0);
            for row in rows.iter().skip(1).step_by(2) {
                let error = half.at(row[0].ln())[0].exp() / row[column] - 1.0;
                assert!(
                    error.abs() < 0.015,
                    "nu {poisson} column {column} {row:?} {error}"
                );
            }
        }
    }
}

#[test]
fn slender_ellipses_reach_kalker_s_limits() {
    use std::f64::consts::PI;
    for nu in [0.0, 0.3, 0.5] {
        let table = KalkerTable::new(nu);
        let c = table.at(1e-4);
        // The table's end at 0.1 lies up to 4 % above the limit it starts from.
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
