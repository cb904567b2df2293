//! A target that runs free: its samples are fetched, and its dampers run beside it if it is said what they are.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use dashpot_core::link::{MAX_SAMPLES, Request, Response, Sample};
use dashpot_core::{Damper, DamperState};

use super::figures::SharedFigures;
use super::order::Order;
use super::tap::Tap;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::interruption;
use crate::commands::link::target::Target;
use crate::commands::link::telemetry::take;
use crate::commands::live::stop::Stop;

/// Time between two figures.
const FIGURES: Duration = Duration::from_millis(250);

/// Time after which a model that began at rest has forgotten its beginning, s.
const FORGETS_S: f64 = 0.5;

/// The target.
pub(super) struct Watched {
    pub target: Target,
    /// Models of the dampers; `None` if it is not known what they are.
    pub models: Option<Vec<Model>>,
    pub step_s: f64,
    pub orders: Receiver<Order>,
    pub stop: Arc<Stop>,
    pub figures: Arc<SharedFigures>,
    pub tap: Tap,
    /// Samples of each slot that wait for those of the others.
    pub waiting: Vec<VecDeque<Sample>>,
}

/// A damper that runs beside that of a slot.
pub(super) struct Model {
    damper: Damper<f32>,
    state: DamperState<f32>,
    /// Last tick; `None` before the first.
    tick: Option<u32>,
    /// Ticks since it began at rest.
    ticks: u32,
}

impl Model {
    pub fn new(damper: Damper<f32>) -> Self {
        Self {
            state: damper.at_rest(0.0),
            damper,
            tick: None,
            ticks: 0,
        }
    }

    /// Force at a sample of the target, N. The model starts at rest, also after a gap; until it has forgotten that, the
    /// force is NaN.
    fn force_n(&mut self, sample: &Sample, step_s: f64) -> f32 {
        if self
            .tick
            .is_none_or(|last| sample.tick != last.wrapping_add(1))
        {
            self.state = self.damper.at_rest(sample.displacement_m);
            self.ticks = 0;
        }
        self.tick = Some(sample.tick);
        self.ticks = self.ticks.saturating_add(1);
        let force_n = self.damper.step(&mut self.state, sample.displacement_m);
        match f64::from(self.ticks) * step_s < FORGETS_S {
            true => f32::NAN,
            false => force_n,
        }
    }
}

impl Watched {
    /// Watches the target until somebody stops it. Returns its ticks, and true if the emergency stop was pressed, which
    /// stops the target, too.
    ///
    /// # Errors
    /// The target does not answer, or does not run any more.
    pub fn run(mut self) -> Outcome<(u64, bool)> {
        let mut ticks = 0;
        let mut figures_at = Instant::now() - FIGURES;
        let pause = Duration::from_secs_f64((self.step_s * MAX_SAMPLES as f64).min(0.1));
        let is_stopped = loop {
            if self.stop.takes() {
                self.target.order(&Request::Stop)?;
                break true;
            }
            if interruption::is_wanted() {
                break false;
            }
            while let Ok(order) = self.orders.try_recv() {
                self.take(order)?;
            }
            let fetched = self.fetch()?;
            ticks += fetched;
            self.tap.look_after();
            if figures_at.elapsed() >= FIGURES {
                figures_at = Instant::now();
                self.tell()?;
            }
            if fetched == 0 {
                std::thread::sleep(pause);
            }
        };
        self.tap.finish();
        Ok((ticks, is_stopped))
    }

    /// Fetches new samples of all slots; returns the number of ticks that all of them have.
    fn fetch(&mut self) -> Outcome<u64> {
        for (slot, waiting) in (0..).zip(&mut self.waiting) {
            let taken = take(&mut self.target, slot)?;
            waiting.extend(taken.samples);
            self.figures.lock().slots[usize::from(slot)].count_lost(taken.overwritten);
        }
        let mut ticks = 0;
        let mut values = Vec::new();
        while let Some(samples) = self.oldest() {
            let newest = samples.iter().map(|sample| sample.tick).max();
            let newest = newest.unwrap_or_default();
            // A slot whose oldest samples were overwritten waits for the others to come to the same tick.
            let is_gap = samples.iter().any(|sample| sample.tick < newest);
            for waiting in &mut self.waiting {
                if !is_gap || waiting[0].tick < newest {
                    waiting.pop_front();
                }
            }
            if is_gap {
                continue;
            }
            values.clear();
            let mut figures = self.figures.lock();
            for (slot, sample) in samples.iter().enumerate() {
                let model = self.models.as_mut().map(|models| &mut models[slot]);
                let model_n = model.map_or(f32::NAN, |model| model.force_n(sample, self.step_s));
                values.extend([sample.displacement_m, sample.force_n, model_n]);
                let told = &mut figures.slots[slot];
                told.status |= sample.status;
                if model_n.is_finite() {
                    let now_n = (sample.force_n - model_n).abs();
                    told.difference_n = Some(told.difference_n.unwrap_or(0.0).max(now_n));
                }
            }
            figures.tick = newest;
            drop(figures);
            self.tap.add(newest, &values, f32::NAN, false);
            ticks += 1;
        }
        Ok(ticks)
    }

    /// The oldest sample of each slot; `None` if a slot has none.
    fn oldest(&self) -> Option<Vec<Sample>> {
        let slots = self.waiting.iter();
        slots.map(|waiting| waiting.front().copied()).collect()
    }

    /// Tells counters and status, and sees whether the target still runs.
    fn tell(&mut self) -> Outcome<()> {
        let counters = self
            .target
            .ask(&Request::Counters, |response| match response {
                Response::Counters(counters) => Some(counters),
                _ => None,
            })?;
        let asked = Instant::now();
        let (status, rejected) = self
            .target
            .ask(&Request::Status, |response| match response {
                Response::Status {
                    status,
                    rejected_inputs,
                } => Some((status.to_vec(), rejected_inputs.to_vec())),
                _ => None,
            })?;
        let round_trip_us = 1e6 * asked.elapsed().as_secs_f64();
        let mut figures = self.figures.lock();
        figures.counters = Some(counters);
        figures.round_trip_us = [round_trip_us; 2];
        let told = status.iter().zip(&rejected);
        for (slot, (status, rejected_inputs)) in figures.slots.iter_mut().zip(told) {
            (slot.status, slot.rejected_inputs) = (*status, *rejected_inputs);
        }
        Ok(())
    }

    fn take(&mut self, order: Order) -> Outcome<()> {
        match order {
            // A free-running target gets its motion elsewhere, and its page has no control for it.
            Order::Motion(_) => Ok(()),
            Order::Damper { slot, damper } => {
                let number =
                    u8::try_from(slot).map_err(|_| Failure::new("there is no such slot"))?;
                let image = damper.to_image();
                self.target.order(&Request::Load {
                    damper: number,
                    image: &image,
                })?;
                if let Some(models) = &mut self.models {
                    models[slot].damper = *damper;
                }
                Ok(())
            }
            Order::ClearStatus => self.target.ask(&Request::ClearStatus, |response| {
                matches!(response, Response::Status { .. }).then_some(())
            }),
        }
    }
}
