//! Tables of a track file.

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

/// Invalid table.
struct TableError {
    /// Byte offset of the table in the text.
    offset: usize,
    reason: String,
}

/// Converts each table, or returns the error of the first invalid one.
fn convert_all<T, U>(
    tables: &[Spanned<T>],
    convert: impl Fn(&T) -> Result<U, String>,
    place: fn(usize) -> Place,
) -> Result<Vec<U>, TableError> {
    let numbered = tables.iter().zip(1..);
    let converted = numbered.map(|(table, number)| {
        convert(table.get_ref()).map_err(|reason| TableError {
            offset: table.span().start,
            reason: format!("{}: {reason}", place(number)),
        })
    });
    converted.collect()
}

/// Byte offset of the table with this number, from 1.
fn offset_of<T>(tables: &[Spanned<T>], number: usize) -> usize {
    let table = tables.get(number.wrapping_sub(1));
    table.map_or(0, |table| table.span().start)
}

impl TrackTables {
    /// Converts the tables parsed from `text`; error messages call the text `file`, and file names are relative to
    /// `folder`.
    pub fn parameters(
        self,
        file: &Path,
        text: &str,
        folder: &Path,
    ) -> Result<TrackParameters, FileError> {
        let in_table = |TableError { offset, reason }: TableError| {
            FileError::in_line(file, line_at(text, offset), reason)
        };
        let invalid = |error: TrackError| {
            let offset = match &error {
                TrackError::OutOfBounds { place, .. }
                | TrackError::TransitionAtEnd { place }
                | TrackError::NeedlessTransition { place }
                | TrackError::CantJump { place, .. } => match *place {
                    Place::Part(number) => offset_of(&self.part, number),
                    Place::Defect(number) => offset_of(&self.defect, number),
                    _ => 0,
                },
                _ => 0,
            };
            FileError::in_line(file, line_at(text, offset), error)
        };
        let parts = convert_all(&self.part, PartTable::part, Place::Part).map_err(in_table)?;
        let defects =
            convert_all(&self.defect, DefectTable::defect, Place::Defect).map_err(in_table)?;
        let layout = Layout::new(&parts).map_err(invalid)?;
        // This check is here because the lines are known only here.
        let track = Track::new(layout, Irregularity::default(), defects).map_err(invalid)?;
        let (mut irregularity, mut irregularity_line) = (IrregularityParameters::None, 1);
        if let Some(table) = self.irregularity {
            let offset = table.span().start;
            irregularity_line = line_at(text, offset);
            irregularity = table.into_inner().parameters(folder).map_err(|reason| {
                let reason = format!("{}: {reason}", Place::Irregularity);
                in_table(TableError { offset, reason })
            })?;
        }
        Ok(TrackParameters {
            name: self.name,
            layout: track.layout().clone(),
            defects: track.defects().to_vec(),
            gauge_changes: Vec::new(),
            friction_ratios: Vec::new(),
            irregularity,
            file: file.to_owned(),
            irregularity_line,
        })
    }
}
