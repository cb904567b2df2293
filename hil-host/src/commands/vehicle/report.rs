//! Report of a run.

use std::io::{self, Write};
use std::path::PathBuf;

use serde::Serialize;

use super::contact::ContactReport;
use super::outside::{self, OutsideReport};
use super::wear;
use super::xcp::XcpReport;
use crate::commands::counted;
use crate::commands::paced::Paced;
use crate::commands::vehicle::drive::Driven;
use dashpot_files::case::Case;
use dashpot_files::output;
use dashpot_rail::vehicle::RailSupport;
use dashpot_realtime::pacing::PacingReport;
use dashpot_realtime::timing::span;
use dashpot_vehicle_run::damping::DampingInfluence;
use dashpot_vehicle_run::{
    Ending, Indices, Judged, Nadal, RideIndices, Warning, WearIndices, WheelIndices,
    WheelsetIndices,
};

/// Report of a run.
#[derive(Serialize)]
pub(super) struct Report {
    pub(super) case: String,
    pub(super) vehicle: String,
    pub(super) track: String,
    pub(super) speed_km_h: f64,
    pub(super) friction: f64,
    /// Profiles, gauge, inclination and friction.
    pub(super) contact: ContactReport,
    /// Support of the rails; `None` for rigid rails.
    pub(super) rails: Option<RailSupport>,
    #[serde(skip)]
    pub(super) support: String,
    pub(super) normal_damping_s_per_m: f64,
    pub(super) step_s: f64,
    pub(super) ticks: u64,
    /// Changes of dampers, speed, friction and forces during the run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) changes: Vec<String>,
    pub(super) ending: Ending,
    /// Influence of the normal damping on the greatest wheel load; `None` if it shows no impact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) damping: Option<DampingInfluence>,
    /// Results outside the validity of the model, with time and position.
    pub(super) warnings: Vec<Found>,
    /// `None` if [`Ending::has_indices`] is false.
    pub(super) indices: Option<Indices>,
    /// Estimated wear of the wheels; `None` without indices.
    pub(super) wear: Option<WearIndices>,
    /// Mean computing time per tick, s.
    pub(super) mean_tick_s: f64,
    /// Timing of a real-time run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) realtime: Option<Paced>,
    #[serde(skip)]
    pub(super) pacing: Option<PacingReport>,
    /// `None` if all dampers are simulated internally.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) outside: Option<OutsideReport>,
    /// What a measurement and calibration tool did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) xcp: Option<XcpReport>,
    pub(super) files: Vec<PathBuf>,
}

/// A warning with its message.
#[derive(Serialize)]
pub(super) struct Found {
    #[serde(flatten)]
    warning: Warning,
    pub(super) message: String,
}

impl Report {
    pub(super) fn new(
        case: &Case,
        driven: &Driven,
        indices: Option<Indices>,
        warnings: Vec<Warning>,
        pacing: Option<PacingReport>,
    ) -> Self {
        let has_indices = driven.ending.has_indices();
        let found = |warning: Warning| Found {
            message: warning.to_string(),
            warning,
        };
        let paced = |pacing| Paced::with_times(pacing, case.step_s, driven.waits);
        Self {
            case: case.name.clone(),
            vehicle: case.vehicle.name.clone(),
            track: case.track.name.clone(),
            speed_km_h: 3.6 * case.speed_m_per_s,
            friction: case.friction,
            contact: ContactReport::new(case),
            rails: case.rails,
            support: support(case.rails.as_ref()),
            normal_damping_s_per_m: case.normal_damping_s_per_m,
            step_s: case.step_s,
            ticks: driven.ticks,
            changes: changes(case),
            ending: driven.ending.clone(),
            damping: None,
            warnings: warnings.into_iter().map(found).collect(),
            indices: indices.filter(|_| has_indices),
            wear: None,
            mean_tick_s: driven.stepping.as_secs_f64() / driven.ticks.max(1) as f64,
            realtime: pacing.as_ref().map(paced),
            pacing,
            outside: None,
            xcp: None,
            files: Vec::new(),
        }
    }
}

/// Describes what changes during the run: dampers first, each kind in the order of time.
fn changes(case: &Case) -> Vec<String> {
    let faults = case.faults.iter();
    let faults = faults.map(|fault| format!("at {} s: {} changes", fault.time_s, fault.damper));
    let events = case.events.iter().map(ToString::to_string);
    faults.chain(events).collect()
}

/// Describes the support of the rails.
fn support(rails: Option<&RailSupport>) -> String {
    let Some(rails) = rails else {
        return "rigid".to_owned();
    };
    let direction = |name: &str, stiffness: f64, damping: f64, mass: f64| {
        format!(
            "{name} {} MN/m, {} kN s/m, {mass} kg",
            1e-6 * stiffness,
            1e-3 * damping
        )
    };
    format!(
        "under each wheel, {}; {}",
        direction(
            "vertical",
            rails.vertical_stiffness_n_per_m,
            rails.vertical_damping_n_s_per_m,
            rails.vertical_mass_kg
        ),
        direction(
            "lateral",
            rails.lateral_stiffness_n_per_m,
            rails.lateral_damping_n_s_per_m,
            rails.lateral_mass_kg
        )
    )
}

pub(super) fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "{}: {} on {} at {:.1} km/h",
        report.case, report.vehicle, report.track, report.speed_km_h
    )?;
    for (what, text) in report.contact.lines() {
        writeln!(out, "{:<10}{text}", format!("{what}:"))?;
    }
    writeln!(out, "support:  {}", report.support)?;
    writeln!(
        out,
        "normal damping {} s/m, step {} us; {} of {}",
        report.normal_damping_s_per_m,
        (1e6 * report.step_s).round(),
        counted(report.ticks, "tick"),
        span(1e9 * report.mean_tick_s)
    )?;
    for change in &report.changes {
        writeln!(out, "change:   {change}")?;
    }
    for found in &report.warnings {
        writeln!(out, "warning: {}", found.message)?;
    }
    if let Some(indices) = &report.indices {
        writeln!(out)?;
        writeln!(
            out,
            "acceleration, m/s^2        lateral rms       max  vertical rms       max"
        )?;
        for body in &indices.bodies {
            writeln!(
                out,
                "{:<26} {:11.3} {:9.2} {:13.3} {:9.2}",
                body.body,
                body.lateral_rms_m_per_s2,
                body.lateral_greatest_m_per_s2,
                body.vertical_rms_m_per_s2,
                body.vertical_greatest_m_per_s2
            )?;
        }
        writeln!(
            out,
            "unbalanced, from layout    {:11.3} {:9.2}",
            indices.unbalanced.rms_m_per_s2, indices.unbalanced.greatest_m_per_s2
        )?;
        print_ride(out, &indices.ride)?;
        writeln!(out)?;
        writeln!(
            out,
            "wheelset, front first      Q left, kN  Q right, kN  Y/Q left  right  lateral, kN  wear, N"
        )?;
        for wheelset in &indices.wheelsets {
            let [left, right] = &wheelset.wheels[..] else {
                continue;
            };
            writeln!(
                out,
                "{:<26} {:>4.0} - {:>3.0} {:>6.0} - {:>3.0} {:9.2} {:6.2} {:12.1} {:8.0}",
                wheelset.wheelset,
                1e-3 * left.load_least_n,
                1e-3 * left.load_greatest_n,
                1e-3 * right.load_least_n,
                1e-3 * right.load_greatest_n,
                left.derailment_greatest,
                right.derailment_greatest,
                1e-3 * wheelset.lateral_force_greatest_n,
                wheelset.wear_number_n
            )?;
        }
        writeln!(
            out,
            "Q: range within all steps; Y/Q and lateral force: filtered at 20 Hz, maximum of the mean over 2 m"
        )?;
        print_limits(out, indices)?;
        for sentence in verdict(indices, !report.warnings.is_empty()) {
            writeln!(out, "{sentence}")?;
        }
        if let Some(found) = &report.damping {
            writeln!(out, "{}", of_damping(found))?;
        }
    }
    if let Some(found) = &report.wear {
        wear::print(out, found)?;
    }
    if let Some(realtime) = &report.realtime {
        writeln!(out)?;
        realtime.write(out, "all work of a tick")?;
    }
    if let Some(found) = &report.outside {
        outside::print(out, found)?;
    }
    if let Some(xcp) = &report.xcp {
        xcp.print(out)?;
    }
    writeln!(out)?;
    for file in &report.files {
        writeln!(out, "wrote {}", output::name(file).display())?;
    }
    Ok(())
}

/// Prints ride indices, if the run is long enough for a window.
fn print_ride(out: &mut dyn Write, all: &[RideIndices]) -> io::Result<()> {
    let complete = all.iter().filter_map(|ride| {
        let sperling = (ride.sperling_lateral?, ride.sperling_vertical?);
        Some((ride, sperling, ride.mean_comfort?))
    });
    for (number, (ride, (lateral, vertical), comfort)) in complete.enumerate() {
        if number == 0 {
            let [from, to] = ride.sperling_band_hz;
            writeln!(
                out,
                "\nride in {}: Sperling's index from {from} to {to} Hz, and mean comfort of EN 12299",
                counted_windows(ride)
            )?;
            writeln!(
                out,
                "point                       height, m  W lateral  W vertical     N_MV"
            )?;
        }
        writeln!(
            out,
            "{:<27} {:9.2} {lateral:10.3} {vertical:11.3} {comfort:8.3}",
            ride.point, ride.at_m[2]
        )?;
    }
    Ok(())
}

/// Formats the number and length of the windows.
pub(super) fn counted_windows(ride: &RideIndices) -> String {
    format!("{} of {} s", counted(ride.windows, "window"), ride.window_s)
}

/// Prints forces relative to their limits.
fn print_limits(out: &mut dyn Write, indices: &Indices) -> io::Result<()> {
    writeln!(
        out,
        "\n%, worse wheel             unloaded  mean  lifted  Q limit   Nadal  Prud'homme  wear rms, N       max"
    )?;
    for wheelset in &indices.wheelsets {
        let limits = Limits::of(wheelset);
        writeln!(
            out,
            "{:<26} {:>8} {:>5} {:7.1} {:>8} {:7.0} {:>11} {:12.0} {:9.0}",
            wheelset.wheelset,
            percent(limits.unloading),
            percent(limits.unloading_of_mean),
            1e2 * limits.lifted_share,
            percent(limits.load_over_limit),
            1e2 * limits.over_nadal,
            percent(wheelset.lateral_force_over_limit),
            wheelset.wear_number_rms_n,
            wheelset.wear_number_greatest_n
        )?;
    }
    writeln!(
        out,
        "unloading relative to the static load: instantaneous, and of the mean over 2 m; Q filtered at 20 Hz as %\n\
         of the limit of EN 14363 for the speed; Y/Q as % of Nadal's limit, {};\n\
         lateral force as % of Prud'homme's limit for the static load",
        nadal_limits(indices)
    )
}

/// States how far the greatest wheel load depends on the normal damping.
pub(super) fn of_damping(found: &DampingInfluence) -> String {
    let load = |load_n: Option<f64>| {
        load_n.map_or_else(
            || "no result".into(),
            |load_n| format!("{:.0} kN", 1e-3 * load_n),
        )
    };
    let [low, high] = found.damping_s_per_m;
    if !found.is_examined {
        return format!(
            "impacts: the greatest wheel load, {:.0} kN, depends on the normal damping, which is assumed; by how much \
             was not examined, because the run takes more than 100 s or was interrupted",
            1e-3 * found.greatest_load_n
        );
    }
    let [with_low, with_high] = found.greatest_loads_n.map(load);
    format!(
        "impacts: the greatest wheel load, {:.0} kN, depends on the normal damping, which is assumed: {with_low} with \
         {low} s/m, {with_high} with {high} s/m, the range of steel",
        1e-3 * found.greatest_load_n
    )
}

/// States whether every limit is kept, and the value of each force with its limit.
pub(super) fn verdict(indices: &Indices, has_warnings: bool) -> Vec<String> {
    let limits = &indices.limits;
    let broken = limits.iter().filter(|judged| !judged.is_kept()).count();
    let sentence = match (limits.len(), broken) {
        (0, _) => return Vec::new(),
        (all, 0) if has_warnings => format!("limits: all {all} kept, but read the warnings"),
        (all, 0) => format!("limits: all {all} kept"),
        (all, broken) => format!("limits: {broken} of {all} NOT kept"),
    };
    let line = |judged: &Judged| {
        let Judged {
            quantity,
            of,
            value,
            limit,
            ratio,
        } = judged;
        let percent = 1e2 * ratio;
        if quantity.contains('/') {
            format!("  {quantity} {value:.2} of {limit:.2}, {percent:.0} %: {of}")
        } else {
            format!(
                "  {quantity} {:.0} of {:.0} kN, {percent:.0} %: {of}",
                1e-3 * value,
                1e-3 * limit
            )
        }
    };
    std::iter::once(sentence)
        .chain(limits.iter().map(line))
        .collect()
}

/// States Nadal's limits and the wheels that have them.
pub(super) fn nadal_limits(indices: &Indices) -> String {
    let limit = |nadal: &Nadal| {
        format!(
            "{:.2} for a flange of {:.1} degrees ({}) and friction {}",
            nadal.limit,
            nadal.flange_angle_rad.to_degrees(),
            nadal.profile,
            nadal.friction
        )
    };
    match &indices.nadal_limits[..] {
        [one] => limit(one),
        several => {
            let each = several.iter().map(|nadal| {
                let wheels = nadal.wheels.iter();
                let wheels = wheels.map(|wheel| format!("{} {}", wheel.wheelset, wheel.side));
                let wheels: Vec<String> = wheels.collect();
                format!("{}: {}", limit(nadal), wheels.join(", "))
            });
            each.collect::<Vec<_>>().join("; ")
        }
    }
}

/// Values of the worse of the two wheels.
pub(super) struct Limits {
    pub(super) unloading: Option<f64>,
    pub(super) unloading_of_mean: Option<f64>,
    pub(super) lifted_share: f64,
    pub(super) load_over_limit: Option<f64>,
    pub(super) over_nadal: f64,
    pub(super) longest_over_nadal_m: f64,
}

impl Limits {
    pub(super) fn of(wheelset: &WheelsetIndices) -> Self {
        let wheels = &wheelset.wheels;
        let max = |value: &dyn Fn(&WheelIndices) -> Option<f64>| {
            wheels.iter().filter_map(value).reduce(f64::max)
        };
        let max_or_zero =
            |value: &dyn Fn(&WheelIndices) -> f64| max(&|wheel| Some(value(wheel))).unwrap_or(0.0);
        Self {
            unloading: max(&|wheel| wheel.unloading_greatest),
            unloading_of_mean: max(&|wheel| wheel.unloading_of_mean_greatest),
            lifted_share: max_or_zero(&|wheel| wheel.lifted_share),
            load_over_limit: max(&|wheel| wheel.load_over_limit),
            over_nadal: max_or_zero(&|wheel| wheel.derailment_over_nadal),
            longest_over_nadal_m: max_or_zero(&|wheel| wheel.longest_over_nadal_m),
        }
    }
}

/// Formats a part in whole percent.
pub(super) fn percent(part: Option<f64>) -> String {
    part.map_or_else(|| "-".into(), |part| format!("{:.0}", 1e2 * part))
}
