//! Contacts and tracks shared by the cases of a study; each is built once.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use dashpot_rail::contact::{NotTheseTables, Tables};
use dashpot_rail::track::Track;

use super::contact_tables::{ContactTables, ContactTablesError};
use dashpot_files::FileError;
use dashpot_files::case::Case;
use dashpot_files::track::TrackParameters;
use dashpot_vehicle_run::contact::{Contact, ContactSetup, WheelOnRail};
use dashpot_vehicle_run::{Run, VehicleRunError};

/// Maximum number of cached tracks; each takes half a megabyte per kilometre.
const MAX_TRACKS: usize = 64;

/// Maximum number of cached contacts.
const MAX_CONTACTS: usize = 16;
/// Maximum number of cached contact tables; each takes 4 to 5 MB. A locomotive whose twelve wheels differ needs twelve.
const MAX_TABLES: usize = 12;

/// Cache of the contacts and tracks of recent cases.
#[derive(Default)]
pub struct Shared {
    tables: Cache<WheelOnRail, Arc<Tables>>,
    contacts: Cache<ContactSetup, Vec<Contact>>,
    tracks: Cache<TrackParameters, Arc<Track>>,
    /// Folder of tables computed ahead; otherwise the user's cache folder.
    ahead: Option<ContactTables>,
}

impl Shared {
    /// Takes contact tables from a folder of tables computed ahead only, once all were found valid.
    ///
    /// # Errors
    /// Tables of one of `pairs` are missing or invalid.
    pub fn with_tables(
        ahead: ContactTables,
        pairs: &[WheelOnRail],
    ) -> Result<Self, ContactTablesError> {
        for pair in pairs {
            ahead.read(pair)?;
        }
        Ok(Self {
            ahead: Some(ahead),
            ..Self::default()
        })
    }

    fn tables(&self, pair: &WheelOnRail) -> Result<Arc<Tables>, VehicleRunError> {
        match &self.ahead {
            Some(ahead) => ahead.read(pair).map_err(|error| match error {
                ContactTablesError::Contact(error) => error,
                // The file was valid when the run began.
                _ => VehicleRunError::Tables(NotTheseTables),
            }),
            None => pair.tables(),
        }
    }

    /// Places the vehicle of a case at its start.
    ///
    /// # Errors
    /// Same errors as [`Run::new`].
    pub fn run(&self, case: &Case) -> Result<Run, VehicleRunError> {
        let setup = ContactSetup::of_case(case)?;
        let contacts = self.contacts.get(MAX_CONTACTS, setup, |setup| {
            let tables = setup.pairs().iter().map(|pair| {
                self.tables
                    .get(MAX_TABLES, pair.clone(), |pair| self.tables(pair))
            });
            setup.contacts(&tables.collect::<Result<Vec<_>, _>>()?)
        })?;
        Run::on(case, contacts, self.track(case)?)
    }

    /// Returns the track of a case.
    ///
    /// # Errors
    /// Same errors as [`TrackParameters::build`].
    pub fn track(&self, case: &Case) -> Result<Arc<Track>, FileError> {
        self.tracks.get(MAX_TRACKS, case.track.clone(), |track| {
            track.build().map(Arc::new)
        })
    }
}

/// Values built from keys; keeps the most recently used ones.
struct Cache<K, V>(Mutex<Vec<Entry<K, V>>>);

/// Value of a key. The first thread that needs the value builds it; other threads wait meanwhile.
struct Entry<K, V> {
    key: K,
    slot: Arc<Mutex<Option<V>>>,
}

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: PartialEq + Clone, V: Clone> Cache<K, V> {
    /// Returns the value of `key`, which it builds if necessary. If there are more than `max_entries` values, it drops
    /// the least recently used one.
    fn get<E>(
        &self,
        max_entries: usize,
        key: K,
        build: impl FnOnce(&K) -> Result<V, E>,
    ) -> Result<V, E> {
        let slot = {
            let mut entries = lock(&self.0);
            let found = entries.iter().position(|entry| entry.key == key);
            let entry = match found {
                Some(found) => entries.remove(found),
                None => Entry {
                    key: key.clone(),
                    slot: Arc::default(),
                },
            };
            if entries.len() >= max_entries {
                entries.remove(0);
            }
            let slot = entry.slot.clone();
            entries.push(entry);
            slot
        };
        let mut value = lock(&slot);
        if let Some(value) = &*value {
            return Ok(value.clone());
        }
        let built = build(&key)?;
        *value = Some(built.clone());
        Ok(built)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
