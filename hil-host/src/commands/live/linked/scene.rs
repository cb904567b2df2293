//! The scene of a target.

use dashpot_live::{DamperDesk, FAULTS, SignalWords};
use serde_json::{Value, json};

use super::motion::Sine;
use super::tap::names;
use crate::commands::link::target::Greeting;

/// Returns the scene of a target at the other end of `line`. `dampers` are those of its slots, if they are known;
/// `motion` is `None` if it runs free.
pub(super) fn scene(
    line: &str,
    target: &Greeting,
    dampers: &[DamperDesk],
    motion: Option<&Sine>,
) -> Value {
    let signals: Vec<SignalWords> = names(target.dampers)
        .iter()
        .map(|name| SignalWords::of(name))
        .collect();
    let slots = (0..target.dampers).map(|slot| {
        let quantities = dampers.get(slot).map(DamperDesk::quantities);
        json!({
            "name": name(slot), "slug": format!("slot_{slot}"), "direction": "lateral",
            "on": [null, null], "ends_m": null, "outside": false, "presets": [],
            "quantities": quantities.unwrap_or_default(),
        })
    });
    let faults = if dampers.is_empty() { &[][..] } else { &FAULTS };
    json!({
        "type": "scene", "version": env!("CARGO_PKG_VERSION"), "source": "target", "role": "operator",
        "case": line, "vehicle": format!("target at {line}"), "track": "", "has_rig": false,
        "step_s": target.step_s, "start_m": 0.0, "end_m": null, "speed_range_km_h": [0.0, 0.0],
        "signals": signals, "bodies": [], "wheelsets": [], "dampers": slots.collect::<Vec<_>>(),
        "profiles": null, "derailment_limit": null, "course": [], "faults": faults, "defects": [],
        "native_digest": null,
        "motion": motion.map(Sine::scene),
        "target": {
            "line": line, "core_version": target.core_version, "dampers": target.dampers,
            "step_s": target.step_s, "clock_hz": target.clock_hz, "running": target.running,
        },
    })
}

/// Name of a slot.
pub(super) fn name(slot: usize) -> String {
    format!("slot {slot}")
}
