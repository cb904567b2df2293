//! The tables of a track file.

use std::path::Path;

use dashpot_rail::track::{Irregularity, Layout, Place, Track, TrackError};
use serde::Deserialize;
use toml::Spanned;

use super::TrackParameters;
use super::defect::DefectTable;
use super::irregularity::{IrregularityParameters, IrregularityTable};
use super::part::PartTable;
use crate::FileError;
use crate::lines::line_at;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TrackTables {
    name: String,
    part: Vec<Spanned<PartTable>>,
    irregularity: Option<Spanned<IrregularityTable>>,
    #[serde(default)]
    defect: Vec<Spanned<DefectTable>>,
}

/// What each table gives, or the line and the number of the one that gives nothing.
fn each<T, U>(
    tables: &[Spanned<T>],
    of: impl Fn(&T) -> Result<U, String>,
    place: fn(usize) -> Place,
) -> Result<Vec<U>, (usize, String)> {
    let numbered = tables.iter().zip(1..);
    let given = numbered.map(|(table, number)| {
        of(table.get_ref()).map_err(|reason| {
            let reason = format!("{}: {reason}", place(number));
            (table.span().start, reason)
        })
    });
    given.collect()
}

/// Where the table of a place begins.
fn start_of<T>(tables: &[Spanned<T>], number: usize) -> usize {
    let table = tables.get(number.wrapping_sub(1));
    table.map_or(0, |table| table.span().start)
}

impl TrackTables {
    /// What the tables say; `file` stands for their `text` in errors, and files count from `folder`.
    pub fn parameters(
        self,
        file: &Path,
        text: &str,
        folder: &Path,
    ) -> Result<TrackParameters, FileError> {
        let in_table = |(offset, reason)| FileError::in_line(file, line_at(text, offset), reason);
        let wrong = |error: TrackError| {
            let offset = match &error {
                TrackError::OutOfBounds { place, .. }
                | TrackError::TransitionAtEnd { place }
                | TrackError::NeedlessTransition { place }
                | TrackError::CantJump { place, .. } => match *place {
                    Place::Part(number) => start_of(&self.part, number),
                    Place::Defect(number) => start_of(&self.defect, number),
                    _ => 0,
                },
                _ => 0,
            };
            FileError::in_line(file, line_at(text, offset), error)
        };
        let parts = each(&self.part, PartTable::part, Place::Part).map_err(in_table)?;
        let defects = each(&self.defect, DefectTable::defect, Place::Defect).map_err(in_table)?;
        let layout = Layout::new(&parts).map_err(wrong)?;
        // Both are checked here, where their lines are known.
        let track = Track::new(layout, Irregularity::default(), defects).map_err(wrong)?;
        let (mut irregularity, mut irregularity_line) = (IrregularityParameters::None, 1);
        if let Some(table) = self.irregularity {
            let offset = table.span().start;
            irregularity_line = line_at(text, offset);
            irregularity = table.into_inner().parameters(folder).map_err(|reason| {
                in_table((offset, format!("{}: {reason}", Place::Irregularity)))
            })?;
        }
        Ok(TrackParameters {
            name: self.name,
            layout: track.layout().clone(),
            defects: track.defects().to_vec(),
            irregularity,
            file: file.to_owned(),
            irregularity_line,
        })
    }
}
