//! Fleets of recordings with known wear: the forces are those of the step with noise, the order and the dates are
//! known.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use chrono::{Days, NaiveDate};
use dashpot_core::Damper;
use dashpot_core::health::HealthSettings;
use dashpot_files::damper;
use dashpot_recording::Channels;
use dashpot_testbench::health::Noise;
use dashpot_testbench::trend::fleet::Urgency;
use dashpot_testbench::trend::forecast::Forecast;
use dashpot_testbench::trend::limits::Limits;
use dashpot_testbench::trend::reading::{Estimation, Refusal};
use dashpot_testbench::trend::recordings::list;
use dashpot_testbench::trend::series::{estimate, series};
use dashpot_testbench::trend::{Axis, Fleet, Parameter, Summary};
use fastrand::Rng;

const STEP_S: f64 = 1e-3;
const TICKS: usize = 15_000;
const START: &str = "2026-01-05";

/// Displacements (m) of a random ride, 0.4 to 20 Hz, about 0.04 m/s rms.
fn ride(seed: u64) -> Vec<f64> {
    let mut rng = Rng::with_seed(seed);
    let lines: Vec<(f64, f64, f64)> = (0..60)
        .map(|line| {
            let frequency = 0.4 + 0.33 * (f64::from(line) + rng.f64());
            (
                0.7e-3 / (1.0 + frequency / 2.0),
                TAU * frequency,
                TAU * rng.f64(),
            )
        })
        .collect();
    let at = |time_s: f64| -> f64 {
        lines
            .iter()
            .map(|(a, w, phase)| a * (w * time_s + phase).sin())
            .sum()
    };
    (0..TICKS)
        .map(|tick| at(tick as f64 * STEP_S) - at(0.0))
        .collect()
}

/// Text of a recording of a damper with these overrides of `reduced-vertical`.
fn recording(overrides: &[String], seed: u64) -> String {
    let built: Damper<f64> = damper::load("reduced-vertical", overrides)
        .unwrap()
        .build(STEP_S)
        .unwrap();
    let displacements_m = ride(seed);
    let mut state = built.at_rest(0.0);
    let forces_n: Vec<f64> = displacements_m
        .iter()
        .map(|x| built.step(&mut state, *x))
        .collect();
    let noise = Noise::from_rms(0.01, &displacements_m, &forces_n);
    let (displacements_m, forces_n) = noise.add_to(&displacements_m, &forces_n, seed);
    let mut text = "time_s,displacement_m,force_n\n".to_owned();
    for (tick, (x, force)) in displacements_m.iter().zip(forces_n).enumerate() {
        text += &format!("{:.3},{x:.7},{force:.2}\n", tick as f64 * STEP_S);
    }
    text
}

/// Writes recordings a month apart of a damper whose overrides depend on the months since the first.
fn write(folder: &Path, damper: &str, months: u64, overrides: impl Fn(f64) -> Vec<String>) {
    let folder = folder.join("401").join(damper);
    fs::create_dir_all(&folder).unwrap();
    let start: NaiveDate = START.parse().unwrap();
    for month in 0..months {
        let date = start.checked_add_days(Days::new(30 * month)).unwrap();
        let seed = 100 * damper.len() as u64 + month;
        let text = recording(&overrides(month as f64), seed);
        fs::write(folder.join(format!("{date}.csv")), text).unwrap();
    }
}

fn estimation() -> Estimation {
    Estimation {
        damper: "reduced-vertical".into(),
        parameters: damper::load("reduced-vertical", &[]).unwrap(),
        channels: Channels::default(),
        step_s: STEP_S,
        settings: HealthSettings::new(1e-5, 1.0),
        estimates_displacement_noise: true,
        estimates_force_noise: true,
        accepts_several_changed: false,
    }
}

fn assess(folder: &Path, estimation: &Estimation, limits: &Limits) -> Fleet {
    let (placed, unplaced) = series(list(folder).unwrap(), Axis::Date);
    let mut done = 0;
    let recorded = estimate(&placed, estimation, 2, |recordings| done += recordings);
    assert_eq!(
        done,
        placed
            .iter()
            .map(|series| series.recordings.len() as u64)
            .sum::<u64>()
    );
    let fleet = Fleet::assess(Axis::Date, &placed, recorded, unplaced, limits);
    println!("{}", Summary::new(&fleet).text());
    fleet
}

fn clearance(clearance_m: f64) -> Vec<String> {
    vec![format!("mount.clearance_m={clearance_m}")]
}

fn flow(factor: f64) -> Vec<String> {
    let nominal = damper::load("reduced-vertical", &[]).unwrap();
    let dashpot_core::parameters::Element::Reduced(reduced) = &nominal.element else {
        panic!("{nominal:?}");
    };
    vec![
        format!(
            "reduced.damping_n_s_per_m={}",
            reduced.damping_n_s_per_m / factor
        ),
        format!(
            "reduced.saturation_velocity_m_per_s={}",
            reduced.saturation_velocity_m_per_s * factor
        ),
    ]
}

/// Days from the first recording to the date at which a trend reaches its limit.
fn days(x: f64) -> f64 {
    use chrono::Datelike;
    x - f64::from(START.parse::<NaiveDate>().unwrap().num_days_from_ce())
}

#[test]
fn the_worn_damper_is_first_and_its_date_is_within_the_interval() {
    let folder = tempfile::tempdir().unwrap();
    let nominal = damper::load("reduced-vertical", &[])
        .unwrap()
        .mount
        .clearance_m;
    // 0.13 mm, and 0.5 % of the damping, a month.
    write(folder.path(), "loose", 9, |month| {
        clearance(nominal + 0.13e-3 * month)
    });
    write(folder.path(), "thin-oil", 9, |month| {
        flow(1.0 / (1.0 - 0.005 * month))
    });
    // Not the nominal damper, but it does not change.
    write(folder.path(), "as-new", 9, |_| {
        [clearance(nominal + 0.3e-3), flow(0.95)].concat()
    });
    fs::write(
        folder.path().join("401/as-new/2026-11-01.csv"),
        "no recording\n",
    )
    .unwrap();
    let fleet = assess(folder.path(), &estimation(), &Limits::default());
    let order: Vec<&str> = fleet
        .dampers
        .iter()
        .map(|damper| damper.name()[1])
        .collect();
    assert_eq!(order, ["loose", "thin-oil", "as-new"]);

    for (damper, parameter, truth_days) in [
        (0, Parameter::Clearance, 30.0 * (2.9e-3 - nominal) / 0.13e-3),
        (
            1,
            Parameter::DampingFactor,
            30.0 * (1.0 - 1.0 / 1.15) / 0.005,
        ),
    ] {
        let damper = &fleet.dampers[damper];
        let trend = damper.worst(Axis::Date);
        assert_eq!(trend.parameter, parameter);
        assert_eq!(trend.points.len(), 9);
        let Some(Forecast::Reached {
            at,
            earliest,
            latest,
        }) = trend.forecast
        else {
            panic!("{:?}", trend.forecast);
        };
        let [at, earliest, latest] = [at, earliest, latest].map(days);
        println!(
            "{}: {at:.0} days ({earliest:.0} to {latest:.0}), truth {truth_days:.0}",
            damper.name()[1]
        );
        assert!(
            (earliest..=latest).contains(&truth_days),
            "{earliest} to {latest}, truth {truth_days}"
        );
        assert!(
            latest - earliest < 0.3 * truth_days,
            "{earliest} to {latest}"
        );
    }
    let healthy = &fleet.dampers[2];
    assert!(
        matches!(healthy.urgency(Axis::Date), Urgency::NotInSight(_)),
        "{:?}",
        healthy.urgency(Axis::Date)
    );

    // The file without numbers stops nothing and is listed with its reason.
    let refused: Vec<_> = fleet.refused().collect();
    assert_eq!((refused.len(), fleet.unreadable()), (1, 1));
    assert!(refused[0].0.listed.file.ends_with("2026-11-01.csv"));
    assert!(
        matches!(refused[0].1, Refusal::Unreadable(reason) if reason.contains("2026-11-01.csv"))
    );

    let rows = fleet.trend_rows();
    assert_eq!(rows.len(), 9);
    assert_eq!(
        (rows[2].parameter, rows[2].verdict, rows[2].rank),
        ("clearance_m", "reached", 1)
    );
    let rate = rows[2].rate.unwrap();
    assert!(
        (rate - 0.13e-3 * 365.25 / 30.0).abs() < 0.1 * rate,
        "{rate}"
    );
    assert_eq!(fleet.reading_rows().len(), 28);

    // Another limit is another order.
    let limits = Limits {
        clearance_m: Some(1.5e-3),
        ..Limits::default()
    };
    let fleet = assess(folder.path(), &estimation(), &limits);
    assert!(matches!(
        fleet.dampers[0].urgency(Axis::Date),
        Urgency::Beyond(_)
    ));
    assert!(
        fleet.dampers[0]
            .worst(Axis::Date)
            .when_in_words(Axis::Date)
            .starts_with("beyond the limit since 2026-")
    );
}

#[test]
fn readings_in_doubt_put_a_damper_before_healthy_ones() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "as-new", 4, |_| Vec::new());
    // Flow, stiffness and clearance change together.
    write(folder.path(), "several", 6, |month| {
        let worn = if month < 3.0 { 0.0 } else { 1.0 };
        [clearance(0.5e-3 + 1e-3 * worn), flow(1.0 + 0.3 * worn)].concat()
    });
    let fleet = assess(folder.path(), &estimation(), &Limits::default());
    let first = &fleet.dampers[0];
    assert_eq!(first.name()[1], "several");
    assert_eq!(
        (first.urgency(Axis::Date), first.doubtful_at_the_end),
        (Urgency::InDoubt, 3)
    );
    assert_eq!(
        first.notes(Axis::Date),
        ["the last 3 readings are in doubt and not used"]
    );
    assert_eq!(fleet.refused().count(), 3);
    let accepting = Estimation {
        accepts_several_changed: true,
        ..estimation()
    };
    let fleet = assess(folder.path(), &accepting, &Limits::default());
    assert_eq!(fleet.refused().count(), 0, "{:?}", fleet.refused().next());
    assert!(matches!(
        fleet.dampers[0].urgency(Axis::Date),
        Urgency::Beyond(_)
    ));
}

#[test]
fn an_exchange_without_a_serial_number_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "exchanged", 8, |month| {
        clearance(if month < 5.0 {
            0.5e-3 + 0.4e-3 * month
        } else {
            0.5e-3
        })
    });
    let fleet = assess(folder.path(), &estimation(), &Limits::default());
    let notes = fleet.dampers[0].notes(Axis::Date);
    assert_eq!(notes.len(), 1, "{notes:?}");
    // 150 days after the start.
    assert!(
        notes[0].starts_with("from 2026-06-04 on it looks like another damper"),
        "{notes:?}"
    );
}
