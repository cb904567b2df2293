//! Other runs than the one that goes on: at the start, from a saved state, and as new beside it.

use std::time::{Duration, Instant};

use dashpot_live::{ActionError, Desk, Observer, Saved, Simulation, Subject};

use super::DeskSide;
use crate::commands::live::source::Source;
use crate::commands::live::vehicle::order::Order;

/// How long the real-time thread may take to copy a run: many ticks.
const PATIENCE: Duration = Duration::from_secs(2);

/// Time between two looks at what it says.
const POLL: Duration = Duration::from_millis(1);

/// A run at its start, with what follows it.
struct Started {
    desk: Desk,
    observer: Observer,
    simulation: Box<Simulation>,
}

impl DeskSide {
    /// Returns to the start, without actions.
    ///
    /// # Errors
    /// A damper is outside, or the vehicle cannot run.
    pub(super) fn reset(&mut self) -> Result<(), String> {
        self.refuse_with_outside("a reset")?;
        let started = self.started().map_err(|error| error.to_string())?;
        self.replace_by(started)
    }

    /// Goes on from a saved state.
    ///
    /// # Errors
    /// A damper is outside, or the state is not one of this case.
    pub(super) fn load(&mut self, text: &str) -> Result<(), String> {
        self.refuse_with_outside("another state")?;
        let saved = Saved::read(text).map_err(|error| error.to_string())?;
        if *saved.subject() != self.subject() {
            return Err(
                "the state is of another case; start dashpot live with the options of the run that it was saved in"
                    .into(),
            );
        }
        let started = self.started().and_then(|mut started| {
            saved.restore(&mut started.desk, &mut started.simulation)?;
            Ok(started)
        });
        self.replace_by(started.map_err(|error| error.to_string())?)
    }

    /// Saves the state of the run and of the desk.
    ///
    /// # Errors
    /// A damper is outside, whose state nobody knows, or the run has ended.
    pub(super) fn save(&mut self) -> Result<String, String> {
        self.refuse_with_outside("saving its state")?;
        let copy = self.as_changed().map_err(|error| error.to_string())?;
        self.copied = None;
        self.order(Order::Copy(copy))?;
        let asked = Instant::now();
        let copied = loop {
            self.look_after();
            match self.copied.take() {
                Some(copied) => break copied,
                None if asked.elapsed() < PATIENCE => std::thread::sleep(POLL),
                None => return Err("the run did not give its state in time; try again".into()),
            }
        };
        let saved = Saved::new(self.subject(), &self.desk, &copied);
        let text = saved.and_then(|saved| saved.text());
        text.map_err(|error| error.to_string())
    }

    /// Lets the vehicle as new begin where the vehicle is, or takes it away.
    ///
    /// # Errors
    /// A damper is outside, or the run has ended.
    pub(super) fn compare(&mut self, on: bool) -> Result<(), String> {
        let as_new = match on {
            true => {
                self.refuse_with_outside("the vehicle as new beside it")?;
                Some(self.as_new().map_err(|error| error.to_string())?)
            }
            false => None,
        };
        self.order(Order::Compare(as_new))?;
        self.is_comparing = on;
        Ok(())
    }

    fn refuse_with_outside(&self, what: &str) -> Result<(), String> {
        match self.outside.dampers.is_empty() {
            true => Ok(()),
            false => Err(format!(
                "{what} is not possible with a damper outside; allowed: act, run, record, stop"
            )),
        }
    }

    /// What a saved state belongs to.
    fn subject(&self) -> Subject {
        Subject::of_case(self.desk.case())
    }

    fn started(&self) -> Result<Started, ActionError> {
        let (run, case) = (self.built.run()?, self.built.case());
        let desk = Desk::new(case, &run)?;
        Ok(Started {
            observer: Observer::new(&desk, &run)?,
            desk,
            simulation: Box::new(Simulation::new(case, run)),
        })
    }

    /// A run at its start, with the dampers and the track of the desk.
    fn as_changed(&self) -> Result<Box<Simulation>, ActionError> {
        let mut simulation = Simulation::new(self.built.case(), self.built.run()?);
        for change in self.desk.changes()? {
            simulation.apply(&change)?;
        }
        Ok(Box::new(simulation))
    }

    /// The same with every damper as new.
    fn as_new(&self) -> Result<Box<Simulation>, ActionError> {
        let mut simulation = self.as_changed()?;
        for change in self.desk.dampers_as_new()? {
            simulation.apply(&change)?;
        }
        Ok(simulation)
    }

    /// Goes on with another run, with the vehicle as new beside it if it was there.
    fn replace_by(&mut self, started: Started) -> Result<(), String> {
        let was_comparing = self.is_comparing;
        if was_comparing {
            self.compare(false)?;
        }
        self.epoch += 1;
        self.observed.set_next(self.epoch, started.observer);
        self.order(Order::Start {
            epoch: self.epoch,
            simulation: started.simulation,
        })?;
        self.desk = started.desk;
        if was_comparing {
            self.compare(true)?;
        }
        // The end had paused the run; the operator may have paused it too, and then it stays so.
        match self.ended.take() {
            Some(_) => self.set_factor(1.0),
            None => Ok(()),
        }
    }
}
