//! Compares the contact of one wheel under 100 kN, at a range of lateral shifts, with an independent half-space solver:
//! position, angle and forces.

use std::sync::{Arc, OnceLock};

use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, PatchSource, RailDisplacement, Steel, WheelForces,
    WheelsetContact,
};
use dashpot_rail::creep::{CreepLaw, Friction, KalkerBook};

const EXACT: &str = include_str!("../../../rail/data/contact_exact_100kn.csv");

pub const LOAD_N: f64 = 100e3;

/// The right wheel at one lateral shift of the wheelset, from exact theory and from this project.
#[derive(Clone, Copy)]
pub struct Shift {
    pub lateral_mm: f64,
    pub exact: Wheel,
    pub found: Wheel,
}

/// Contact of one wheel; the forces act on the rail.
#[derive(Clone, Copy)]
pub struct Wheel {
    pub place_mm: f64,
    pub angle_rad: f64,
    pub longitudinal_n: f64,
    pub lateral_n: f64,
}

/// Wheel and rail for which the exact data were computed.
pub fn geometry() -> Arc<ContactGeometry> {
    static GEOMETRY: OnceLock<Arc<ContactGeometry>> = OnceLock::new();
    let geometry = GEOMETRY.get_or_init(|| {
        let pair = Pair::standard(Installation::default()).unwrap();
        let steel = Steel::default()
            .with_young_modulus_pa(2.0 * 82e9 * 1.28)
            .with_poisson_ratio(0.28);
        Arc::new(ContactGeometry::new(pair, steel).unwrap())
    });
    Arc::clone(geometry)
}

pub fn friction(static_coefficient: f64) -> Friction {
    Friction::constant(static_coefficient)
}

/// The right wheel in `motion`, at the height where it carries [`LOAD_N`], by bisection.
pub fn loaded<L: CreepLaw, S: PatchSource>(
    contact: &WheelsetContact<L, S>,
    motion: &Motion,
) -> (Motion, WheelForces) {
    let (mut high, mut low) = (-40e-3, 1e-3);
    let mut motion = *motion;
    let mut forces = WheelForces::default();
    for _ in 0..50 {
        motion.vertical_m = 0.5 * (high + low);
        forces = contact
            .forces(&motion, &[RailDisplacement::default(); 2])
            .wheels[1];
        if -forces.force_n[2] < LOAD_N {
            high = motion.vertical_m;
        } else {
            low = motion.vertical_m;
        }
    }
    (motion, forces)
}

/// All shifts of the data.
pub fn shifts() -> &'static [Shift] {
    static SHIFTS: OnceLock<Vec<Shift>> = OnceLock::new();
    SHIFTS.get_or_init(|| {
        let contact = WheelsetContact::new(geometry(), KalkerBook::new(), friction(0.3)).unwrap();
        let rows = EXACT.lines().filter(|line| line.contains("RIGHT"));
        rows.map(|row| {
            let cells: Vec<&str> = row.split(',').collect();
            let number = |column: usize| cells[column].parse::<f64>().unwrap();
            Shift {
                lateral_mm: number(2),
                exact: Wheel {
                    place_mm: number(13),
                    angle_rad: -number(15),
                    longitudinal_n: number(8),
                    lateral_n: number(9),
                },
                found: wheel(&contact, number(2)),
            }
        })
        .collect()
    })
}

fn wheel<S: PatchSource>(contact: &WheelsetContact<KalkerBook, S>, lateral_mm: f64) -> Wheel {
    let motion = Motion {
        speed_m_per_s: 20.0,
        rotation_rad_per_s: 32.0,
        lateral_m: lateral_mm * 1e-3,
        ..Motion::default()
    };
    let (motion, forces) = loaded(contact, &motion);
    // The position and angle of several patches are means, weighted by load.
    let load: f64 = forces.loaded_patches().map(|patch| patch.load_n).sum();
    let mean = |value: &dyn Fn(&dashpot_rail::contact::PatchForces) -> f64| {
        let patches = forces.loaded_patches();
        patches
            .map(|patch| patch.load_n * value(patch))
            .sum::<f64>()
            / load
    };
    Wheel {
        place_mm: 1e3 * (motion.lateral_m + mean(&|patch| patch.position_m[1])),
        angle_rad: mean(&|patch| patch.contact_angle_rad()),
        longitudinal_n: -forces.force_n[0],
        lateral_n: -forces.force_n[1],
    }
}

/// Steering force for each shift, exact and computed (N): longitudinal force of the left wheel minus that of the right.
///
/// Both come from the right wheel: shifted the other way, it replaces the left wheel.
pub fn steering() -> Vec<(f64, [f64; 2])> {
    let shifts = shifts();
    let at = |lateral_mm: f64| {
        shifts
            .iter()
            .find(|shift| (shift.lateral_mm - lateral_mm).abs() < 1e-9)
    };
    let to_right = shifts.iter().filter(|shift| shift.lateral_mm > 0.0);
    to_right
        .filter_map(|right| {
            let left = at(-right.lateral_mm)?;
            let difference = |wheel: fn(&Shift) -> Wheel| {
                wheel(left).longitudinal_n - wheel(right).longitudinal_n
            };
            let both = [
                difference(|shift| shift.exact),
                difference(|shift| shift.found),
            ];
            Some((right.lateral_mm, both))
        })
        .collect()
}

/// RMS deviation of the contact's position from exact theory, for shifts from 0.5 to 6 mm (mm).
pub fn position_error_mm() -> f64 {
    let within = shifts()
        .iter()
        .filter(|shift| (0.5..=6.0).contains(&shift.lateral_mm));
    let squares: Vec<f64> = within
        .map(|shift| (shift.found.place_mm - shift.exact.place_mm).powi(2))
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn the_contact_position_agrees_with_exact_theory() {
    assert!(position_error_mm() < 0.2, "{} mm", position_error_mm());
}

#[test]
fn the_steering_force_agrees_with_exact_theory() {
    let steering = steering();
    assert!(steering.len() >= 11);
    for (lateral_mm, [exact, found]) in steering {
        assert!(
            (found / exact - 1.0).abs() < 0.1,
            "{lateral_mm} mm: {found} N for {exact} N"
        );
    }
}

#[test]
fn the_flange_root_force_agrees_with_exact_theory() {
    let mut seen = 0;
    for shift in shifts() {
        if !(5.0..=6.0).contains(&shift.lateral_mm) {
            continue;
        }
        seen += 1;
        let (exact, found) = (shift.exact.lateral_n, shift.found.lateral_n);
        assert!(
            (found / exact - 1.0).abs() < 0.1,
            "{} mm: {found} N for {exact} N",
            shift.lateral_mm
        );
    }
    assert_eq!(seen, 5);
}
