//! The library in the pages is the one that its README names.

use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::shown::DEMONSTRATION;

#[test]
fn the_plotting_library_is_what_its_readme_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/report/page/uplot");
    let readme = fs::read_to_string(folder.join("README.md")).unwrap();
    let rows: Vec<Vec<&str>> = readme
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            line.split('|')
                .map(|cell| cell.trim().trim_matches('`'))
                .collect()
        })
        .collect();
    for row in &rows {
        let digest = Sha256::digest(fs::read(folder.join(row[1])).unwrap());
        let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(digest, row[3], "{}", row[1]);
    }
    let mut told: Vec<&str> = rows.iter().map(|row| row[1]).chain(["README.md"]).collect();
    let mut there: Vec<String> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    told.sort_unstable();
    there.sort_unstable();
    assert_eq!(there, told);
}

/// Its licence: "in all copies or substantial portions of the Software".
#[test]
fn pages_have_the_librarys_licence() {
    let licence = include_str!("../../src/report/page/uplot/LICENSE");
    assert!(DEMONSTRATION.contains(&format!("<!-- uPlot\n{licence}-->")));
}
