//! A target whose every step comes from here: its dampers move in a sine, and the same dampers run beside it.

use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use dashpot_host_link::{Bank, Event, Link, Report, TickRecord};

use super::figures::{SharedFigures, Spread};
use super::motion::Motion;
use super::order::Order;
use super::tap::Tap;
use crate::commands::failure::Outcome;
use crate::commands::interruption;
use crate::commands::live::stop::Stop;

/// Time between two figures.
const FIGURES: Duration = Duration::from_millis(250);

/// Time between two requests for the target's counters, which take the place of ticks.
const COUNTERS: Duration = Duration::from_secs(5);

/// The target and its motion.
pub(super) struct Driven {
    pub bank: Bank<Box<dyn Link + Send>>,
    pub motion: Motion,
    pub step_s: f64,
    pub clock_hz: u32,
    pub dampers: usize,
    pub orders: Receiver<Order>,
    pub stop: Arc<Stop>,
    pub figures: Arc<SharedFigures>,
    pub tap: Tap,
}

/// Measurements between two figures.
#[derive(Default)]
struct Measured {
    work: Spread,
    round_trip: Spread,
    values: Vec<f32>,
}

impl Driven {
    /// Drives the target until somebody stops it. Returns the report, and true if the emergency stop was pressed.
    ///
    /// # Errors
    /// The target is lost and does not recover.
    pub fn run(mut self) -> Outcome<(Report, bool)> {
        let mut displacements_m = vec![0.0; self.dampers];
        let mut measured = Measured::default();
        let (mut figures_at, mut counters_at) = (Instant::now(), Instant::now());
        self.figures.lock().counters = Some(self.bank.counters()?);
        let is_stopped = loop {
            if self.stop.takes() {
                break true;
            }
            if interruption::is_wanted() {
                break false;
            }
            while let Ok(order) = self.orders.try_recv() {
                self.take(order)?;
            }
            displacements_m.fill(self.motion.next_m(self.step_s) as f32);
            let (tap, figures, hz) = (&mut self.tap, &self.figures, self.clock_hz);
            self.bank.step_recorded(&displacements_m, |record| {
                note(record, hz, &mut measured, figures, tap);
            })?;
            self.tap.look_after();
            if figures_at.elapsed() >= FIGURES {
                figures_at = Instant::now();
                let mut figures = self.figures.lock();
                figures.work_us = measured.work.take();
                figures.round_trip_us = measured.round_trip.take();
            }
            if counters_at.elapsed() >= COUNTERS {
                counters_at = Instant::now();
                let counters = self.bank.counters()?;
                self.figures.lock().counters = Some(counters);
            }
        };
        self.tap.finish();
        Ok((self.bank.finish()?, is_stopped))
    }

    fn take(&mut self, order: Order) -> Outcome<()> {
        match order {
            Order::Motion(sine) => self.motion.wanted = sine,
            Order::Damper { slot, damper } => self.bank.replace(slot, *damper)?,
            Order::ClearStatus => {
                self.bank.clear_status()?;
                for slot in &mut self.figures.lock().slots {
                    (slot.status, slot.rejected_inputs) = (0, 0);
                }
            }
        }
        Ok(())
    }
}

/// Takes a tick.
fn note(
    record: &TickRecord<'_>,
    clock_hz: u32,
    measured: &mut Measured,
    figures: &SharedFigures,
    tap: &mut Tap,
) {
    let work_us = 1e6 * f64::from(record.clock_ticks) / f64::from(clock_hz.max(1));
    measured.work.add(work_us);
    measured.round_trip.add(1e-3 * record.round_trip_ns as f64);
    let is_late = record.events.contains(&Event::Late);
    measured.values.clear();
    let forces_n = record.target_forces_n.iter().zip(record.host_forces_n);
    for (displacement_m, (target_n, host_n)) in record.displacements_m.iter().zip(forces_n) {
        measured
            .values
            .extend([*displacement_m, *target_n, *host_n]);
    }
    tap.add(record.tick, &measured.values, work_us as f32, is_late);
    let mut figures = figures.lock();
    figures.tick = record.tick;
    figures.late_ticks += u64::from(is_late);
    let slots = figures.slots.iter_mut().zip(record.target_status);
    for (number, (slot, status)) in slots.enumerate() {
        let now_n = (record.target_forces_n[number] - record.host_forces_n[number]).abs();
        slot.status = *status;
        slot.difference_n = Some(slot.difference_n.unwrap_or(0.0).max(now_n));
    }
}
