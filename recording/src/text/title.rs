//! Lines before the table of a text, such as a title or the settings of a logger.

use super::header;
use super::number::is_number;
use super::separator::rows;
use crate::error::RecordingError;
use crate::select::bare;
use crate::text_options::Separator;

/// Rows that must follow a header before it counts as one.
const MIN_ROWS: usize = 2;

/// Start of a LabVIEW measurement file (.lvm), and the line before each of its headers and tables.
const LABVIEW: &[u8] = b"LabVIEW Measurement";
const LABVIEW_END: &[u8] = b"***End_of_Header***";

/// Name of the last column of LabVIEW measurement files, which most rows leave out with its separator.
pub(super) const COMMENT: &str = "Comment";

/// Start of UTF-8 as some programs write it.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// A line of the text, split into cells.
struct Line {
    /// Number of lines before it.
    before: u64,
    cells: Vec<Vec<u8>>,
}

/// Returns an error that states how many lines precede the table, if the text at `head` (whole lines) begins with other
/// lines and its table was found. `separator` is the chosen separator.
pub(super) fn check(head: &[u8], separator: Option<Separator>) -> Result<(), RecordingError> {
    let head = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head);
    let before = match head.starts_with(LABVIEW) {
        true => labview(head),
        false => lines_before_table(head, separator),
    };
    let Some(lines) = before.filter(|lines| *lines > 0) else {
        return Ok(());
    };
    let mut texts = head.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let first = texts.find(|line| !line.is_empty()).unwrap_or_default();
    let first = String::from_utf8_lossy(first).chars().take(40).collect();
    Err(RecordingError::Title { lines, first })
}

/// Returns the number of lines before the table of a LabVIEW measurement.
fn labview(head: &[u8]) -> Option<u64> {
    let lines = (1..).zip(head.split(|byte| *byte == b'\n'));
    let ends = lines.filter(|(_, line)| line.starts_with(LABVIEW_END));
    ends.last().map(|(number, _)| number)
}

/// Returns the number of lines before the table: `None` if the whole text is a table, or if there is none.
fn lines_before_table(head: &[u8], separator: Option<Separator>) -> Option<u64> {
    let mut best: Option<u64> = None;
    for possible in Separator::ALL {
        if separator.is_some_and(|separator| separator != possible) {
            continue;
        }
        let lines = lines(head, possible);
        match table(&lines) {
            Some(0) => return None,
            Some(index) => {
                let before = lines[index].before;
                best = Some(best.map_or(before, |best| best.min(before)));
            }
            None => {}
        }
    }
    best
}

/// Returns the index of the header of the table at the end of the text.
fn table(lines: &[Line]) -> Option<usize> {
    let length = lines.last()?.cells.len();
    if length < 2 {
        return None;
    }
    let fits = |line: &&Line| {
        let longer = line.cells.len() == length + 1 && line.cells.last().is_some_and(Vec::is_empty);
        line.cells.len() == length || longer
    };
    // A first line with as many cells is the header, and what follows it is damage. The cells of a title that a
    // spreadsheet wrote are empty at the end.
    let first = lines.first()?;
    if first.cells.len() == length && first.cells.last().is_some_and(|cell| !cell.is_empty()) {
        return Some(0);
    }
    let has_number = |line: &Line| line.cells.iter().any(|cell| is_number(cell));
    let is_row = |line: &Line| {
        let mut cells = line.cells.iter();
        has_number(line) && cells.all(|cell| cell.is_empty() || is_number(cell))
    };
    // So is a first line of names above a row with as many cells.
    if let [_, second, ..] = lines
        && first.cells.len() > 1
        && first.cells.len() == second.cells.len()
        && !has_number(first)
        && is_row(second)
    {
        return Some(0);
    }
    let start = lines.len() - lines.iter().rev().take_while(fits).count();
    let first_row = start + lines[start..].iter().position(is_row)?;
    let is_table = lines.len() - first_row >= MIN_ROWS && lines[first_row..].iter().all(is_row);
    if !is_table {
        return None;
    }
    if first_row == start && lines[..start].iter().any(|line| line.cells.len() > 1) {
        // The line above the rows could be a header that lacks names.
        return None;
    }
    // Above the rows is the header, or the units and above these the header.
    let header = match first_row - start {
        0..=2 => start,
        _ if has_unit(&lines[first_row - 1]) => first_row - 2,
        _ => first_row - 1,
    };
    // A line with numbers is a damaged row.
    (header == first_row || !has_number(&lines[header])).then_some(header)
}

/// True if a cell is a known unit.
fn has_unit(line: &Line) -> bool {
    let mut cells = line.cells.iter();
    cells.any(|cell| std::str::from_utf8(cell).is_ok_and(|cell| header::is_unit(bare(cell))))
}

/// Splits the text into lines, except blank lines and comments.
fn lines(head: &[u8], separator: Separator) -> Vec<Line> {
    let numbered = (0..).zip(head.split(|byte| *byte == b'\n'));
    let is_text =
        |(_, line): &(u64, &[u8])| !line.trim_ascii().is_empty() && !line.starts_with(b"#");
    numbered
        .filter(is_text)
        .map(|(before, line)| Line {
            before,
            cells: rows(line, separator).pop().unwrap_or_default(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn before(text: &str) -> Option<u64> {
        match check(text.as_bytes(), None) {
            Err(RecordingError::Title { lines, .. }) => Some(lines),
            _ => None,
        }
    }

    #[test]
    fn lines_before_the_table_are_counted() {
        for (text, expected) in [
            ("Rig 7\n\ntime;x;F\n0;1;2\n1;2;3\n", Some(2)),
            (
                "Rig 7\nDate;2026-11-28\ntime;x;F\ns;mm;N\n0;1,5;2\n1;2,5;3\n",
                Some(2),
            ),
            ("Rig 7\r\nby hand\r\ntime,x\r\n0,1\r\n1,2\r\n", Some(2)),
            ("\u{feff}#note\ntime,x\n0,1\n1,2\n", None),
            ("\u{feff}Rig 7\ntime;x;F\n0;1;2\n1;2;3\n", Some(1)),
            ("#note\nRig 7\n0\t1\t2\n1\t2\t3\n", Some(2)),
            ("Rig;7;\nby;hand;\ntime;x;F\n0;1;2\n1;2;3\n", Some(2)),
            ("Rig;7;\ntime;x;F\ns;mm;N\n0;1;2\n1;2;3\n", Some(1)),
            ("a;b;c\nbar;K;rpm\n0;1;2\n1;2;3\n", None),
            ("time;x;F\n0;1;2\n1;2;3\n", None),
            ("time;x;F\ns;mm;N\n0;1;2\n1;2;3\n", None),
            ("Rig 7\ntime;x;F\n0;1;2\n", None),
            ("time;x\n0\n\n1;2\n2;3\n", None),
            ("time;x\n0;1;2\n1;2;3\n", None),
            ("0,1\n1,2\n", None),
            ("time,x\n0,1\n1\n-1,2,3E\n2,3,4\n3,4,5\n", None),
            ("time,x\n0\n-1,2,3E\n2,3,4\n3,4,5\n", None),
            ("", None),
        ] {
            assert_eq!(before(text), expected, "{text:?}");
        }
    }

    #[test]
    fn the_table_of_a_labview_measurement_follows_its_last_header() {
        let text = "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\n\nChannels\t1\n\
                    ***End_of_Header***\t\t\nX_Value\tx\tComment\n0\t1\n";
        assert_eq!(before(text), Some(6));
        assert_eq!(before("LabVIEW Measurement\t\n"), None);
    }
}
