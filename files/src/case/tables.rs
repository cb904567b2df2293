//! The tables of a case file.

use std::collections::BTreeMap;
use std::path::Path;

use dashpot_rail::vehicle::RailSupport;
use serde::Deserialize;
use toml::Spanned;

use super::error::Origin;
use super::{CaseOptions, FaultOptions};
use crate::lines::line_at;
use crate::shipped::{Found, named_in};
use crate::vehicle::Replacement;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CaseTables {
    name: String,
    vehicle: Spanned<String>,
    track: Spanned<String>,
    speed_km_h: Spanned<f64>,
    duration_s: Option<Spanned<f64>>,
    start_m: Option<Spanned<f64>>,
    friction: Option<Spanned<f64>>,
    normal_damping_s_per_m: Option<Spanned<f64>>,
    step_us: Option<Spanned<f64>>,
    push_m: Option<Spanned<f64>>,
    rails: Option<Spanned<RailsTable>>,
    #[serde(default)]
    set: Vec<Spanned<String>>,
    /// Which, and what they become.
    #[serde(default)]
    dampers: BTreeMap<String, Spanned<String>>,
    #[serde(default)]
    fault: Vec<Spanned<FaultTable>>,
}

/// Rails that give way.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RailsTable {
    mass_kg: f64,
    lateral_stiffness_n_per_m: f64,
    lateral_damping_n_s_per_m: f64,
    vertical_stiffness_n_per_m: f64,
    vertical_damping_n_s_per_m: f64,
}

impl From<RailsTable> for RailSupport {
    fn from(table: RailsTable) -> Self {
        Self::new(table.mass_kg)
            .with_lateral(
                table.lateral_stiffness_n_per_m,
                table.lateral_damping_n_s_per_m,
            )
            .with_vertical(
                table.vertical_stiffness_n_per_m,
                table.vertical_damping_n_s_per_m,
            )
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FaultTable {
    time_s: f64,
    damper: String,
    damper_file: Option<String>,
    #[serde(default)]
    set: Vec<String>,
}

impl FaultTable {
    fn options(self, folder: &Path) -> FaultOptions {
        FaultOptions {
            time_s: self.time_s,
            damper: self.damper,
            by: self.damper_file.map(|name| named_in(folder, &name)),
            overrides: self.set,
        }
    }
}

impl CaseTables {
    /// The options in the file that was found.
    pub fn options(self, found: &Found) -> CaseOptions {
        let Found { name, text, folder } = found;
        let mut lines = BTreeMap::new();
        let mut at = |key: &str, start: usize| {
            lines.insert(key.to_owned(), line_at(text, start));
        };
        let new = CaseOptions::new(
            &named_in(folder, self.vehicle.get_ref()),
            &named_in(folder, self.track.get_ref()),
            *self.speed_km_h.get_ref(),
        );
        at("vehicle", self.vehicle.span().start);
        at("track", self.track.span().start);
        at("speed_km_h", self.speed_km_h.span().start);
        let mut number = |key: &str, value: Option<Spanned<f64>>, default: f64| {
            value.map_or(default, |value| {
                at(key, value.span().start);
                value.into_inner()
            })
        };
        let duration_s = number("duration_s", self.duration_s, new.duration_s);
        let start_m = number("start_m", self.start_m, new.start_m);
        let friction = number("friction", self.friction, new.friction);
        let normal_damping_s_per_m = number(
            "normal_damping_s_per_m",
            self.normal_damping_s_per_m,
            new.normal_damping_s_per_m,
        );
        let step_us = number("step_us", self.step_us, new.step_us);
        let push_m = number("push_m", self.push_m, new.push_m);
        let rails = self.rails.map(|rails| {
            at("rails", rails.span().start);
            rails.into_inner().into()
        });
        let mut dampers = Vec::new();
        for (which, by) in self.dampers {
            let start = by.span().start;
            let by = named_in(folder, by.get_ref());
            let replacement = Replacement::named(which, by);
            at(&replacement.to_string(), start);
            dampers.push(replacement);
        }
        let mut overrides = Vec::new();
        for assignment in self.set {
            at(assignment.get_ref(), assignment.span().start);
            overrides.push(assignment.into_inner());
        }
        let faults = self.fault.iter();
        let fault_lines = faults.map(|fault| line_at(text, fault.span().start));
        let origin = Origin {
            faults: fault_lines.collect(),
            file: name.into(),
            lines,
        };
        let faults = self.fault.into_iter();
        let faults = faults.map(|fault| fault.into_inner().options(folder));
        CaseOptions {
            name: Some(self.name),
            dampers,
            overrides,
            duration_s,
            start_m,
            friction,
            normal_damping_s_per_m,
            step_us,
            push_m,
            rails,
            faults: faults.collect(),
            origin: Some(origin),
            ..new
        }
    }
}
