//! Chart of the correction factor Ce over the geometry of the pressure area. The source paper does not give this
//! geometry.

use plotters::prelude::SeriesLabelPosition;

use super::Solved;
use super::panel::panel;
use crate::commands::failure::Outcome;
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::sheet::Panel;
use dashpot_report::plot::style::RED_LINE;
use dashpot_testbench::plate::{
    Fit, PlateError, PressureArea, Profile, Resolution, Stack, WIDTHS, is_ring, middle_ring,
};

/// Number of points per curve.
const POINTS: u32 = 48;

/// Draws two panels for a valve: Ce over the geometry, and geometries with the valve's Ce.
pub(super) fn chart(solved: &Solved) -> Outcome<[Panel; 2]> {
    Ok(if is_ring(solved.location.valve) {
        [outer_decay(solved)?, both_decays(solved)?]
    } else {
        [sectors(solved)?, round_bosses(solved)]
    })
}

/// Returns a horizontal line at the valve's Ce.
fn target(solved: &Solved, [from, to]: [f64; 2]) -> Curve {
    let factor = solved.factor;
    let name = format!("Ce of the damper: {factor}");
    Curve::new(name, RED_LINE, [(from, factor), (to, factor)]).dashed()
}

fn factor_panel(solved: &Solved, x_label: &str, curves: Vec<Curve>) -> Panel {
    panel(solved, x_label, "correction factor Ce", curves)
}

fn factor(stack: &Stack, profile: Profile) -> Result<f64, PlateError> {
    stack.correction_factor(&PressureArea::Ring(profile), Resolution::default())
}

/// Returns curves of Ce, one per decay exponent.
///
/// `profile_at` takes a fraction of the width and an exponent, and returns an abscissa and a profile.
fn decays(solved: &Solved, profile_at: impl Fn(f64, f64) -> (f64, Profile)) -> Outcome<Vec<Curve>> {
    let exponents = [1.0, 2.0, 3.0];
    let mut curves = Vec::new();
    for (exponent, colour) in exponents.into_iter().zip(ramp(exponents.len())) {
        let points = (1..=POINTS).map(|i| {
            let (x, profile) = profile_at(f64::from(i) / f64::from(POINTS), exponent);
            Ok((x, factor(&solved.stack, profile)?))
        });
        let points: Vec<_> = points.collect::<Result<_, PlateError>>()?;
        curves.push(Curve::new(
            format!("decay with exponent {exponent}"),
            colour,
            points,
        ));
    }
    Ok(curves)
}

/// Draws Ce for a pressure that is full from the clamp to a radius and then decays to zero at the edge.
fn outer_decay(solved: &Solved) -> Outcome<Panel> {
    let (clamp, free) = (solved.stack.clamp_radius_m(), solved.stack.free_radius_m());
    let mut curves = decays(solved, |part, exponent| {
        let full = clamp + part * (free - clamp);
        let profile = Profile {
            full_m: [clamp, full],
            ends_m: [clamp, free],
            exponent,
        };
        (full * 1e3, profile)
    })?;
    curves.push(target(solved, [clamp, free].map(|m| m * 1e3)));
    Ok(factor_panel(solved, "full pressure up to, mm", curves))
}

/// Draws Ce for a pressure that is full in the middle and decays over equal widths to zero at the clamp and at the
/// edge.
fn both_decays(solved: &Solved) -> Outcome<Panel> {
    let (clamp, free) = (solved.stack.clamp_radius_m(), solved.stack.free_radius_m());
    let widest = 0.5 * (free - clamp);
    let mut curves = decays(solved, |part, exponent| {
        // A ring of zero width under full pressure is invalid.
        let width = (1.0 - part + 1e-3 * part) * widest * (1.0 - 1e-6);
        let profile = Profile {
            full_m: [clamp + width, free - width],
            ends_m: [clamp, free],
            exponent,
        };
        (width * 1e3, profile)
    })?;
    curves.push(target(solved, [0.0, widest * 1e3]));
    Ok(Panel {
        legend: Some(SeriesLabelPosition::UpperRight),
        ..factor_panel(solved, "width of the decay on both sides, mm", curves)
    })
}

/// Draws Ce for any number of sector bosses: their share of the circumference times the Ce of the ring.
fn sectors(solved: &Solved) -> Outcome<Panel> {
    let mut curves = Vec::new();
    for (part, colour) in WIDTHS.into_iter().zip(ramp(WIDTHS.len())) {
        let profile = middle_ring(&solved.stack, part);
        let [from, to] = profile.full_m;
        let ring = factor(&solved.stack, profile)?;
        let name = format!("full from {:.2} to {:.2} mm", from * 1e3, to * 1e3);
        curves.push(Curve::new(name, colour, [(0.0, 0.0), (1.0, ring)]));
    }
    curves.push(target(solved, [0.0, 1.0]));
    Ok(factor_panel(
        solved,
        "share of the circumference under bosses",
        curves,
    ))
}

/// Draws, for six round bosses, the boss radius that gives the valve's Ce.
fn round_bosses(solved: &Solved) -> Panel {
    let mut shares: Vec<f64> = Vec::new();
    let found = solved.fits.iter().filter_map(|fit| match *fit {
        Fit::RoundBosses {
            pitch_radius_m,
            hole_share,
            boss_radius_m,
        } => Some((hole_share, pitch_radius_m * 1e3, boss_radius_m * 1e3)),
        _ => None,
    });
    let found: Vec<_> = found.collect();
    for (share, ..) in &found {
        if !shares.contains(share) {
            shares.push(*share);
        }
    }
    let curves = shares
        .iter()
        .zip(ramp(shares.len()))
        .map(|(share, colour)| {
            let of_share = found.iter().filter(|(other, ..)| other == share);
            let points: Vec<_> = of_share.map(|(_, pitch, boss)| (*pitch, *boss)).collect();
            let name = format!("hole radius {share} of boss radius: Ce {}", solved.factor);
            Curve::new(name, colour, points)
        });
    Panel {
        legend: Some(SeriesLabelPosition::LowerLeft),
        ..panel(
            solved,
            "radius of the circle of six round bosses, mm",
            "boss radius, mm",
            curves.collect(),
        )
    }
}
