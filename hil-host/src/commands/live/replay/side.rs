//! A recording as the source of a page.

use std::time::Instant;

use dashpot_live::{FACTOR, within};
use dashpot_server::Hub;
use serde::Deserialize;
use serde_json::{Value, json};

use super::player::Player;
use crate::commands::live::source::{Source, Told, read};

/// A request of the operator of a recording.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
enum Request {
    /// Another speed of time; 0 pauses.
    Run { factor: f64 },
    /// A few rows of a paused recording.
    Step { ticks: u32 },
    /// Another time.
    Seek { time_s: f64 },
    /// To the start.
    Reset,
}

/// A recording that viewers watch together.
pub(super) struct ReplaySide {
    pub player: Player,
    pub hub: Hub,
    pub scene: Value,
    pub status: Value,
    /// When time was last looked after; `None` before the first viewer came.
    pub since: Option<Instant>,
}

impl ReplaySide {
    fn send(&self, frames: &[Vec<u8>]) {
        self.hub.frames(frames.iter().map(Vec::as_slice));
    }

    /// Turns to a time, and shows what was before it.
    fn seek(&mut self, time_s: f64) {
        let mut frames = Vec::new();
        self.player.seek(time_s, &mut frames);
        let sought = json!({"type": "sought", "time_s": self.player.time_s()});
        self.hub.begin_anew(&sought.to_string());
        self.send(&frames);
    }
}

impl Source for ReplaySide {
    fn scene(&self) -> &Value {
        &self.scene
    }

    fn status(&self) -> Value {
        let mut status = self.status.clone();
        status["factor"] = json!(self.player.factor());
        status
    }

    fn joined(&mut self) {
        self.since.get_or_insert_with(Instant::now);
        self.seek(self.player.time_s());
    }

    fn look_after(&mut self) -> bool {
        let Some(since) = &mut self.since else {
            return false;
        };
        let elapsed = since.elapsed();
        *since += elapsed;
        let was_running = self.player.factor() > 0.0;
        let mut frames = Vec::new();
        self.player.advance(elapsed.as_secs_f64(), &mut frames);
        self.send(&frames);
        was_running && self.player.factor() == 0.0
    }

    fn operate(&mut self, message: Value) -> Result<Told, String> {
        match read::<Request>(message)? {
            Request::Run { factor } => {
                within("factor", factor, FACTOR).map_err(|error| error.to_string())?;
                if factor > 0.0 && self.player.is_at_end() {
                    self.seek(self.player.ends_s()[0]);
                }
                self.player.set_factor(factor);
            }
            Request::Step { .. } if self.player.factor() > 0.0 => {
                return Err("single steps: allowed while the recording is paused".into());
            }
            Request::Step { ticks } => {
                let mut frames = Vec::new();
                self.player.step(ticks, &mut frames);
                self.send(&frames);
            }
            Request::Seek { time_s } => {
                let ends_s = self.player.ends_s();
                within("time_s", time_s, ends_s).map_err(|error| error.to_string())?;
                self.seek(time_s);
            }
            Request::Reset => self.seek(self.player.ends_s()[0]),
        }
        Ok(Told::Status)
    }

    // A recording ends by no fault of its own.
    fn end(&mut self, _: String) {}
}
