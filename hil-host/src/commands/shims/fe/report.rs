//! Report of `dashpot shims --fe`.

use std::io::{self, Write};

use serde::Serialize;

use super::{PlateArguments, Solved};
use crate::commands::failure::Outcome;
use dashpot_testbench::plate::{Fit, LargestStress, PressureArea, Profile, Stacking};

/// Largest ratio of lift to thickness at which plate theory is reported as valid: it then overstates the lift by 3 %.
const SMALL_LIFT: f64 = 0.5;

/// Edge lift per pressure around the circumference (m/Pa).
#[derive(Serialize)]
struct EdgeLift {
    mean_m_per_pa: f64,
    least_m_per_pa: f64,
    greatest_m_per_pa: f64,
}

#[derive(Serialize)]
struct PlateRow {
    pressure_pa: f64,
    at_force_limit: bool,
    mean_lift_m: f64,
    greatest_lift_m: f64,
    largest_stress_pa: f64,
    /// Maximum lift divided by the thickness; plate theory needs it to be small.
    lift_over_thickness: f64,
    plate_theory_holds: bool,
}

#[derive(Serialize)]
struct PlateValve {
    valve: &'static str,
    stacking: Stacking,
    equivalent_thickness_m: f64,
    /// Pressure area; `None` if no area of the assumed kind has the valve's Ce.
    pressure_area: Option<PressureArea>,
    pressure_area_is_given: bool,
    damper_correction_factor: f64,
    /// Ratio of mean edge lift to the lift under uniform pressure.
    correction_factor: Option<f64>,
    /// Ratio of maximum edge lift to the lift under uniform pressure.
    correction_factor_of_greatest_lift: Option<f64>,
    edge_lift: EdgeLift,
    largest_stress: LargestStress,
    largest_stress_uniform: LargestStress,
    allowable_pressure_pa: Option<f64>,
    pressures: Vec<PlateRow>,
    /// Geometries with the damper's Ce.
    fits: Vec<Fit>,
}

/// Results of the plate analysis.
#[derive(Serialize)]
pub(in crate::commands::shims) struct PlateReport {
    allowable_stress_pa: Option<f64>,
    valves: Vec<PlateValve>,
}

impl PlateReport {
    /// Creates the report on solved stacks.
    ///
    /// # Errors
    /// The published tables built into the program are damaged.
    pub(in crate::commands::shims) fn new(
        arguments: &PlateArguments,
        solved: &[Solved],
    ) -> Outcome<Self> {
        Ok(Self {
            allowable_stress_pa: arguments.allowable_stress_pa,
            valves: (solved.iter())
                .map(|solved| valve_report(arguments, solved))
                .collect::<Outcome<_>>()?,
        })
    }
}

fn valve_report(arguments: &PlateArguments, solved: &Solved) -> Outcome<PlateValve> {
    let (stack, bending) = (&solved.stack, solved.bending());
    let uniform = stack.uniform_edge_lift_m_per_pa();
    let mean = bending.mean_edge_lift_m_per_pa();
    let [least, greatest] = bending.edge_lift_range_m_per_pa();
    let largest = stack.largest_stress(bending);
    let thickness = stack.stretched_thickness_m();
    let row = |pressure_pa: f64, at_force_limit: bool| {
        let lifting = (pressure_pa - solved.preload_pa).max(0.0);
        let lift_over_thickness = greatest * lifting / thickness;
        PlateRow {
            pressure_pa,
            at_force_limit,
            mean_lift_m: mean * lifting,
            greatest_lift_m: greatest * lifting,
            largest_stress_pa: largest.von_mises_per_pressure * pressure_pa,
            lift_over_thickness,
            plate_theory_holds: lift_over_thickness <= SMALL_LIFT,
        }
    };
    let listed: Vec<f64> = if arguments.pressure_pa.is_empty() {
        let table = solved.location.published()?;
        table.iter().map(|row| row.pressure_pa()).collect()
    } else {
        arguments.pressure_pa.clone()
    };
    let mut pressures: Vec<PlateRow> = listed.iter().map(|pa| row(*pa, false)).collect();
    pressures.push(row(solved.at_force_limit_pa, true));
    let known = solved.real.is_some();
    Ok(PlateValve {
        valve: solved.location.name,
        stacking: stack.stacking(),
        equivalent_thickness_m: stack.equivalent_thickness_m(),
        pressure_area: solved.real.as_ref().map(|(area, _)| *area),
        pressure_area_is_given: solved.given,
        damper_correction_factor: solved.factor,
        correction_factor: known.then_some(mean / uniform),
        correction_factor_of_greatest_lift: known.then_some(greatest / uniform),
        edge_lift: EdgeLift {
            mean_m_per_pa: mean,
            least_m_per_pa: least,
            greatest_m_per_pa: greatest,
        },
        allowable_pressure_pa: arguments
            .allowable_stress_pa
            .map(|stress| stress / largest.von_mises_per_pressure),
        largest_stress: largest,
        largest_stress_uniform: stack.largest_stress(&solved.whole),
        pressures,
        fits: solved.fits.clone(),
    })
}

/// Prints the report as text.
pub(in crate::commands::shims) fn print(
    out: &mut dyn Write,
    report: &PlateReport,
) -> io::Result<()> {
    writeln!(
        out,
        "\nshims as thin plates, computed from the shims in the damper file (a compliance in the file is not used)"
    )?;
    for valve in &report.valves {
        print_valve(out, valve, report.allowable_stress_pa)?;
    }
    if report
        .valves
        .iter()
        .flat_map(|valve| &valve.pressures)
        .any(|row| !row.plate_theory_holds)
    {
        writeln!(
            out,
            "\n*: lift above half the thickness; plate theory overstates it, by 3 % at half and 9 % at one thickness"
        )?;
    }
    Ok(())
}

fn print_valve(
    out: &mut dyn Write,
    valve: &PlateValve,
    allowable_stress_pa: Option<f64>,
) -> io::Result<()> {
    let stacking = match valve.stacking {
        Stacking::Sliding => "sliding",
        Stacking::Bonded => "bonded",
    };
    writeln!(
        out,
        "\n{}: {stacking} discs, equivalent thickness {:.4} mm",
        valve.valve,
        valve.equivalent_thickness_m * 1e3
    )?;
    match &valve.pressure_area {
        Some(area) => {
            let source = if valve.pressure_area_is_given {
                "given"
            } else if valve.damper_correction_factor == 1.0 {
                "the file has Ce = 1"
            } else {
                "of an assumed kind, fitted to the Ce of the file"
            };
            writeln!(out, "  pressure: {} ({source})", described(area))?;
        }
        None => writeln!(
            out,
            "  pressure: on the whole disc; no area of the assumed kind gives the Ce of the file, {}",
            valve.damper_correction_factor
        )?,
    }
    if let Some((mean, greatest)) =
        (valve.correction_factor).zip(valve.correction_factor_of_greatest_lift)
    {
        writeln!(
            out,
            "  Ce {mean:.4} from the mean edge lift, {greatest:.4} from the maximum edge lift; the file has {}",
            valve.damper_correction_factor
        )?;
    }
    let stress = &valve.largest_stress;
    let discs: Vec<String> = stress.discs.iter().map(usize::to_string).collect();
    let angle = match valve.pressure_area {
        Some(PressureArea::Ring(_)) | None => "at all angles".to_owned(),
        Some(_) => format!(
            "{:.1} deg from the centre of a boss",
            stress.angle_rad.to_degrees()
        ),
    };
    let plural = if discs.len() > 1 { "s" } else { "" };
    writeln!(
        out,
        "  maximum stress {:.2} MPa/MPa at r {:.2} mm, {angle}, disc{plural} {} of the file; {:.2} under uniform \
         pressure",
        stress.von_mises_per_pressure,
        stress.radius_m * 1e3,
        discs.join(", "),
        valve.largest_stress_uniform.von_mises_per_pressure
    )?;
    if valve.edge_lift.least_m_per_pa < 0.0 {
        writeln!(
            out,
            "  between bosses the edge moves down, by {:.4} mm/MPa if no seat supports it",
            -valve.edge_lift.least_m_per_pa * 1e9
        )?;
    }
    if let Some((stress, pressure)) = allowable_stress_pa.zip(valve.allowable_pressure_pa) {
        writeln!(
            out,
            "  stress {:.0} MPa is reached at pressure {:.3} MPa",
            stress * 1e-6,
            pressure * 1e-6
        )?;
    }
    writeln!(
        out,
        "  {:>9}{:>15}{:>19}{:>21}{:>17}",
        "P, MPa", "mean lift, mm", "max lift, mm", "max stress, MPa", "lift/thickness"
    )?;
    for row in &valve.pressures {
        writeln!(
            out,
            "  {:>9.3}{:>15.4}{:>19.4}{:>21.0}{:>17.2}{}{}",
            row.pressure_pa * 1e-6,
            row.mean_lift_m * 1e3,
            row.greatest_lift_m * 1e3,
            row.largest_stress_pa * 1e-6,
            row.lift_over_thickness,
            if row.plate_theory_holds { "  " } else { " *" },
            if row.at_force_limit {
                "  at the force limit"
            } else {
                ""
            }
        )?;
    }
    Ok(())
}

/// Describes a pressure area in words.
fn described(area: &PressureArea) -> String {
    let radii = |[from, to]: [f64; 2]| format!("{:.3} to {:.3} mm", from * 1e3, to * 1e3);
    let profile = |profile: &Profile| {
        let full = format!("full from {}", radii(profile.full_m));
        let ends = profile.ends_m.iter().zip(profile.full_m);
        let ends = ends.filter(|(end, full)| **end != *full);
        let ends: Vec<String> = ends.map(|(end, _)| format!("{:.3}", end * 1e3)).collect();
        if ends.is_empty() {
            full
        } else {
            format!(
                "{full}, decaying to zero at {} mm with exponent {}",
                ends.join(" and "),
                profile.exponent
            )
        }
    };
    match area {
        PressureArea::Ring(ring) => profile(ring),
        PressureArea::Sectors(bosses) => format!(
            "on {} sectors covering {} of the circumference, {}",
            bosses.count,
            bosses.share,
            profile(&bosses.profile)
        ),
        PressureArea::Round(bosses) => format!(
            "on {} round bosses at radius {:.3} mm, full up to {:.3} mm and decaying to zero at {:.3} mm from their \
             centres with exponent {}",
            bosses.count,
            bosses.pitch_radius_m * 1e3,
            bosses.hole_radius_m * 1e3,
            bosses.boss_radius_m * 1e3,
            bosses.exponent
        ),
    }
}
