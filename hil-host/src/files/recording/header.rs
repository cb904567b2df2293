//! The header of a recording: where its columns are, or what kind of file it is instead.

use std::io::Read;
use std::path::Path;

use csv::{ByteRecord, Reader};

use super::RecordingError;
use crate::files::FileError;

/// Names of the columns a recording must have, time and value; others are passed over.
pub(super) type Names = [&'static str; 2];

/// Those of a motion.
pub(super) const MOTION: Names = ["time_s", "displacement_m"];

/// Those of a force.
pub(super) const FORCE: Names = ["time_s", "force_n"];

/// Separators of other files: the byte and its name.
const SEPARATORS: [(u8, &str); 2] = [(b';', "semicolons"), (b'\t', "tabs")];

/// Indices of the columns called `names` in the header of `reader`.
///
/// # Errors
/// An empty file, another kind of file, or a column that is missing or repeated.
pub(super) fn columns<R: Read>(
    path: &Path,
    reader: &mut Reader<R>,
    names: Names,
) -> Result<[usize; 2], FileError> {
    find_columns(reader, names).map_err(|error| FileError::in_file(path, error))
}

fn find_columns<R: Read>(
    reader: &mut Reader<R>,
    names: Names,
) -> Result<[usize; 2], RecordingError> {
    let [_, value] = names;
    let header = reader.byte_headers()?.clone();
    if header.is_empty() {
        return Err(RecordingError::Empty { value });
    }
    let indices = names.map(|name| indices(&header, name));
    for (column, indices) in names.into_iter().zip(&indices) {
        let times = indices.len();
        if times > 1 {
            return Err(RecordingError::RepeatedColumn { column, times });
        }
    }
    match [indices[0].first(), indices[1].first()] {
        [Some(&time), Some(&displacement)] => Ok([time, displacement]),
        [time, _] => {
            let found = binary_kind(&header).map(str::to_owned).unwrap_or_else(|| {
                let missing = names[usize::from(time.is_some())];
                let what = separators(&header, reader)
                    .unwrap_or_else(|| format!("column {missing} is missing from the header"));
                format!("{what} (found `{}`)", shown(&header))
            });
            Err(RecordingError::Header { found, value })
        }
    }
}

fn indices(header: &ByteRecord, name: &str) -> Vec<usize> {
    (0..header.len())
        .filter(|&index| &header[index] == name.as_bytes())
        .collect()
}

/// The kind of file that starts so, where it is a known one that does not show as a line of text.
fn binary_kind(header: &ByteRecord) -> Option<&'static str> {
    let bytes = header.as_slice();
    let zeros = count(bytes, 0);
    if bytes.starts_with(b"\x1f\x8b") {
        Some("the file is compressed with gzip (it starts with 1f 8b)")
    } else if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        Some("the file is UTF-16 text (it starts with that byte order mark)")
    } else if zeros > 0 && 3 * zeros >= bytes.len() {
        // Of Latin letters every second byte.
        Some("the file is UTF-16 text (between the letters are zero bytes)")
    } else {
        None
    }
}

/// What separates the cells of this header, where it is not a comma, and whether the numbers of the row
/// after it have a decimal comma.
fn separators<R: Read>(header: &ByteRecord, reader: &mut Reader<R>) -> Option<String> {
    let bytes = header.as_slice();
    let commas = header.len() - 1;
    let (_, separator) = SEPARATORS
        .into_iter()
        .find(|(byte, _)| count(bytes, *byte) > commas)?;
    let mut found = format!("the cells are separated by {separator}");
    let mut row = ByteRecord::new();
    // A row that has more commas than the header is an error of the reader, and read all the same.
    let _ = reader.read_byte_record(&mut row);
    if row.len() > header.len() {
        found.push_str(" and the numbers have a decimal comma");
    }
    Some(found)
}

fn count(bytes: &[u8], wanted: u8) -> usize {
    bytes.iter().filter(|&&byte| byte == wanted).count()
}

/// The start of the header as a line of text.
fn shown(header: &ByteRecord) -> String {
    let cells: Vec<_> = header.iter().map(String::from_utf8_lossy).collect();
    let line: String = cells.join(",").chars().take(80).collect();
    line.escape_debug().to_string()
}
