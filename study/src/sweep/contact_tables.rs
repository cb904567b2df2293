//! Contact tables computed ahead, in a folder that many processes read.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use dashpot_rail::contact::Tables;

use dashpot_files::FileError;
use dashpot_files::case::Case;
use dashpot_files::output::write_bytes;
use dashpot_vehicle_run::contact::{ContactSetup, WheelOnRail};
use dashpot_vehicle_run::{Run, VehicleRunError};

/// Folder with one file per distinct pair of wheel and rail. The name of a file is the digest of everything that its
/// tables depend on; the file has a checksum and the version of its format.
#[derive(Debug, Clone)]
pub struct ContactTables {
    folder: PathBuf,
}

/// File of contact tables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TablesFile {
    /// Path.
    pub path: PathBuf,
    /// Length, bytes.
    pub bytes: usize,
    /// True if the tables were computed now, false if the file had them.
    pub is_new: bool,
}

/// Error from a folder of contact tables.
#[derive(Debug, thiserror::Error)]
pub enum ContactTablesError {
    /// The folder lacks a file.
    #[error("{}: no contact tables of a wheel and rail of this run", .path.display())]
    Missing {
        /// Path that the file would have.
        path: PathBuf,
    },
    /// A file is damaged, or was written by another version.
    #[error("{}: {source}", .path.display())]
    Invalid {
        /// Path of the file.
        path: PathBuf,
        /// Reason.
        source: VehicleRunError,
    },
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The profiles do not fit each other.
    #[error(transparent)]
    Contact(#[from] VehicleRunError),
}

impl ContactTables {
    /// Tables in a folder, which must exist before tables are computed.
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
        }
    }

    /// Reads the tables of a pair.
    ///
    /// # Errors
    /// The file is missing, damaged, of another version or cannot be read.
    pub fn read(&self, pair: &WheelOnRail) -> Result<Arc<Tables>, ContactTablesError> {
        let path = self.folder.join(pair.tables_file_name()?);
        let bytes = match fs::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(ContactTablesError::Missing { path });
            }
            bytes => bytes.map_err(|error| FileError::read(&path, error))?,
        };
        pair.tables_from(&bytes)
            .map_err(|source| ContactTablesError::Invalid { path, source })
    }

    /// Places the vehicle of a case at its start.
    ///
    /// # Errors
    /// Same errors as [`Self::read`] and [`Run::new`].
    pub fn run(&self, case: &Case) -> Result<Run, ContactTablesError> {
        let setup = ContactSetup::of_case(case).map_err(VehicleRunError::from)?;
        let sources = setup.pairs().iter().map(|pair| self.read(pair));
        let contacts = setup.contacts(&sources.collect::<Result<Vec<_>, _>>()?)?;
        let track = case.track.build().map_err(VehicleRunError::from)?;
        Ok(Run::on(case, contacts, Arc::new(track))?)
    }

    /// Computes the tables of a pair into its file, unless the file has them.
    ///
    /// # Errors
    /// The file cannot be written, or the profiles do not fit each other.
    pub fn compute(&self, pair: &WheelOnRail) -> Result<TablesFile, ContactTablesError> {
        let path = self.folder.join(pair.tables_file_name()?);
        let known = fs::read(&path).ok();
        let known = known.filter(|bytes| pair.tables_from(bytes).is_ok());
        let is_new = known.is_none();
        let bytes = match known {
            Some(bytes) => bytes,
            None => pair.computed()?.to_bytes(),
        };
        if is_new {
            write_bytes(&path, &bytes)?;
        }
        Ok(TablesFile {
            bytes: bytes.len(),
            path,
            is_new,
        })
    }
}
