//! The real-time thread: it steps the vehicle and exchanges with dampers outside. It neither allocates nor frees, and
//! nobody that it waits for waits for a viewer.

use std::sync::mpsc::{Receiver, SyncSender};
use std::time::{Duration, Instant};

use dashpot_live::{Simulation, flags};
use dashpot_realtime::handover::Sender;
use dashpot_realtime::pacing::{Clock, Pacer};
use dashpot_vehicle_run::{Ending, VehicleRunError};

use super::beside::Beside;
use super::control::Control;
use super::order::{Note, Order};
use super::tick::Tick;
use crate::commands::vehicle::drive::Exchange;
use crate::commands::vehicle::outside::lines::Lines;

/// Time that a tick leaves when the vehicle runs faster than real time.
const SPARE: Duration = Duration::from_micros(100);

/// A running vehicle on its thread.
pub(super) struct Ticking<'a> {
    pub simulation: Box<Simulation>,
    /// Number of the run.
    pub epoch: u32,
    /// Dampers outside.
    pub lines: Option<&'a mut Lines>,
    pub control: &'a Control,
    pub orders: Receiver<Order>,
    pub notes: SyncSender<Note>,
    pub ticks: Sender<Tick>,
    beside: Beside,
    pending: Option<Order>,
    factor: f64,
    /// Simulated ticks that are due; below 1 in slow motion.
    due: f64,
    steps: u32,
    is_stopped: bool,
    is_slow: bool,
    total: u64,
}

/// A run that has ended.
pub(super) struct Ticked {
    pub simulation: Box<Simulation>,
    pub ending: Ending,
    /// Ticks of all runs.
    pub ticks: u64,
    /// Ticks that the thread that makes frames was too slow for.
    pub skipped: u64,
    /// True if somebody pressed the emergency stop, and the run ended because of it.
    pub is_stopped: bool,
}

impl<'a> Ticking<'a> {
    /// A vehicle at its start.
    pub fn new(
        simulation: Box<Simulation>,
        lines: Option<&'a mut Lines>,
        control: &'a Control,
        (orders, notes): (Receiver<Order>, SyncSender<Note>),
        ticks: Sender<Tick>,
    ) -> Self {
        control.set_factor(1.0);
        control.set_place(simulation.place());
        Self {
            simulation,
            epoch: 1,
            lines,
            control,
            orders,
            notes,
            ticks,
            beside: Beside::default(),
            pending: None,
            factor: 1.0,
            due: 0.0,
            steps: 0,
            is_stopped: false,
            is_slow: false,
            total: 0,
        }
    }

    /// Runs until the end.
    ///
    /// # Errors
    /// See [`Simulation::step`].
    pub fn run<C: Clock>(
        mut self,
        pacer: &mut Pacer<C>,
        is_unwanted: impl Fn() -> bool,
    ) -> Result<Ticked, VehicleRunError> {
        let mut tick = 0;
        let ending = loop {
            pacer.release(tick);
            tick += 1;
            self.control.set_late_ticks(pacer.report().missed_deadlines);
            if let Some(stop) = pacer.report().stopped {
                let run = self.simulation.run();
                break run.slow_tick(stop.tick, stop.work_ns, stop.limit_ns);
            }
            self.take_orders()?;
            if self.control.stop.takes() && self.stop() {
                break self.simulation.run().interrupted();
            }
            if (is_unwanted() || self.control.is_ending()) && !self.come_to_rest() {
                break self.simulation.run().interrupted();
            }
            if let Some(ending) = self.advance(pacer)? {
                break ending;
            }
        };
        pacer.end();
        Ok(Ticked {
            simulation: self.simulation,
            ending,
            ticks: self.total,
            skipped: self.ticks.skipped(),
            is_stopped: self.is_stopped,
        })
    }

    /// True if a damper is behind a link or on a rig.
    fn is_linked(&self) -> bool {
        self.lines.as_ref().is_some_and(|lines| lines.are_linked())
    }

    /// Asks the guards of rigs to come to rest; false if there is no rig.
    fn come_to_rest(&mut self) -> bool {
        match &mut self.lines {
            Some(lines) if lines.has_rig() => {
                lines.request_end();
                true
            }
            _ => false,
        }
    }

    /// Emergency stop. Returns true if the run ends at once: targets behind links cannot pause.
    fn stop(&mut self) -> bool {
        self.is_stopped = true;
        self.say(Note::Stopped);
        if self.come_to_rest() {
            return false;
        }
        self.set_factor(0.0);
        self.steps = 0;
        self.is_linked()
    }

    fn set_factor(&mut self, factor: f64) {
        self.factor = factor;
        self.due = 0.0;
        self.control.set_factor(factor);
    }

    fn say(&self, note: Note) {
        // The ring has room for a note of each order, and the other end outlives this thread.
        let _is_said = self.notes.try_send(note);
    }

    /// Takes over the orders that are due.
    fn take_orders(&mut self) -> Result<(), VehicleRunError> {
        loop {
            let order = match self.pending.take() {
                Some(order) => order,
                None => match self.orders.try_recv() {
                    Ok(order) => order,
                    Err(_) => return Ok(()),
                },
            };
            // A paused vehicle reaches no later tick.
            let now = self.simulation.place().tick;
            let is_early = matches!(&order, Order::Change { at, .. } if *at > now);
            if is_early && self.factor > 0.0 {
                self.pending = Some(order);
                return Ok(());
            }
            let spent = self.take(order)?;
            self.say(Note::Spent(spent));
        }
    }

    /// Takes over an order; returns what is left of it.
    fn take(&mut self, order: Order) -> Result<Order, VehicleRunError> {
        match order {
            Order::Change { ref change, .. } => {
                self.simulation.apply(change)?;
                self.beside.apply(change)?;
                Ok(order)
            }
            Order::Factor(factor) => {
                self.set_factor(factor);
                self.is_stopped &= factor == 0.0;
                Ok(order)
            }
            Order::Steps(steps) => {
                self.steps = self.steps.saturating_add(steps);
                Ok(order)
            }
            Order::Compare(simulation) => {
                let before = self.beside.replace(simulation, &self.simulation);
                Ok(Order::Compare(before))
            }
            Order::Copy(mut simulation) => {
                simulation.follow(&self.simulation);
                Ok(Order::Copy(simulation))
            }
            Order::Start {
                epoch,
                mut simulation,
            } => {
                std::mem::swap(&mut self.simulation, &mut simulation);
                self.epoch = epoch;
                (self.due, self.steps, self.is_stopped) = (0.0, 0, false);
                self.control.set_place(self.simulation.place());
                Ok(Order::Start { epoch, simulation })
            }
        }
    }

    /// Makes the ticks of the vehicle that are due in a tick of the pacer. Returns the end of the run.
    fn advance<C: Clock>(&mut self, pacer: &Pacer<C>) -> Result<Option<Ending>, VehicleRunError> {
        self.is_slow = false;
        let mut made = 0;
        self.due += self.factor;
        loop {
            let is_single = self.steps > 0;
            if self.simulation.ending().is_some() || (self.due < 1.0 && !is_single) {
                return Ok(None);
            }
            // Faster than real time, the vehicle gives up what it cannot make in time.
            if made > 0 && pacer.time_left() < SPARE {
                self.is_slow = self.due >= 1.0;
                self.due = self.due.min(1.0);
                return Ok(None);
            }
            match is_single {
                true => self.steps -= 1,
                false => self.due -= 1.0,
            }
            made += 1;
            if let Some(ending) = self.step(pacer)? {
                self.say(Note::Ended(ending.clone()));
                let is_over = self.simulation.run().is_over();
                if is_over || self.lines.is_some() {
                    return Ok(Some(ending));
                }
                // The vehicle waits for a reset.
                self.set_factor(0.0);
                self.steps = 0;
                return Ok(None);
            }
        }
    }

    /// Makes a tick of the vehicle.
    fn step<C: Clock>(&mut self, pacer: &Pacer<C>) -> Result<Option<Ending>, VehicleRunError> {
        let started = Instant::now();
        let run = self.simulation.run_mut();
        if let Some(lines) = &mut self.lines {
            lines.before(run)?;
        }
        self.beside.step(self.epoch, &mut self.ticks)?;
        self.simulation.step()?;
        let mut ending = self.simulation.ending().cloned();
        if let (Some(lines), None) = (&mut self.lines, &ending) {
            let time_left = || pacer.time_left();
            ending = lines.after(self.simulation.run_mut(), time_left);
        }
        let run = self.simulation.run();
        if ending.is_none() && run.is_over() {
            ending = Some(Ending::Completed);
        }
        self.total += 1;
        let mut found = 0;
        for (is_set, flag) in [
            (ending.is_some(), flags::ENDED),
            (self.is_stopped, flags::STOPPED),
            (self.is_slow || pacer.time_left().is_zero(), flags::SLOW),
        ] {
            found |= if is_set { flag } else { 0 };
        }
        let work_ns = started.elapsed().as_nanos() as u64;
        let epoch = (self.epoch, self.beside.comparison());
        let put = |tick: &mut Tick| tick.put(epoch, 0, run, work_ns, found);
        let sent = self.ticks.send_or_skip(put);
        self.control.set_place(self.simulation.place());
        // Without the thread that makes frames nobody sees the run any more.
        if sent.is_err() {
            self.control.end();
        }
        Ok(ending)
    }
}
