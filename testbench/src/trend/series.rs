//! Recordings of one damper in order: those of a position between two changes of the serial number.

use std::collections::BTreeMap;

use super::axis::Axis;
use super::reading::{Estimation, Recorded, Refusal};
use super::recordings::Listed;

/// Recordings of one damper.
#[derive(Clone, Debug)]
pub struct Series {
    /// In order of date or mileage; not empty.
    pub recordings: Vec<Listed>,
    /// True if no later recording is of another damper at this position.
    pub is_installed: bool,
}

/// Sorts recordings into series; also returns those that have no place on the axis.
pub fn series(listed: Vec<Listed>, axis: Axis) -> (Vec<Series>, Vec<Recorded>) {
    let mut positions: BTreeMap<(String, String), Vec<(f64, Listed)>> = BTreeMap::new();
    let mut unplaced = Vec::new();
    for listed in listed {
        match axis.of(&listed) {
            Some(x) => {
                let position = (listed.vehicle.clone(), listed.damper.clone());
                positions.entry(position).or_default().push((x, listed));
            }
            None => unplaced.push(Recorded {
                listed,
                reading: None,
                refusal: Some(Refusal::Unusable(axis.missing().into())),
            }),
        }
    }
    let mut found: Vec<Series> = Vec::new();
    for mut recordings in positions.into_values() {
        recordings.sort_by(|(x, a), (y, b)| x.total_cmp(y).then_with(|| a.file.cmp(&b.file)));
        let mut lives: Vec<Series> = Vec::new();
        for (_, listed) in recordings {
            let open = lives.last_mut().filter(|life| {
                let first = life.recordings.first();
                first.is_some_and(|first| first.serial_number == listed.serial_number)
            });
            match open {
                Some(life) => life.recordings.push(listed),
                None => lives.push(Series {
                    recordings: vec![listed],
                    is_installed: false,
                }),
            }
        }
        if let Some(last) = lives.last_mut() {
            last.is_installed = true;
        }
        found.append(&mut lives);
    }
    (found, unplaced)
}

/// Estimates all series on `threads` threads, in their order; `on_done` is called after each with its number of
/// recordings.
pub fn estimate(
    series: &[Series],
    estimation: &Estimation,
    threads: usize,
    on_done: impl FnMut(u64),
) -> Vec<Vec<Recorded>> {
    estimate_cancellable(series, estimation, threads, on_done, &|| false)
}

/// Like [`estimate`]; recordings that have not begun when `is_unwanted` returns true are left out.
pub fn estimate_cancellable(
    series: &[Series],
    estimation: &Estimation,
    threads: usize,
    mut on_done: impl FnMut(u64),
    is_unwanted: &(dyn Fn() -> bool + Sync),
) -> Vec<Vec<Recorded>> {
    let mut found: Vec<Vec<Recorded>> = series.iter().map(|_| Vec::new()).collect();
    let work = |series: &Series, _: &dyn Fn() -> bool| {
        estimation.readings_cancellable(&series.recordings, is_unwanted)
    };
    let outcome: Result<(), std::convert::Infallible> =
        dashpot_workers::in_parallel(series, threads, work, |index, readings| {
            on_done(readings.len() as u64);
            if let Some(place) = found.get_mut(index) {
                *place = readings;
            }
            Ok(())
        });
    let Ok(()) = outcome;
    found
}
