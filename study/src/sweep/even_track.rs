//! Cases that outlast the irregularities of their track.

use dashpot_files::study::StudyFileError;
use dashpot_vehicle_run::foreseen;

use super::shared::Shared;
use super::study::Study;

/// Returns, for each sweep with such cases, how many there are and what the first of them would be warned of. Looks at
/// the first seed only: the end of the irregularities does not depend on it.
///
/// # Errors
/// A case or its track cannot be built.
pub fn even_track(study: &Study, shared: &Shared) -> Result<Vec<String>, StudyFileError> {
    let mut notes = Vec::new();
    for sweep in &study.parameters.sweeps {
        let mut found = Vec::new();
        for point in 0..sweep.points() {
            let seed = sweep.seeds.first().copied();
            let case = study.case_at(sweep, &sweep.values(point), seed)?;
            let track = shared.track(&case).map_err(StudyFileError::File)?;
            found.extend(foreseen(&case, &track));
        }
        if let Some(first) = found.first() {
            notes.push(format!(
                "sweep {}, {} of {} combinations of values: {first}",
                sweep.name,
                found.len(),
                sweep.points()
            ));
        }
    }
    Ok(notes)
}
