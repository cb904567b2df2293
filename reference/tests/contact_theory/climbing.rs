//! Y/Q of a wheel on its flange: compares the real-time law with the exact solver on the same patches.

use std::sync::OnceLock;

use dashpot_rail::contact::{Motion, RailDisplacement, WheelForces, WheelsetContact};
use dashpot_rail::creep::{
    CreepForces, CreepLaw, Creepage, KalkerBook, LoadedContact, Polach, ShenHedrickElkins,
};
use dashpot_reference::rolling_contact::RollingContact;

use crate::shifts::{friction, geometry, loaded};

/// The reference solver as a creep law, for a Poisson's ratio of 0.28.
struct Exact;

impl CreepLaw for Exact {
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let (a, b) = (contact.a_m, contact.b_m);
        let (limit, arm) = (contact.friction * contact.load_n, (a * b).sqrt());
        let scale = contact.shear_modulus_pa * a * b / limit;
        let scaled = [
            creepage.longitudinal * scale,
            creepage.lateral * scale,
            creepage.spin_per_m * arm * scale,
        ];
        let solver = RollingContact::new(a / b, 0.28).unwrap();
        let [longitudinal, lateral, moment] = solver.solve(scaled).unwrap();
        CreepForces {
            longitudinal_n: longitudinal * limit,
            lateral_n: lateral * limit,
            moment_n_m: moment * limit * arm,
        }
    }
}

pub const FRICTIONS: [f64; 3] = [0.1, 0.3, 0.5];
pub const YAWS_MRAD: [f64; 8] = [-5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0];
pub const LAWS: [&str; 4] = [
    "exact theory",
    "book of tables",
    "Polach",
    "Shen-Hedrick-Elkins",
];

/// Y/Q of the right wheel for each friction and yaw by each of [`LAWS`].
pub fn climbing() -> &'static [[[f64; 4]; YAWS_MRAD.len()]; FRICTIONS.len()] {
    static CLIMBING: OnceLock<[[[f64; 4]; YAWS_MRAD.len()]; FRICTIONS.len()]> = OnceLock::new();
    CLIMBING.get_or_init(|| {
        FRICTIONS.map(|coefficient| YAWS_MRAD.map(|yaw_mrad| quotients(coefficient, yaw_mrad)))
    })
}

fn quotients(coefficient: f64, yaw_mrad: f64) -> [f64; 4] {
    let friction = friction(coefficient);
    let book = WheelsetContact::new(geometry(), KalkerBook::new(), friction).unwrap();
    // The wheel is shifted until its flange carries it. All laws use the height found with the book, so they have the
    // same patches.
    let (motion, book_wheel) = (50..90)
        .map(|tenths| Motion {
            speed_m_per_s: 20.0,
            rotation_rad_per_s: 32.0,
            lateral_m: f64::from(tenths) * 1e-4,
            yaw_rad: yaw_mrad * 1e-3,
            ..Motion::default()
        })
        .map(|motion| loaded(&book, &motion))
        .find(|(_, wheel)| {
            let load: f64 = wheel.loaded_patches().map(|patch| patch.load_n).sum();
            wheel.patches[0].load_n > 0.95 * load
        })
        .expect("a shift at which the flange carries the wheel");
    fn of<L: CreepLaw>(law: L, motion: &Motion, coefficient: f64) -> f64 {
        let friction = crate::shifts::friction(coefficient);
        let contact = WheelsetContact::new(geometry(), law, friction).unwrap();
        // The left wheel is lifted to save time: only the right wheel is evaluated, and the exact law is slow.
        let lifted = RailDisplacement {
            vertical_m: 20e-3,
            ..RailDisplacement::default()
        };
        let rails = [lifted, RailDisplacement::default()];
        quotient(&contact.forces(motion, &rails).wheels[1])
    }
    [
        of(Exact, &motion, coefficient),
        quotient(&book_wheel),
        of(Polach, &motion, coefficient),
        of(ShenHedrickElkins, &motion, coefficient),
    ]
}

fn quotient(wheel: &WheelForces) -> f64 {
    wheel.force_n[1] / wheel.force_n[2]
}

#[test]
fn a_climbing_wheel_has_the_quotient_of_exact_theory() {
    for (friction, by_yaw) in FRICTIONS.iter().zip(climbing()) {
        for (yaw, [exact, book, ..]) in YAWS_MRAD.iter().zip(by_yaw) {
            assert!(*exact > 0.8, "not on the flange: {exact}");
            // The patches here are 11 to 23 times as long as they are wide.
            assert!(
                (book / exact - 1.0).abs() < 0.03,
                "mu {friction}, {yaw} mrad: {book} for {exact}"
            );
        }
    }
}
