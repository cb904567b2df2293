//! What a page shows besides the numbers of a frame.

use serde::Serialize;

use crate::damper_desk::{DamperDesk, DamperStatus};
use crate::desk::Desk;
use crate::{Action, Choice};

/// State of the desk and of the run in words and numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Status {
    #[serde(rename = "type")]
    kind: &'static str,
    /// Factor of real time that is wanted; 0 while paused.
    pub factor: f64,
    speed_km_h: f64,
    friction_factor: f64,
    /// How the run ended.
    pub ended: Option<String>,
    /// Results outside the validity of the model.
    pub warnings: Vec<String>,
    dampers: Vec<DamperStatus>,
    /// Everything that a link needs to start the same run.
    pub setting: Option<Setting>,
    /// True while the vehicle as new runs beside.
    pub is_comparing: bool,
    /// True while ticks are recorded.
    pub is_recording: bool,
    /// Ticks of the recording.
    pub recorded_ticks: u64,
    /// `operator` or `viewer`.
    pub role: &'static str,
    /// Pages that are connected.
    pub viewers: u32,
}

/// A case and the actions on it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Setting {
    version: &'static str,
    choice: Choice,
    actions: Vec<(u64, Action)>,
}

impl Status {
    /// The status of a desk, for an operator who is alone.
    pub fn new(desk: &Desk, choice: Option<&Choice>) -> Self {
        Self {
            kind: "status",
            factor: 1.0,
            speed_km_h: desk.speed_km_h(),
            friction_factor: desk.friction_factor(),
            ended: None,
            warnings: Vec::new(),
            dampers: desk.dampers().iter().map(DamperDesk::status).collect(),
            setting: choice.map(|choice| Setting {
                version: env!("CARGO_PKG_VERSION"),
                choice: choice.clone(),
                actions: desk.actions().to_vec(),
            }),
            is_comparing: false,
            is_recording: false,
            recorded_ticks: 0,
            role: "operator",
            viewers: 1,
        }
    }
}
