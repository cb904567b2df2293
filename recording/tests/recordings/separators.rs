//! Detection of the separator of a text.

use std::io::Cursor;
use std::path::Path;

use dashpot_recording::Recording;

fn read(text: &str) -> Result<Vec<[f64; 2]>, String> {
    let source = Box::new(Cursor::new(text.as_bytes().to_vec()));
    let rows = Recording::read(Path::new("run7.csv"), source)
        .and_then(|mut recording| recording.read_all());
    let rows = rows.map_err(|error| error.to_string())?;
    Ok(rows
        .iter()
        .map(|row| [row.time_s, row.displacement_m])
        .collect())
}

/// Several separators split these texts into rows of equal length. The right one leaves the largest share of numbers.
#[test]
fn the_separator_with_the_largest_share_of_numbers_is_chosen() {
    for text in [
        // Semicolons would leave the cells `0.5, a` and `b, 0.25`.
        "time_s, left; right, displacement_m\n0.5, a; b, 0.25\n",
        // Commas would leave the cells `0.5; a` and `b; 0.25`.
        "time_s; left, right; displacement_m\n0.5; a, b; 0.25\n",
        // Bars would leave the cells `0.5 a` and `b 0.25`.
        "time_s left | right displacement_m\n0.5 a | b 0.25\n",
        // Commas would leave more numbers (2, 3 and 4) but a smaller share: 3 of 5 instead of 2 of 3.
        "time_s;displacement_m;a,b,c,d,e\n0.5;0.25;1,2,3,4,x\n",
        // Empty cells do not count. Otherwise semicolons would leave 2 of 5, and commas 1 of 2.
        "time_s;displacement_m;a;b;c,d\n0.5;0.25;;;x,1\n",
    ] {
        assert_eq!(read(text), Ok(vec![[0.5, 0.25]]), "{text}");
    }
}

#[test]
fn only_an_empty_cell_may_follow_at_the_end_of_a_row() {
    for text in [
        // Commas would fit too, but without any number.
        "time_s;displacement_m;a,b\n0.5;0.25;1,5;\n",
        // Semicolons would leave as many numbers, but three cells instead of two.
        "time_s,displacement_m,a;b\n0.5,0.25,1;2;3\n",
    ] {
        assert_eq!(read(text), Ok(vec![[0.5, 0.25]]), "{text}");
    }
}

#[test]
fn of_separators_with_equal_shares_tabs_come_first() {
    // Tabs leave the number 0.5, and semicolons the number 7.
    let rows = read("time_s\tdisplacement_m;force_n\n0.5\t0.25;7\n");
    let error = rows.expect_err("no column displacement_m");
    let expected = "the file has `time_s`, `displacement_m;force_n`";
    assert!(error.ends_with(expected), "{error}");
}

/// Spaces are not considered unless they fit all inspected rows, because names and units may contain them.
#[test]
fn eight_rows_decide() {
    let row = |row: u32| format!("{row} 0.5\n");
    let text = |rows: u32| -> String { (0..rows).map(row).collect() };
    let header = "time_s displacement_m\n";
    let rows = read(&format!("{header}{}", text(2)));
    assert_eq!(rows, Ok(vec![[0.0, 0.5], [1.0, 0.5]]));
    // The ninth row, counting the header, is not inspected: it is an error when it is read.
    let error = read(&format!("{header}{}9 9 9\n", text(7))).expect_err("three cells");
    let expected = "line 9: 3 cells, but the header has 2 (separated by spaces)";
    assert!(error.ends_with(expected), "{error}");
    let error = read(&format!("{header}{}9 9 9\n", text(6))).expect_err("three cells");
    let expected = "column time_s is missing; the file has `time_s displacement_m`";
    assert!(error.ends_with(expected), "{error}");
}

/// Without the row, semicolons would fit this header as well as commas.
#[test]
fn a_row_without_a_line_end_counts() {
    let rows = read("time_s,displacement_m,a;b\n0.5,0.25,1");
    assert_eq!(rows, Ok(vec![[0.5, 0.25]]));
}
