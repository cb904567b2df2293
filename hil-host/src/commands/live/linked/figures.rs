//! Figures of a target, from the thread that talks with it to the operator's side.

use std::sync::{Mutex, MutexGuard, PoisonError};

use dashpot_core::link::Counters;
use dashpot_files::status_bits;
use serde_json::{Value, json};

/// Figures of a target.
#[derive(Debug, Clone, Default)]
pub(super) struct Figures {
    pub tick: u32,
    pub counters: Option<Counters>,
    pub slots: Vec<Slot>,
    /// Time of a step of the whole bank on the target, mean and greatest since the last figures, us.
    pub work_us: [f64; 2],
    /// Time from a request to its answer, mean and greatest since the last figures, us.
    pub round_trip_us: [f64; 2],
    pub late_ticks: u64,
    pub warnings: Vec<String>,
}

/// Figures of a slot.
#[derive(Debug, Clone, Default)]
pub(super) struct Slot {
    pub status: u16,
    pub rejected_inputs: u16,
    /// Greatest difference from the model since the start, N; `None` without a model.
    pub difference_n: Option<f32>,
    /// Samples that the target overwrote before they were fetched: at the start, and since then.
    overwritten: Option<u32>,
    lost: u32,
}

impl Slot {
    /// Takes the target's count of samples that it has overwritten since power-on.
    pub fn count_lost(&mut self, overwritten: u32) {
        let before = *self.overwritten.get_or_insert(overwritten);
        self.lost = overwritten.wrapping_sub(before);
    }
}

/// Figures behind a lock that nobody holds for long.
#[derive(Debug, Default)]
pub(super) struct SharedFigures(Mutex<Figures>);

impl SharedFigures {
    /// Locks the figures.
    pub fn lock(&self) -> MutexGuard<'_, Figures> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Figures {
    /// Samples of all slots that were overwritten before they were fetched.
    pub fn lost(&self) -> u32 {
        self.slots
            .iter()
            .map(|slot| slot.lost)
            .fold(0, u32::saturating_add)
    }

    /// The figures as a page gets them.
    pub fn to_json(&self) -> Value {
        let slot = |(number, slot): (usize, &Slot)| {
            let status = status_bits::from_word(slot.status);
            let words = status.iter().map(|bit| status_bits::describe(&[*bit]));
            json!({
                "slot": number, "status": words.collect::<Vec<_>>(), "rejected_inputs": slot.rejected_inputs,
            })
        };
        let differences: Vec<Option<f32>> =
            self.slots.iter().map(|slot| slot.difference_n).collect();
        json!({
            "tick": self.tick,
            "counters": self.counters.as_ref().map(|of| counters(of, self)).unwrap_or_default(),
            "dampers": self.slots.iter().enumerate().map(slot).collect::<Vec<_>>(),
            "work_us": self.work_us,
            "round_trip_us": self.round_trip_us,
            "difference_n": differences,
        })
    }
}

/// Counters of what should not happen.
fn counters(of: &Counters, figures: &Figures) -> Vec<Value> {
    [
        ("late", "ticks answered late", figures.late_ticks),
        ("corrupt", "corrupt frames", of.corrupt.into()),
        ("unreadable", "unreadable requests", of.unreadable.into()),
        (
            "no_session",
            "requests without a session",
            of.no_session.into(),
        ),
        ("repeated", "repeated requests", of.repeated.into()),
        (
            "out_of_order",
            "requests out of sequence",
            of.out_of_order.into(),
        ),
        ("refused", "refused requests", of.refused.into()),
        ("overruns", "ticks that began late", of.overruns.into()),
        ("link_losses", "losses of the link", of.link_losses.into()),
        ("corruptions", "damaged memory", of.corruptions.into()),
        ("lost", "samples that came too late", figures.lost().into()),
    ]
    .map(|(name, label, value)| json!({"name": name, "label": label, "value": value}))
    .into()
}

/// Mean and greatest of what is measured between two figures.
#[derive(Debug, Default)]
pub(super) struct Spread {
    sum: f64,
    greatest: f64,
    count: u32,
}

impl Spread {
    pub fn add(&mut self, value: f64) {
        self.sum += value;
        self.greatest = self.greatest.max(value);
        self.count += 1;
    }

    /// Mean and greatest so far; begins anew.
    pub fn take(&mut self) -> [f64; 2] {
        let Self {
            sum,
            greatest,
            count,
        } = std::mem::take(self);
        [sum / f64::from(count.max(1)), greatest]
    }
}
