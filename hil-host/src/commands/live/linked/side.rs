//! A target as the source of a page.

use std::sync::Arc;
use std::sync::mpsc::SyncSender;

use dashpot_core::Damper;
use dashpot_live::{Action, ActionError, DamperDesk};
use serde::Deserialize;
use serde_json::{Value, json};

use super::figures::SharedFigures;
use super::motion::Sine;
use super::order::Order;
use crate::commands::live::recorded::RecordingState;
use crate::commands::live::source::{Source, Told, read};

/// A request of the operator of a target.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
enum Request {
    /// An action on a damper, or another motion.
    Act { action: TargetAction },
    /// Begins or ends the recording.
    Record { on: bool },
    /// Status bits and rejected inputs to zero.
    ClearStatus,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
enum TargetAction {
    Motion(Motion),
    Damper(Action),
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "action", rename_all = "kebab-case")]
enum Motion {
    Motion { amplitude_m: f64, frequency_hz: f64 },
}

/// The operator's side of a target.
pub(super) struct TargetSide {
    pub scene: Value,
    /// Dampers of the slots; empty if it is not known what they are.
    pub dampers: Vec<DamperDesk>,
    /// `None` if the target runs free.
    pub motion: Option<Sine>,
    pub step_s: f64,
    pub slots: usize,
    pub orders: SyncSender<Order>,
    pub figures: Arc<SharedFigures>,
    pub recording: Arc<RecordingState>,
    /// True if there is a file to record to.
    pub can_record: bool,
    pub ended: Option<String>,
}

impl TargetSide {
    fn order(&self, order: Order) -> Result<(), String> {
        let sent = self.orders.try_send(order);
        sent.map_err(|_| "the target has not done what was wanted before; try again".to_owned())
    }

    fn drive(&mut self, amplitude_m: f64, frequency_hz: f64) -> Result<(), String> {
        if self.motion.is_none() {
            return Err("the target runs free: its motion comes from elsewhere".into());
        }
        let sine = Sine::checked(amplitude_m, frequency_hz).map_err(|error| error.to_string())?;
        self.order(Order::Motion(sine))?;
        self.motion = Some(sine);
        Ok(())
    }

    fn change(&mut self, action: &Action) -> Result<(), String> {
        if self.dampers.is_empty() {
            return Err(
                "it is not known which dampers the target runs: start dashpot live with --slot-damper".into(),
            );
        }
        let name = action
            .damper()
            .ok_or("a target has dampers only; allowed: damper, as-new, preset, fault, motion")?;
        let known = self.dampers.iter().position(|damper| damper.name() == name);
        let slot = known.ok_or_else(|| {
            format!(
                "no damper `{name}`; allowed: slot 0 to slot {}",
                self.slots - 1
            )
        })?;
        let (after, damper) = self
            .built(slot, action)
            .map_err(|error| error.to_string())?;
        self.order(Order::Damper { slot, damper })?;
        self.dampers[slot] = after;
        Ok(())
    }

    fn built(
        &self,
        slot: usize,
        action: &Action,
    ) -> Result<(DamperDesk, Box<Damper<f32>>), ActionError> {
        let after = self.dampers[slot].after(action)?;
        let built = after.parameters()?.build(self.step_s);
        let built = built.map_err(|error| ActionError::Message(error.to_string()))?;
        Ok((after, Box::new(built)))
    }
}

impl Source for TargetSide {
    fn scene(&self) -> &Value {
        &self.scene
    }

    fn status(&self) -> Value {
        let figures = self.figures.lock().clone();
        let unknown = || json!({"values": {}, "quantities": [], "changed": false, "fault": null});
        let dampers = (0..self.slots).map(|slot| match self.dampers.get(slot) {
            Some(damper) => json!(damper.status()),
            None => unknown(),
        });
        let mut warnings = figures.warnings.clone();
        warnings.extend(self.recording.error());
        json!({
            "type": "status", "factor": 1.0, "speed_km_h": 0.0, "friction_factor": 1.0, "ended": self.ended,
            "warnings": warnings, "dampers": dampers.collect::<Vec<_>>(), "setting": null, "is_comparing": false,
            "is_recording": self.recording.is_on(), "recorded_ticks": self.recording.ticks(),
            "late_ticks": figures.late_ticks,
            "motion": self.motion.map(|sine| json!({
                "amplitude_m": sine.amplitude_m, "frequency_hz": sine.frequency_hz,
            })),
            "target": figures.to_json(),
        })
    }

    fn look_after(&mut self) -> bool {
        false
    }

    fn operate(&mut self, message: Value) -> Result<Told, String> {
        match read::<Request>(message)? {
            Request::Act {
                action:
                    TargetAction::Motion(Motion::Motion {
                        amplitude_m,
                        frequency_hz,
                    }),
            } => self.drive(amplitude_m, frequency_hz)?,
            Request::Act {
                action: TargetAction::Damper(action),
            } => self.change(&action)?,
            Request::Record { on } => self.recording.operate(on, self.can_record)?,
            Request::ClearStatus => self.order(Order::ClearStatus)?,
        }
        Ok(Told::Status)
    }

    fn end(&mut self, ending: String) {
        self.ended = Some(ending);
    }
}
