//! What the cases of a study share: contacts and tracks, each made once.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use dashpot_rail::contact::{Tables, WheelsetContact};
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::Track;

use dashpot_files::case::Case;
use dashpot_files::track::TrackParameters;
use dashpot_vehicle_run::contact::{self, ContactOf};
use dashpot_vehicle_run::{Run, VehicleRunError};

/// Tracks that are kept; half a megabyte a kilometre.
const TRACKS: usize = 64;

/// Contacts that are kept, and their tables, some 43 MB each.
const CONTACTS: usize = 16;
const TABLES: usize = 4;

type Contact = Arc<WheelsetContact<KalkerBook>>;

/// Contacts and tracks of cases that have been run.
#[derive(Default)]
pub struct Shared {
    tables: Kept<[f64; 2], Arc<Tables>>,
    contacts: Kept<ContactOf, Contact>,
    tracks: Kept<TrackParameters, Arc<Track>>,
}

impl Shared {
    /// The vehicle of a case at its start.
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn run(&self, case: &Case) -> Result<Run, VehicleRunError> {
        let of = ContactOf::new(&case.vehicle, case.friction, case.normal_damping_s_per_m)?;
        let contact = self.contacts.get(CONTACTS, of, |of| {
            let tables = self
                .tables
                .get(TABLES, of.geometry_key(), |_| of.tables())?;
            contact::with(tables, of)
        })?;
        let track = self.tracks.get(TRACKS, case.track.clone(), |track| {
            track.build().map(Arc::new)
        })?;
        Run::on(case, contact, track)
    }
}

/// What is made of keys, the last ones asked for.
struct Kept<K, V>(Mutex<Vec<Entry<K, V>>>);

/// Made by whoever asks first, while others wait.
type Entry<K, V> = (K, Arc<Mutex<Option<V>>>);

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: PartialEq + Clone, V: Clone> Kept<K, V> {
    fn get<E>(&self, most: usize, key: K, make: impl FnOnce(&K) -> Result<V, E>) -> Result<V, E> {
        let place = {
            let mut entries = held(&self.0);
            let found = entries.iter().position(|(other, _)| *other == key);
            let entry = match found {
                Some(found) => entries.remove(found),
                None => (key.clone(), Arc::default()),
            };
            if entries.len() >= most {
                entries.remove(0);
            }
            let place = entry.1.clone();
            entries.push(entry);
            place
        };
        let mut made = held(&place);
        if let Some(made) = &*made {
            return Ok(made.clone());
        }
        let new = make(&key)?;
        *made = Some(new.clone());
        Ok(new)
    }
}

fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
