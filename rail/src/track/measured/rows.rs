//! Header and rows of a file.

use super::MeasuredTrackError;

/// Allowed column names.
const ALLOWED: &str =
    "distance_m, and vertical, lateral, cross_level and gauge, each with _m or _mm";
const CHANNELS: [&str; 4] = ["vertical", "lateral", "cross_level", "gauge"];
/// Maximum magnitude of a distance, m.
const MAX_DISTANCE_M: f64 = 1e7;
/// Maximum magnitude of a deviation, m. A larger value is probably in mm in a column in m.
const MAX_DEVIATION_M: f64 = 0.5;

/// A row of the file.
pub(super) struct Row {
    /// Line, counted from 1.
    pub line: u64,
    pub distance_m: f64,
    /// Deviations in the order vertical, lateral, cross level, gauge; zero for missing columns.
    pub deviations_m: [f64; 4],
}

/// A column of the file.
struct Column {
    name: String,
    /// Index of the channel; `None` for the distance.
    channel: Option<usize>,
    /// Unit, m.
    unit_m: f64,
}

impl Column {
    /// Returns the column called `name`.
    fn parse(name: &str) -> Option<Self> {
        let (stem, unit_m) = match name.strip_suffix("_mm") {
            Some(stem) => (stem, 1e-3),
            None => (name.strip_suffix("_m")?, 1.0),
        };
        let channel = match stem {
            "distance" if unit_m == 1.0 => None,
            _ => Some(CHANNELS.iter().position(|channel| *channel == stem)?),
        };
        Some(Self {
            name: name.to_owned(),
            channel,
            unit_m,
        })
    }
}

/// Reads all rows. The second result states which of the four channels the file contains.
///
/// Cells contain only names and numbers, so quotes cannot hide commas or line ends. Quotes around a cell are removed.
pub(super) fn read(text: &str) -> Result<(Vec<Row>, [bool; 4]), MeasuredTrackError> {
    let lines = (1..).zip(text.lines().map(str::trim));
    let lines = lines.filter(|(_, content)| !content.is_empty() && !content.starts_with('#'));
    let mut columns: Option<Vec<Column>> = None;
    let mut rows = Vec::new();
    for (line, content) in lines {
        let cells: Vec<&str> = content
            .split(',')
            .map(|cell| cell.trim().trim_matches('"').trim())
            .collect();
        match &columns {
            None => columns = Some(header(line, &cells)?),
            Some(columns) => rows.push(row(line, &cells, columns)?),
        }
    }
    let columns = columns.ok_or_else(|| missing(1, "none"))?;
    let has = std::array::from_fn(|k| columns.iter().any(|column| column.channel == Some(k)));
    Ok((rows, has))
}

fn missing(line: u64, found: &str) -> MeasuredTrackError {
    MeasuredTrackError::Missing {
        line,
        found: found.to_owned(),
        allowed: "vertical, lateral, cross_level, gauge, each with _m or _mm",
    }
}

fn header(line: u64, cells: &[&str]) -> Result<Vec<Column>, MeasuredTrackError> {
    let mut columns: Vec<Column> = Vec::new();
    for &name in cells {
        let column = Column::parse(name).ok_or_else(|| MeasuredTrackError::Header {
            line,
            name: name.to_owned(),
            allowed: ALLOWED,
        })?;
        if columns.iter().any(|other| other.channel == column.channel) {
            return Err(MeasuredTrackError::Twice {
                line,
                name: name.to_owned(),
                column: column.channel.map_or("distance", |k| CHANNELS[k]),
            });
        }
        columns.push(column);
    }
    let distances = columns.iter().filter(|column| column.channel.is_none());
    if distances.count() != 1 || columns.len() < 2 {
        return Err(missing(line, &cells.join(", ")));
    }
    Ok(columns)
}

fn row(line: u64, cells: &[&str], columns: &[Column]) -> Result<Row, MeasuredTrackError> {
    if cells.len() != columns.len() {
        return Err(MeasuredTrackError::Cells {
            line,
            found: cells.len(),
            allowed: columns.len(),
        });
    }
    let mut row = Row {
        line,
        distance_m: 0.0,
        deviations_m: [0.0; 4],
    };
    for (column, cell) in columns.iter().zip(cells) {
        let limit_m = column.channel.map_or(MAX_DISTANCE_M, |_| MAX_DEVIATION_M);
        let limit = limit_m / column.unit_m;
        let number = cell.parse::<f64>().ok();
        let number = number.filter(|number| number.abs() <= limit);
        let number = number.ok_or_else(|| MeasuredTrackError::Number {
            line,
            column: column.name.clone(),
            text: (*cell).to_owned(),
            limit,
        })?;
        match column.channel {
            Some(channel) => row.deviations_m[channel] = number * column.unit_m,
            None => row.distance_m = number,
        }
    }
    Ok(row)
}
