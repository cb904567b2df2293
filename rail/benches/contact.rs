//! Time of the contact forces on a wheelset from tables, with tread and flange contact, for each creep law; and its
//! distribution when other work has swept the caches before each call.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact,
    WheelsetForces,
};
use dashpot_rail::creep::{CreepLaw, Fastsim, Friction, KalkerBook, Polach, ShenHedrickElkins};

/// Both rails moved inwards until tread and flange of both wheels carry load.
fn four_patches() -> (Motion, [RailDisplacement; 2]) {
    let motion = Motion {
        speed_m_per_s: 27.8,
        rotation_rad_per_s: 27.8 / 0.625,
        yaw_rad: 0.008,
        vertical_m: -0.75e-3,
        ..Motion::default()
    };
    let rail = |lateral_m| RailDisplacement {
        lateral_m,
        ..RailDisplacement::default()
    };
    (motion, [rail(6.68e-3), rail(-6.68e-3)])
}

/// A wheelset in a curve, with two patches on the outer wheel and one on the inner wheel.
fn curve() -> (Motion, [RailDisplacement; 2]) {
    let motion = Motion {
        speed_m_per_s: 27.8,
        rotation_rad_per_s: 27.8 / 0.625,
        yaw_rad: 0.008,
        lateral_m: 6.4e-3,
        vertical_m: -0.15e-3,
        roll_rad: -0.65e-3,
        ..Motion::default()
    };
    (motion, [RailDisplacement::default(); 2])
}

fn measure(
    criterion: &mut Criterion,
    law_name: &str,
    tables: &Arc<Tables>,
    law: impl CreepLaw,
    friction: Friction,
) {
    let contact =
        WheelsetContact::new(Arc::clone(tables), law, friction).expect("the friction is valid");
    let cases = [("four_patches", four_patches()), ("curve", curve())];
    for (case, (motion, rails)) in cases {
        let loaded: usize = contact
            .forces(&motion, &rails)
            .wheels
            .iter()
            .flat_map(|wheel| wheel.patches)
            .filter(|patch| patch.load_n > 1.0)
            .count();
        criterion.bench_function(&format!("{law_name}/{case} ({loaded} loaded)"), |bencher| {
            let mut forces = WheelsetForces::default();
            bencher.iter(|| {
                contact.update(black_box(&motion), black_box(&rails), &mut forces);
                black_box(&forces);
            });
        });
    }
}

/// Calls that are timed after other work, bytes that the other work touches before each, and bytes in a cache line.
const CALLS: usize = 20_000;
const OTHER_BYTES: usize = 4 << 20;
const LINE_BYTES: usize = 64;

/// Prints quantiles of the time of a call after other work has swept the caches. The wheelset moves between its flanges
/// with changing roll, yaw and load, so that calls read different nodes.
fn measure_after_other_work(tables: &Arc<Tables>) {
    let contact = WheelsetContact::new(Arc::clone(tables), KalkerBook::new(), Friction::default())
        .expect("the friction is valid");
    let mut other = vec![0_u8; OTHER_BYTES];
    let mut forces = WheelsetForces::default();
    let mut times_ns: Vec<u128> = (0..CALLS)
        .map(|call| {
            for line in other.iter_mut().step_by(LINE_BYTES) {
                *line = line.wrapping_add(1);
            }
            black_box(&mut other);
            let phase = call as f64;
            let motion = Motion {
                speed_m_per_s: 27.8,
                rotation_rad_per_s: 27.8 / 0.625,
                lateral_m: 6.4e-3 * (0.37 * phase).sin(),
                vertical_m: 20e-6 * (0.73 * phase).sin(),
                roll_rad: 0.5e-3 * (0.53 * phase).sin(),
                yaw_rad: 5e-3 * (0.19 * phase).sin(),
                ..Motion::default()
            };
            let started = Instant::now();
            contact.update(&motion, &[RailDisplacement::default(); 2], &mut forces);
            let elapsed = started.elapsed();
            black_box(&forces);
            elapsed.as_nanos()
        })
        .collect();
    times_ns.sort_unstable();
    let quantile = |part: f64| times_ns[(part * (CALLS - 1) as f64) as usize];
    println!(
        "kalker_book after {} MB of other work: median {} ns, 99th percentile {} ns",
        OTHER_BYTES >> 20,
        quantile(0.5),
        quantile(0.99)
    );
}

fn contact(criterion: &mut Criterion) {
    let pair = Pair::standard(Installation::default()).expect("the standard pair is valid");
    let geometry =
        ContactGeometry::new(pair, Steel::default()).expect("the default steel is valid");
    let tables = Arc::new(Tables::new(geometry));
    measure_after_other_work(&tables);
    let friction = Friction::default();
    let falling = friction.with_residual_ratio(0.4);
    measure(
        criterion,
        "kalker_book",
        &tables,
        KalkerBook::new(),
        friction,
    );
    measure(criterion, "polach", &tables, Polach, friction);
    measure(criterion, "polach_falling", &tables, Polach, falling);
    measure(criterion, "she", &tables, ShenHedrickElkins, friction);
    measure(criterion, "fastsim", &tables, Fastsim::default(), friction);
}

criterion_group!(benches, contact);
criterion_main!(benches);
