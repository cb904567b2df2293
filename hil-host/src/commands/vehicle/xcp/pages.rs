//! Parameters of the dampers on two pages: as new, and worn.

use std::sync::{Arc, Mutex, PoisonError};

use dashpot_core::xcp::ErrorCode;
use dashpot_files::case::Case;
use dashpot_files::damper::KeyedParameters;
use dashpot_host_link::a2l::Parameter;
use dashpot_host_link::xcp::Parameters;
use dashpot_live::{Action, ActionError, DamperDesk};
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::vehicle::{Law, Vehicle};
use dashpot_vehicle_run::Run;
use dashpot_vehicle_run::signals::slug;

use super::report::Calibration;
use super::slot::{Built, Slot};

/// Names of the pages.
pub(super) const PAGES: [&str; 2] = ["as new", "worn"];

/// Key of the wear, from 0 to 1, which the desk turns into parameters.
const WEAR: &str = "wear";

/// Changes that the report lists.
const MAX_LISTED: usize = 1000;

/// A damper of the vehicle and its parameters.
struct Keyed {
    index: usize,
    name: String,
    as_new: KeyedParameters,
    keys: Vec<&'static str>,
    /// Number of its first parameter.
    first: usize,
}

/// Changes, shared with the report.
pub(super) type Changes = Arc<Mutex<Vec<Calibration>>>;

/// The pages, and the dampers that are built from them.
pub(super) struct DamperPages {
    vehicle: Vehicle<KalkerBook>,
    dampers: Vec<Keyed>,
    values: [Vec<f64>; 2],
    page: usize,
    slot: Arc<Slot>,
    changes: Changes,
    time_s: f64,
}

impl DamperPages {
    /// The pages of all dampers that are simulated within the vehicle, and what a tool says of the parameters. The
    /// vehicle uses the first page.
    ///
    /// # Errors
    /// A damper that cannot be written as a file.
    pub fn new(
        case: &Case,
        run: &Run,
        external: &[usize],
        slot: &Arc<Slot>,
        changes: &Changes,
    ) -> Result<(Self, Vec<Parameter>), ActionError> {
        let mut pages = Self {
            vehicle: run.vehicle().clone(),
            dampers: Vec::new(),
            values: [Vec::new(), Vec::new()],
            page: 0,
            slot: Arc::clone(slot),
            changes: Arc::clone(changes),
            time_s: run.time_s(),
        };
        let mut described = Vec::new();
        for (index, element) in case.vehicle.dampers().enumerate() {
            let Law::Damper { parameters, .. } = &element.law else {
                continue;
            };
            if external.contains(&index) {
                continue;
            }
            let name = element.name.clone();
            let desk = DamperDesk::new(&name, parameters)?;
            let worn = desk.after(&Action::Damper {
                damper: name.clone(),
                key: WEAR.into(),
                value: 1.0,
            })?;
            let worn = KeyedParameters::new(&name, &*worn.parameters()?)?;
            let first = pages.values[0].len();
            let mut keys = Vec::new();
            let quantities = desk.quantities().into_iter();
            for quantity in quantities.filter(|quantity| quantity.key != WEAR) {
                keys.push(quantity.key);
                let [as_new, when_worn] = &mut pages.values;
                as_new.push(quantity.value);
                when_worn.push(worn.number(quantity.key)?);
                described.push(Parameter {
                    name: format!("{}.{}", slug(&name), quantity.key),
                    description: format!("{name}: {}", quantity.label),
                    unit: quantity.unit.into(),
                    min: quantity.min,
                    max: quantity.max,
                });
            }
            pages.dampers.push(Keyed {
                index,
                as_new: KeyedParameters::new(&name, parameters)?,
                name,
                keys,
                first,
            });
        }
        Ok((pages, described))
    }

    /// Builds the dampers whose values differ between two sets; an error is a value that is not allowed.
    fn built(&self, before: &[f64], after: &[f64]) -> Result<Vec<Built>, ErrorCode> {
        let differ = |damper: &&Keyed| damper.of(before) != damper.of(after);
        let built = self.dampers.iter().filter(differ).map(|damper| {
            let numbers: Vec<_> = damper
                .keys
                .iter()
                .copied()
                .zip(damper.of(after).iter().copied())
                .collect();
            let parameters = damper.as_new.with(&numbers).ok()?;
            let built = self.vehicle.build_damper(damper.index, &parameters).ok()?;
            Some((damper.index, Box::new(built)))
        });
        built.collect::<Option<_>>().ok_or(ErrorCode::OutOfRange)
    }

    /// Adds a change to the report.
    fn record(&self, change: Calibration) {
        let changes = self.changes.lock();
        let mut changes = changes.unwrap_or_else(PoisonError::into_inner);
        if changes.len() < MAX_LISTED {
            changes.push(change);
        }
    }

    fn record_values(&self, page: usize, before: &[f64]) {
        for damper in &self.dampers {
            let (old, new) = (damper.of(before), damper.of(&self.values[page]));
            let values = damper.keys.iter().zip(old.iter().zip(new));
            for (key, (_, value)) in values.filter(|(_, (old, new))| old != new) {
                self.record(Calibration::Value {
                    time_s: self.time_s,
                    page: PAGES[page],
                    damper: damper.name.clone(),
                    key,
                    value: *value,
                });
            }
        }
    }
}

impl Keyed {
    /// Its values of a page.
    fn of<'a>(&self, values: &'a [f64]) -> &'a [f64] {
        let last = self.first + self.keys.len();
        values.get(self.first..last).unwrap_or_default()
    }
}

impl Parameters for DamperPages {
    fn pages(&self) -> u8 {
        PAGES.len() as u8
    }

    fn values(&self, page: u8) -> &[f64] {
        self.values
            .get(usize::from(page))
            .map_or(&[], Vec::as_slice)
    }

    fn write(&mut self, page: u8, first: usize, values: &[f64]) -> Result<(), ErrorCode> {
        let page = usize::from(page);
        let before = self.values.get(page).ok_or(ErrorCode::PageNotValid)?;
        let mut after = before.clone();
        let changed = after.get_mut(first..first + values.len());
        changed
            .ok_or(ErrorCode::AccessDenied)?
            .copy_from_slice(values);
        // Not only the page in use is built, so that no page ever has values that are not allowed.
        let built = self.built(before, &after)?;
        let before = std::mem::replace(&mut self.values[page], after);
        if page == self.page && !built.is_empty() {
            self.slot.put(built);
        }
        self.record_values(page, &before);
        Ok(())
    }

    fn page(&self) -> u8 {
        self.page as u8
    }

    fn use_page(&mut self, page: u8) -> Result<(), ErrorCode> {
        let after = self
            .values
            .get(usize::from(page))
            .ok_or(ErrorCode::PageNotValid)?;
        let built = self.built(&self.values[self.page], after)?;
        if usize::from(page) == self.page {
            return Ok(());
        }
        self.page = page.into();
        self.slot.put(built);
        self.record(Calibration::Page {
            time_s: self.time_s,
            page: PAGES[self.page],
        });
        Ok(())
    }

    fn tick(&mut self, time_s: f64) {
        self.time_s = time_s;
    }
}
