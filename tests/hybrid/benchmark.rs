//! The published benchmark: four cases, the nominal and twenty perturbed plants, two motions of the ground.

use std::fmt::Write;

use dashpot::document;
use dashpot_hybrid::Noise;
use dashpot_hybrid::benchmark::{
    CASES, Control, Criteria, Plant, RunError, Sensors, chirp, earthquake, run,
};

use crate::DOCUMENT;

const PERTURBED: usize = 20;

/// The nominal plant and the perturbed ones.
fn plants() -> Vec<Plant> {
    let mut noise = Noise::new(2020);
    std::iter::once(Plant::NOMINAL)
        .chain((0..PERTURBED).map(|_| Plant::perturbed(&mut noise)))
        .collect()
}

/// Criteria of every plant, the nominal one first.
fn criteria(
    case: usize,
    ground: &[f64],
    control: Control,
    sensors: Sensors,
) -> Vec<Result<Criteria, RunError>> {
    let of_plant = |(seed, plant)| run(case, &plant, ground, control, sensors, seed);
    (1..).zip(plants()).map(of_plant).collect()
}

fn worst(runs: &[Criteria], number: fn(&Criteria) -> f64) -> f64 {
    runs.iter().map(number).fold(0.0, f64::max)
}

#[test]
fn every_run_is_stable_and_within_the_criteria() {
    let mut table = String::from(
        "| ground | case | J1, ms | J2, % | J4, % | worst J1 | worst J2 | worst J4 | with noise: J2 | reached |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for (name, ground) in [("earthquake", earthquake(1)), ("chirp", chirp())] {
        for case in 1..=CASES {
            let all = |sensors| -> Vec<Criteria> {
                let runs = criteria(case, &ground, Control::Adaptive, sensors);
                runs.into_iter()
                    .map(|run| run.unwrap_or_else(|error| panic!("{name}, case {case}: {error}")))
                    .collect()
            };
            let (quantised, noisy) = (all(Sensors::Quantised), all(Sensors::Noisy));
            let nominal = quantised[0];
            assert!(worst(&quantised, |run| run.j1_ms) <= 0.25, "{name} {case}");
            assert!(
                worst(&quantised, |run| run.j2_percent) <= 2.0,
                "{name} {case}"
            );
            assert!(
                worst(&noisy, |run| run.reached_percent) <= 2.0,
                "{name} {case}"
            );
            if case == 1 {
                assert!(
                    nominal.j2_percent <= 1.0 && nominal.j4_percent <= 2.5,
                    "{nominal:?}"
                );
            }
            writeln!(
                table,
                "| {name} | {case} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.1} | {:.2} |",
                nominal.j1_ms,
                nominal.j2_percent,
                nominal.j4_percent,
                worst(&quantised, |run| run.j1_ms),
                worst(&quantised, |run| run.j2_percent),
                worst(&quantised, |run| run.j4_percent),
                worst(&noisy, |run| run.j2_percent),
                worst(&noisy, |run| run.reached_percent),
            )
            .unwrap();
        }
    }
    document::compare_part(DOCUMENT, "benchmark", &table);
}

/// Without compensation the published plant makes the frame unstable.
#[test]
fn without_compensation_the_frame_is_unstable() {
    let ground = earthquake(1);
    for case in 1..=CASES {
        let run = run(
            case,
            &Plant::NOMINAL,
            &ground,
            Control::None,
            Sensors::Perfect,
            1,
        );
        assert!(
            matches!(run, Err(RunError::Unstable { .. })),
            "case {case}: {run:?}"
        );
    }
}

/// Records and plants that nobody chose: other earthquakes, and plants twice as far from the nominal one.
#[test]
fn other_records_and_plants_are_within_the_criteria() {
    let mut noise = Noise::new(77);
    for seed in 100..106 {
        let ground = earthquake(seed);
        let far = |nominal: f64, perturbed: f64| nominal + 2.0 * (perturbed - nominal);
        let (nominal, drawn) = (Plant::NOMINAL, Plant::perturbed(&mut noise));
        let plant = Plant {
            beta1_per_s: far(nominal.beta1_per_s, drawn.beta1_per_s),
            beta2_per_s2: far(nominal.beta2_per_s2, drawn.beta2_per_s2),
            a3_per_s: far(nominal.a3_per_s, drawn.a3_per_s),
            stiffness_n_per_m: far(nominal.stiffness_n_per_m, drawn.stiffness_n_per_m),
        };
        for case in 1..=CASES {
            let run = run(
                case,
                &plant,
                &ground,
                Control::Adaptive,
                Sensors::Quantised,
                seed,
            );
            let run = run.unwrap_or_else(|error| panic!("{plant:?}, case {case}: {error}"));
            assert!(
                run.j1_ms <= 0.25 && run.j2_percent <= 2.0,
                "{plant:?}, case {case}: {run:?}"
            );
        }
    }
}
