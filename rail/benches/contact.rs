//! Time of the contact forces on a wheelset: tables, tread and flange of both wheels, each law.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use dashpot_rail::contact::hertz::Steel;
use dashpot_rail::contact::motion::{Motion, Rail};
use dashpot_rail::contact::pair::{Installation, Pair};
use dashpot_rail::contact::table::{Grid, Tables};
use dashpot_rail::contact::wheelset::WheelsetContact;
use dashpot_rail::creep::creepage::CreepLaw;
use dashpot_rail::creep::fastsim::Fastsim;
use dashpot_rail::creep::friction::Friction;
use dashpot_rail::creep::polach::Polach;
use dashpot_rail::creep::shen_hedrick_elkins::ShenHedrickElkins;

/// Both rails pressed inward until tread and flange of both wheels are loaded.
fn four_patches() -> (Motion, [Rail; 2]) {
    let motion = Motion {
        speed: 27.8,
        rotation: 27.8 / 0.625,
        yaw: 0.008,
        vertical: -0.75e-3,
        ..Motion::default()
    };
    let rail = |lateral| Rail {
        lateral,
        ..Rail::default()
    };
    (motion, [rail(6.68e-3), rail(-6.68e-3)])
}

/// A wheelset in a curve: two patches on the outer wheel, one on the inner.
fn curve() -> (Motion, [Rail; 2]) {
    let motion = Motion {
        speed: 27.8,
        rotation: 27.8 / 0.625,
        yaw: 0.008,
        lateral: 6.4e-3,
        vertical: -0.15e-3,
        roll: -0.65e-3,
        ..Motion::default()
    };
    (motion, [Rail::default(); 2])
}

fn measure(
    criterion: &mut Criterion,
    law_name: &str,
    tables: &Tables,
    law: impl CreepLaw,
    friction: Friction,
) {
    let contact = WheelsetContact::new(tables.clone(), law, friction);
    let cases = [("four_patches", four_patches()), ("curve", curve())];
    for (case, (motion, rails)) in cases {
        let loaded: usize = contact
            .forces(&motion, &rails)
            .wheels
            .iter()
            .flat_map(|wheel| wheel.patches)
            .filter(|patch| patch.load > 1.0)
            .count();
        criterion.bench_function(&format!("{law_name}/{case} ({loaded} loaded)"), |bencher| {
            bencher.iter(|| {
                let forces = contact.forces(black_box(&motion), black_box(&rails));
                // By reference: returning them would time a copy of 700 bytes.
                black_box(&forces);
            });
        });
    }
}

fn contact(criterion: &mut Criterion) {
    let pair = match Pair::standard(Installation::default()) {
        Ok(pair) => pair,
        Err(failure) => panic!("{failure}"),
    };
    let tables = Tables::new(pair, Steel::default(), Grid::default());
    let friction = Friction::default();
    let falling = Friction {
        rest: 0.4,
        ..friction
    };
    measure(criterion, "polach", &tables, Polach, friction);
    measure(criterion, "polach_falling", &tables, Polach, falling);
    measure(criterion, "she", &tables, ShenHedrickElkins, friction);
    measure(criterion, "fastsim", &tables, Fastsim::default(), friction);
}

criterion_group!(benches, contact);
criterion_main!(benches);
