//! Tables of a case file.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use super::error::Origin;
use super::rails::{self, RailsValue};
use super::{CaseError, CaseOptions, EventOptions, FaultOptions};
use crate::FileError;
use crate::contact::{ContactOptions, TABLE};
use crate::lines::{line_at, lines_of_keys};
use crate::shipped::{Found, resolve_name};
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
    rails: Option<Spanned<RailsValue>>,
    #[serde(default)]
    set: Vec<Spanned<String>>,
    /// Replacements by direction or damper name.
    #[serde(default)]
    dampers: BTreeMap<String, Spanned<String>>,
    #[serde(default)]
    fault: Vec<Spanned<FaultTable>>,
    #[serde(default)]
    event: Vec<Spanned<EventOptions>>,
    contact: Option<ContactOptions>,
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
            replacement: self.damper_file.map(|name| resolve_name(folder, &name)),
            overrides: self.set,
        }
    }
}

impl CaseTables {
    /// Converts the tables to options with their positions in the file.
    ///
    /// # Errors
    /// The friction is given twice.
    pub fn options(self, found: &Found) -> Result<CaseOptions, CaseError> {
        let Found { name, text, folder } = found;
        let mut lines = BTreeMap::new();
        let mut at = |key: &str, start: usize| {
            lines.insert(key.to_owned(), line_at(text, start));
        };
        let defaults = CaseOptions::new(
            &resolve_name(folder, self.vehicle.get_ref()),
            &resolve_name(folder, self.track.get_ref()),
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
        let duration_s = number("duration_s", self.duration_s, defaults.duration_s);
        let start_m = number("start_m", self.start_m, defaults.start_m);
        let has_friction = self.friction.is_some();
        let mut friction = number("friction", self.friction, defaults.friction);
        let normal_damping_s_per_m = number(
            "normal_damping_s_per_m",
            self.normal_damping_s_per_m,
            defaults.normal_damping_s_per_m,
        );
        let step_us = number("step_us", self.step_us, defaults.step_us);
        let push_m = number("push_m", self.push_m, defaults.push_m);
        let rails = self.rails.map_or(defaults.rails, |rails| {
            at(rails::KEY, rails.span().start);
            rails.into_inner().0
        });
        let mut dampers = Vec::new();
        for (which, damper) in self.dampers {
            let start = damper.span().start;
            let damper = resolve_name(folder, damper.get_ref());
            let replacement = Replacement::named(which, damper);
            at(&replacement.to_string(), start);
            dampers.push(replacement);
        }
        let mut contact = self.contact.unwrap_or_default();
        contact.resolve_files(folder);
        for (key, line) in lines_of_keys(text, TABLE) {
            lines.insert(format!("{TABLE}.{key}"), line);
        }
        if let Some(in_contact) = contact.friction.take() {
            let line = lines.get("contact.friction").copied().unwrap_or(1);
            if has_friction {
                let message = "friction is also given outside [contact], allowed: one of the two";
                return Err(FileError::in_line(Path::new(name), line, message).into());
            }
            lines.insert("friction".into(), line);
            friction = in_contact;
        }
        let mut overrides = Vec::new();
        for assignment in self.set {
            let line = line_at(text, assignment.span().start);
            lines.insert(assignment.get_ref().clone(), line);
            overrides.push(assignment.into_inner());
        }
        let faults = self.fault.iter();
        let fault_lines = faults.map(|fault| line_at(text, fault.span().start));
        let events = self.event.iter();
        let event_lines = events.map(|event| line_at(text, event.span().start));
        let origin = Origin {
            faults: fault_lines.collect(),
            events: event_lines.collect(),
            file: name.into(),
            lines,
        };
        let faults = self.fault.into_iter();
        let faults = faults.map(|fault| fault.into_inner().options(folder));
        Ok(CaseOptions {
            name: Some(self.name),
            dampers,
            overrides,
            duration_s,
            start_m,
            friction,
            contact,
            normal_damping_s_per_m,
            step_us,
            push_m,
            rails,
            faults: faults.collect(),
            events: self.event.into_iter().map(Spanned::into_inner).collect(),
            origin: Some(origin),
            ..defaults
        })
    }
}
