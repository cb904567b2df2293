//! Pressure that varies around the circumference.

use std::f64::consts::{PI, TAU};

use dashpot_testbench::plate::{Bosses, PressureArea, Profile, Resolution, RoundBosses};
use nalgebra::{Matrix4, Vector4};

use super::{RADII_M, stack};

const NU: f64 = 0.3;

/// Radial part of `w = f(r) cos(m t)` for the pressure `cos(m t)` on a disc of unit stiffness and unit free radius,
/// clamped at `clamp`, for m above 4: a sum of `r^m`, `r^-m`, `r^(m+2)`, `r^(2-m)` and the particular solution
/// `r^4/((16 - m^2)(4 - m^2))` (Timoshenko and Woinowsky-Krieger, Art. 63). Moment and Kirchhoff shear vanish at the
/// edge: `(f'' + f'/r - m^2 f/r^2)' - (1 - nu) m^2/r (f'/r - f/r^2) = 0`.
fn closed_form(m: f64, clamp: f64) -> impl Fn(f64) -> f64 {
    let powers = [m, -m, m + 2.0, 2.0 - m];
    // Derivatives of r^p at r.
    let derivative = |p: f64, order: i32, r: f64| {
        let factor: f64 = (0..order).map(|i| p - f64::from(i)).product();
        factor * r.powf(p - f64::from(order))
    };
    let rows = |p: f64| {
        let at = |order| derivative(p, order, 1.0);
        let moment = at(2) + NU * (at(1) - m * m * at(0));
        // (f'/r)' = f'' - f', (f/r^2)' = f' - 2 f at r = 1.
        let laplacian = at(3) + at(2) - at(1) - m * m * (at(1) - 2.0 * at(0));
        let shear = laplacian - (1.0 - NU) * m * m * (at(1) - at(0));
        [
            derivative(p, 0, clamp),
            derivative(p, 1, clamp),
            moment,
            shear,
        ]
    };
    let particular = 1.0 / ((16.0 - m * m) * (4.0 - m * m));
    let columns = powers.map(|p| Vector4::from(rows(p)));
    let forced = Vector4::from(rows(4.0)) * -particular;
    let c = Matrix4::from_columns(&columns).lu().solve(&forced).unwrap();
    move |r: f64| {
        let homogeneous: f64 = powers.iter().zip(&c).map(|(p, c)| c * r.powf(*p)).sum();
        homogeneous + particular * r.powi(4)
    }
}

/// Sectors that cover a share s of the circumference have the Fourier series
/// `s + sum 2 sin(k pi s)/(k pi) cos(k N t)`; each term has a closed form.
#[test]
fn sectors_over_the_whole_width_are_a_sum_of_closed_forms() {
    for (clamp, free) in RADII_M {
        let stack = stack(clamp, free, &[0.3e-3]);
        let scale = free.powi(4) / stack.bending_stiffness_n_m();
        let whole = PressureArea::whole(clamp, free);
        let uniform = stack.bend(&whole, Resolution::default()).unwrap();
        for (count, share) in [(5, 0.5), (6, 0.3), (9, 0.8)] {
            let resolution = Resolution {
                elements: 200,
                harmonics: 3,
            };
            let area = PressureArea::Sectors(Bosses {
                count,
                share,
                profile: Profile::full(clamp, free),
            });
            let bending = stack.bend(&area, resolution).unwrap();
            let terms: Vec<_> = (1..=3)
                .map(|k| {
                    let order = f64::from(k * count);
                    let turns = PI * f64::from(k);
                    let part = 2.0 * (turns * share).sin() / turns;
                    (order, part, closed_form(order, clamp / free))
                })
                .collect();
            for (r, angle) in [(free, 0.0), (free, 0.3), (0.5 * (clamp + free), 0.1)] {
                let sum: f64 = terms
                    .iter()
                    .map(|(order, part, form)| part * form(r / free) * (order * angle).cos())
                    .sum();
                let expected = share * uniform.deflection_m_per_pa(r, 0.0) + scale * sum;
                let found = bending.deflection_m_per_pa(r, angle);
                let error = found / expected - 1.0;
                assert!(error.abs() < 1e-6, "{count}, {share}, {r}: {error:e}");
            }
        }
    }
}

fn round() -> PressureArea {
    PressureArea::Round(RoundBosses {
        count: 6,
        pitch_radius_m: 23e-3,
        hole_radius_m: 3e-3,
        boss_radius_m: 5e-3,
        exponent: 2.0,
    })
}

fn sectors() -> PressureArea {
    PressureArea::Sectors(Bosses {
        count: 6,
        share: 0.4,
        profile: Profile {
            full_m: [20e-3, 25e-3],
            ends_m: [18e-3, 27e-3],
            exponent: 2.0,
        },
    })
}

/// The deflection averaged around the circumference is the deflection under the averaged pressure, computed here as a
/// sum over angles.
#[test]
fn the_mean_lift_follows_from_the_mean_pressure() {
    let (clamp, free) = RADII_M[0];
    let stack = stack(clamp, free, &[0.3e-3]);
    for area in [round(), sectors()] {
        let bending = stack.bend(&area, Resolution::default()).unwrap();
        let angles = (0..720).map(|i| TAU * (f64::from(i) + 0.5) / 720.0);
        let lifts = angles.map(|angle| bending.deflection_m_per_pa(free, angle));
        let mean = lifts.sum::<f64>() / 720.0;
        let ratio = mean / bending.mean_edge_lift_m_per_pa();
        assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
        let [min, max] = bending.edge_lift_range_m_per_pa();
        assert!(min < mean && mean < max);
        let over_boss = bending.deflection_m_per_pa(free, 0.0);
        assert!((over_boss / max - 1.0).abs() < 1e-9);
    }
}

#[test]
fn twice_the_resolution_changes_little() {
    let (clamp, free) = RADII_M[0];
    let stack = stack(clamp, free, &[0.3e-3]);
    let usual = Resolution::default();
    let twice = Resolution {
        elements: 2 * usual.elements,
        harmonics: 2 * usual.harmonics,
    };
    for area in [round(), sectors()] {
        let [coarse, fine] = [usual, twice].map(|resolution| {
            let bending = stack.bend(&area, resolution).unwrap();
            let stress = stack.largest_stress(&bending).von_mises_per_pressure;
            let [min, max] = bending.edge_lift_range_m_per_pa();
            [bending.mean_edge_lift_m_per_pa(), min, max, stress]
        });
        for (i, (coarse, fine)) in coarse.iter().zip(&fine).enumerate() {
            let change = coarse / fine - 1.0;
            println!("{i}: {change:e}");
            let within = if i == 3 { 1e-3 } else { 1e-6 };
            assert!(change.abs() < within, "{i}: {change:e}");
        }
    }
}

#[test]
fn pressure_on_round_bosses_integrates_to_their_area() {
    let (clamp, free) = RADII_M[0];
    // Circles of full pressure, and cones, which integrate to a third of the circle.
    for (hole, exponent, share) in [
        (5e-3, 1.0, 1.0),
        (0.0, 1.0, 1.0 / 3.0),
        (0.0, 2.0, 1.0 / 6.0),
    ] {
        let area = PressureArea::Round(RoundBosses {
            count: 6,
            pitch_radius_m: 23e-3,
            hole_radius_m: hole,
            boss_radius_m: 5e-3,
            exponent,
        });
        area.check(clamp, free).unwrap();
        // Numerical integral of `at` over a grid.
        let (rings, angles) = (800, 1500);
        let width = (free - clamp) / f64::from(rings);
        let mut force = 0.0;
        for i in 0..rings {
            let r = clamp + width * (f64::from(i) + 0.5);
            let at = (0..angles).map(|j| area.at(r, TAU * f64::from(j) / f64::from(angles)));
            force += at.sum::<f64>() / f64::from(angles) * TAU * r * width;
        }
        let expected = 6.0 * share * PI * 25e-6;
        assert!((force / expected - 1.0).abs() < 2e-3, "{hole}: {force}");
    }
}
