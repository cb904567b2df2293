//! An external damper on a rig, whose actuator follows the vehicle.

mod end;
pub(in crate::commands) mod options;
pub(in crate::commands) mod reasons;
mod remote;
mod report;
mod samples;
mod section;

use dashpot_core::hybrid::HybridStatus;
use dashpot_files::case::Case;
use dashpot_hybrid::rig::{RigError, VirtualRig};
use dashpot_hybrid::{Coupling, Specimen};
use dashpot_vehicle_run::{Ending, Run};

use end::RigEnd;
pub(super) use options::{RigArguments, RigOptions};
use reasons::reasons;
use remote::RemoteRig;
pub(in crate::commands) use report::Datagrams;
pub(in crate::commands) use report::RigReport;
use samples::{MAX_SAMPLES, Sample};
pub(in crate::commands::vehicle) use samples::{Samples, write};
pub(in crate::commands::vehicle) use section::{indices, section};

use super::force::set_force_n;
use super::named_damper::named_damper;
use crate::commands::failure::{Failure, Outcome};

/// Why the test ends when the rig says that it follows no command.
const RIG_HOLDS: &str = "the rig holds its displacement and follows no command";

/// A damper on a rig.
pub(super) struct RigLine {
    name: String,
    damper: usize,
    options: RigOptions,
    coupling: Coupling,
    rig: RigEnd,
    ticks: u64,
    status: HybridStatus,
    samples: Samples,
    /// Time at which the guard acted, s.
    guarded_s: Option<f64>,
}

impl RigLine {
    /// Mounts a damper of the vehicle on the rig at `address` (HOST:PORT), or on a virtual one in this process.
    ///
    /// # Errors
    /// A setting is outside its range for the step of the case, or the rig does not answer.
    pub(super) fn new(
        options: &RigOptions,
        damper: usize,
        case: &Case,
        address: Option<&str>,
        hold: (bool, Option<u64>),
    ) -> Outcome<Self> {
        let (is_realtime, hold_ticks) = hold;
        let (name, parameters) = named_damper(case, damper)?;
        let parameters = parameters.clone().check()?;
        let actuator = &options.actuator;
        let refused =
            |error: RigError| Failure::wrong_use(format!("--actuator {}: {error}", actuator.name));
        let specimen = Specimen::nominal(&parameters);
        let compensation = dashpot_hybrid::Compensation::from(options.compensate);
        let compensator = compensation
            .build(actuator, &specimen, case.step_s)
            .map_err(|error| refused(error.into()))?;
        let mut settings = options::transfer_settings(&actuator.limits, options.without_guard);
        if let Some(ticks) = hold_ticks {
            settings.guard.age_s = (ticks as f64 * case.step_s) as f32;
        }
        let mut coupling = Coupling::new(compensator, &settings, case.step_s)
            .map_err(|error| refused(error.into()))?;
        let rig = match address {
            None => {
                let rig = VirtualRig::new(actuator, &parameters, case.step_s, options.seed);
                let mut rig = rig.map_err(&refused)?;
                let first = rig.tick(0.0);
                RigEnd::Virtual(Box::new(rig), first)
            }
            Some(address) => {
                let (rig, first) = RemoteRig::open(address, case.step_s, is_realtime)?;
                coupling.transfer().place(first.displacement_m);
                RigEnd::Remote(rig)
            }
        };
        Ok(Self {
            name: name.to_owned(),
            damper,
            coupling,
            rig,
            ticks: 0,
            status: HybridStatus::empty(),
            options: options.clone(),
            samples: Samples {
                damper: name.to_owned(),
                rows: Vec::with_capacity(
                    MAX_SAMPLES.min((case.duration_s / case.step_s) as usize + 1),
                ),
            },
            guarded_s: None,
        })
    }

    /// Sends the command for the displacement of this tick, and applies the measured force from the next tick on.
    /// Returns an ending when the guard has brought the command to rest.
    pub(super) fn exchange(&mut self, run: &mut Run) -> Option<Ending> {
        let time_s = run.time_s();
        let displacement_m = run.state().damper_displacements_m()[self.damper];
        let measured = self.rig.receive();
        if self.rig.is_held() {
            self.request_end();
        }
        let tick = self.coupling.tick(displacement_m, measured);
        let command = tick.command;
        // A guard passes finite forces only.
        let _ = set_force_n(run, self.damper, f64::from(command.force_n));
        let transfer = self.coupling.transfer();
        let tracking = transfer.tracking();
        let sample = Sample {
            time_s,
            desired_m: tick.desired_m,
            command_m: command.command_m,
            measured_m: measured.map_or(f32::NAN, |measured| measured.displacement_m),
            force_n: command.force_n,
            delay_s: tracking.delay_s,
            amplitude: tracking.amplitude,
            relative_error: tracking.relative_error,
            added_j: transfer.energy().added_j(),
            status: command.status,
        };
        self.ticks += 1;
        self.status = command.status;
        if self.samples.rows.len() < self.samples.rows.capacity() {
            self.samples.rows.push(sample);
        }
        let ending = command.status & HybridStatus::ENDING;
        if !ending.is_empty() {
            self.guarded_s.get_or_insert(time_s);
        }
        let is_over = transfer.guard().is_held();
        self.rig.send(time_s, command.command_m);
        is_over.then(|| {
            let is_held = self.rig.is_held();
            let asked = match is_held {
                true => HybridStatus::REQUESTED,
                false => HybridStatus::empty(),
            };
            let seen = reasons(ending - asked).into_iter();
            let held = is_held.then_some(RIG_HOLDS);
            let reasons = seen.chain(held).map(str::to_owned).collect();
            run.guard_ended(&self.name, reasons, self.guarded_s.unwrap_or(time_s))
        })
    }

    /// Asks the guard to bring the command to rest.
    pub(super) fn request_end(&mut self) {
        self.coupling
            .transfer()
            .guard()
            .end(HybridStatus::REQUESTED);
    }

    /// Ends the session.
    pub(super) fn stop(&mut self, time_s: f64) {
        self.rig.stop(time_s);
    }

    /// Returns the report and the signals.
    pub(super) fn finish(self) -> (RigReport, Samples) {
        (RigReport::new(&self), self.samples)
    }
}
