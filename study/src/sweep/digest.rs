//! Digests. The digest of a study's cases distinguishes its rows from those of other studies; the digest of a row's
//! cells reveals altered cells.

use std::fmt::Debug;

use sha2::{Digest as _, Sha256};

use dashpot_files::case::Case;
use dashpot_files::contact::ContactParameters;
use dashpot_files::input;
use dashpot_files::track::IrregularityParameters;
use dashpot_files::{FileError, study::StudyFileError};

/// Computes the digest of the cells of a row, without the cell of the digest itself: the first 16 hexadecimal digits of
/// the SHA-256 of the length and the text of each cell.
///
/// ```
/// use dashpot_study::sweep::digest_of_cells;
/// let digest = digest_of_cells(["0", "0.014"]);
/// assert_ne!(digest, digest_of_cells(["0", "9.014"]));
/// assert_ne!(digest, digest_of_cells(["00", ".014"]));
/// ```
pub fn digest_of_cells<'a>(cells: impl IntoIterator<Item = &'a str>) -> String {
    let mut digest = Digest::default();
    for cell in cells {
        digest.0.update((cell.len() as u64).to_le_bytes());
        digest.0.update(cell);
    }
    digest.hexadecimal()
}

/// SHA-256 of the values added.
#[derive(Default)]
pub(super) struct Digest(Sha256);

impl Digest {
    /// Adds the `Debug` text of a value, which is exact for numbers.
    pub fn add(&mut self, value: &impl Debug) {
        self.0.update(format!("{value:?}\n"));
    }

    /// Adds a case: its values, vehicle and track, independent of file names.
    ///
    /// # Errors
    /// Returns an error if the file of a measured irregularity cannot be read.
    pub fn add_case(&mut self, case: &Case) -> Result<(), StudyFileError> {
        let Case {
            name: _,
            vehicle,
            track,
            speed_m_per_s,
            duration_s,
            start_m,
            friction,
            contact,
            normal_damping_s_per_m,
            step_s,
            push_m,
            rails,
            faults,
            events,
        } = case;
        self.add(&(vehicle, rails, faults));
        // Rows that were kept before cases had events stay valid.
        if !events.is_empty() {
            self.add(events);
        }
        self.add(&(speed_m_per_s, duration_s, start_m, friction));
        self.add(&(normal_damping_s_per_m, step_s, push_m));
        self.add(&(&track.layout, &track.defects));
        // Rows that were kept before cases had a contact stay valid.
        if !contact.is_standard(vehicle) {
            self.add_contact(contact);
        }
        self.add_irregularity(&track.irregularity)
    }

    /// Adds an irregularity, independent of the name of its file.
    ///
    /// # Errors
    /// Returns an error if the file of a measured irregularity cannot be read.
    pub fn add_irregularity(
        &mut self,
        irregularity: &IrregularityParameters,
    ) -> Result<(), StudyFileError> {
        match irregularity {
            IrregularityParameters::Measured { file, options } => {
                let bytes =
                    input::read(file).map_err(|error: FileError| StudyFileError::File(error))?;
                self.add(options);
                self.0.update(bytes);
            }
            other => self.add(other),
        }
        Ok(())
    }

    /// Adds profiles, dimensions and friction, independent of the names of the profiles.
    pub fn add_contact(&mut self, contact: &ContactParameters) {
        for profile in contact.profiles() {
            self.add(&profile.points());
        }
        self.add(&contact.without_profiles());
    }

    /// Returns the first 16 hexadecimal digits.
    pub fn hexadecimal(self) -> String {
        dashpot_files::hexadecimal(&self.bytes()[..8])
    }

    /// Returns all bytes.
    pub fn bytes(self) -> [u8; 32] {
        self.0.finalize().into()
    }
}
