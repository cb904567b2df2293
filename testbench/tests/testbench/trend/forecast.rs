//! Forecasts: the inverted band against the band itself, every verdict, and the coverage of the interval.

use std::f64::consts::TAU;

use dashpot_testbench::trend::fit::{Line, Point};
use dashpot_testbench::trend::forecast::{Forecast, Limit};
use fastrand::Rng;

const UPPER: Limit = Limit {
    value: 2.9,
    is_upper: true,
};

/// Readings a month apart of a parameter that starts at `start` and changes by `rate` a month.
fn readings(rng: &mut Rng, count: usize, start: f64, rate: f64, scatter: f64) -> Vec<Point> {
    let mut normal = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (TAU * rng.f64()).cos();
    (0..count)
        .map(|month| {
            // Some recordings say less than others.
            let sd = [0.02, 0.05, 0.03][month % 3];
            let x = 30.0 * month as f64;
            let truth = start + rate * month as f64;
            Point {
                x,
                y: truth + sd * normal() + scatter * normal(),
                sd,
            }
        })
        .collect()
}

fn forecast(points: &[Point], limit: Limit) -> (Line, Forecast) {
    let line = Line::fit(points).unwrap();
    let last = points.last().unwrap().x;
    (line, Forecast::new(&line, limit, last))
}

#[test]
fn the_interval_ends_where_the_band_reaches_the_limit() {
    for seed in 0..50 {
        let mut rng = Rng::with_seed(seed);
        let points = readings(&mut rng, 9, 0.5, 0.1, 0.02);
        let (line, found) = forecast(&points, UPPER);
        let Forecast::Reached {
            at,
            earliest,
            latest,
        } = found
        else {
            panic!("{found:?}");
        };
        assert!((line.at(at).value - 2.9).abs() < 1e-9);
        assert!((line.at(earliest).high - 2.9).abs() < 1e-9, "{line:?}");
        assert!((line.at(latest).low - 2.9).abs() < 1e-9);
        // Falling towards a lower limit is the same, upside down.
        let mirrored: Vec<Point> = points
            .iter()
            .map(|point| Point {
                y: -point.y,
                ..*point
            })
            .collect();
        let lower = Limit {
            value: -2.9,
            is_upper: false,
        };
        let (_, below) = forecast(&mirrored, lower);
        assert_eq!(below, found);
    }
}

/// The true date is within the interval in at least 90 of 100 fleets, whatever scatters.
#[test]
fn the_interval_contains_the_true_date() {
    const SEEDS: u64 = 2000;
    for (count, scatter, rate) in [
        (6, 0.0, 0.1),
        (12, 0.05, 0.1),
        (12, 0.2, 0.1),
        (24, 0.1, 0.03),
        (5, 0.3, 0.05),
    ] {
        let truth = 30.0 * (2.9 - 0.5) / rate;
        let (mut covered, mut bounded) = (0, 0);
        for seed in 0..SEEDS {
            let mut rng = Rng::with_seed(seed);
            let points = readings(&mut rng, count, 0.5, rate, scatter);
            let last = points.last().unwrap().x;
            let is_within = match forecast(&points, UPPER).1 {
                Forecast::Reached {
                    earliest, latest, ..
                } => {
                    bounded += 1;
                    (earliest..=latest).contains(&truth)
                }
                // The interval has no end, so that the truth is in it from its start on.
                Forecast::NotInSight { earliest } => {
                    earliest.is_some_and(|earliest| earliest <= truth)
                }
                Forecast::Beyond { is_sure, .. } => !is_sure || truth <= last,
            };
            covered += u64::from(is_within);
        }
        let share = covered as f64 / SEEDS as f64;
        println!(
            "{count} readings, scatter {scatter}, rate {rate}: {share:.3}, {bounded} of {SEEDS} bounded"
        );
        assert!(
            (0.93..=1.0).contains(&share),
            "{count} readings, scatter {scatter}: {share}"
        );
    }
}

/// Of dampers that do not wear, about one in twenty seems to change, in either direction; a few more, because the
/// scatter is estimated from the same ten readings.
#[test]
fn a_healthy_damper_rarely_seems_to_wear() {
    const SEEDS: u64 = 2000;
    let mut changed = 0;
    for seed in 0..SEEDS {
        let mut rng = Rng::with_seed(seed);
        let points = readings(&mut rng, 10, 0.5, 0.0, 0.05);
        changed += u64::from(Line::fit(&points).unwrap().has_changed());
    }
    let share = changed as f64 / SEEDS as f64;
    println!("seems to change: {share:.3}");
    assert!(share < 0.09, "{share}");
}

fn exact(values: &[f64]) -> Vec<Point> {
    let points = values.iter().enumerate();
    points
        .map(|(x, y)| Point {
            x: x as f64,
            y: *y,
            sd: 0.05,
        })
        .collect()
}

#[test]
fn every_verdict_is_found() {
    let verdict = |values: &[f64]| forecast(&exact(values), UPPER).1;
    let Forecast::Beyond {
        since: Some(since),
        is_sure: true,
    } = verdict(&[1.0, 2.0, 3.0, 4.0, 5.0])
    else {
        panic!("{:?}", verdict(&[1.0, 2.0, 3.0, 4.0, 5.0]));
    };
    assert!((since - 1.9).abs() < 1e-12);
    // Beyond at all times, without a change.
    let constant = verdict(&[3.5, 3.5, 3.5, 3.5]);
    assert_eq!(
        constant,
        Forecast::Beyond {
            since: None,
            is_sure: true
        }
    );
    // Just beyond.
    assert!(matches!(
        verdict(&[2.6, 2.7, 2.8, 2.905]),
        Forecast::Beyond { is_sure: false, .. }
    ));
    assert!(matches!(
        verdict(&[0.5, 0.9, 1.3, 1.7]),
        Forecast::Reached { .. }
    ));
    // Away from the limit: never.
    let away = verdict(&[1.7, 1.3, 0.9, 0.5]);
    assert_eq!(away, Forecast::NotInSight { earliest: None });
    // Constant: the band widens until it reaches the limit.
    let Forecast::NotInSight {
        earliest: Some(earliest),
    } = verdict(&[1.0, 1.0, 1.0, 1.0])
    else {
        panic!("{:?}", verdict(&[1.0, 1.0, 1.0, 1.0]));
    };
    let line = Line::fit(&exact(&[1.0, 1.0, 1.0, 1.0])).unwrap();
    assert!(earliest > 3.0 && (line.at(earliest).high - 2.9).abs() < 1e-9);
    // So uncertain that the limit may be reached at any time.
    let uncertain = verdict(&[1.0, 5.0, 0.0, 3.0, 1.0]);
    assert_eq!(
        uncertain,
        Forecast::NotInSight {
            earliest: Some(4.0)
        }
    );
}
