//! Cases that outlast the irregularities of their track.

use dashpot_files::study::StudyFileError;
use dashpot_files::track::TrackParameters;
use dashpot_rail::track::Track;
use dashpot_vehicle_run::foreseen;

use super::study::Study;

/// Returns, for each sweep with such cases, how many there are and what the first of them would be warned of.
///
/// # Errors
/// A case cannot be built.
pub fn even_track(study: &Study) -> Result<Vec<String>, StudyFileError> {
    // Cases of one track differ in their seeds and speeds; the end of the irregularities is that of the first seed.
    let mut tracks: Vec<(TrackParameters, Track)> = Vec::new();
    let mut notes = Vec::new();
    for sweep in &study.parameters.sweeps {
        let mut found = Vec::new();
        for point in 0..sweep.points() {
            let seed = sweep.seeds.first().copied();
            let case = study.case_at(sweep, &sweep.values(point), seed)?;
            let known = tracks.iter().position(|(known, _)| *known == case.track);
            let index = match known {
                Some(index) => index,
                None => {
                    // The run of the case says why a track cannot be built.
                    let Ok(track) = case.track.build() else {
                        continue;
                    };
                    tracks.push((case.track.clone(), track));
                    tracks.len() - 1
                }
            };
            found.extend(foreseen(&case, &tracks[index].1));
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
