//! Regression: rows carried only the program version, which never changed, so rows of different physics were resumed
//! and merged silently.

use std::fs;

use dashpot_study::sweep::PHYSICS;

use crate::common::{dashpot, error_of, json_of};
use crate::sweep::{STUDY, altered, folder, read, rows, with_its_digest};

#[test]
fn rows_of_other_physics_are_refused_on_resume_and_merge() {
    let folder = folder(STUDY);
    let text = rows(folder.path());
    let (header, rest) = text.split_once('\n').unwrap();
    let here = PHYSICS;
    assert!(rest.lines().all(|row| row.contains(here)), "{rest}");
    // Rows of an earlier program, with correct digests.
    let other = "0123456789abcdef";
    let row = rest.lines().next().unwrap();
    let row = with_its_digest(&altered(row, "physics", header, other));
    let older = format!("{header}\n{row}\n");
    let expected = format!(
        ":2: column physics: `{other}`, allowed: {here}; the model behaves differently now"
    );
    let one = folder.path().join("one");
    for name in ["rows.csv", "rows.csv.partial"] {
        fs::remove_dir_all(&one).unwrap();
        fs::create_dir(&one).unwrap();
        fs::write(one.join(name), &older).unwrap();
        let sweep = ["sweep", "study.toml", "--no-page", "--output", "one"];
        let error = error_of(&dashpot(&sweep, folder.path()).code(1));
        assert!(error.contains(&format!("{name}{expected}")), "{error}");
        assert!(error.contains("start over with --anew"), "{error}");
        assert_eq!(read(&one, name), older, "nothing is changed");
    }
    fs::write(folder.path().join("a.csv"), &text).unwrap();
    fs::write(folder.path().join("b.csv"), &older).unwrap();
    let merge = [
        "merge",
        "study.toml",
        "a.csv",
        "b.csv",
        "--output",
        "merged",
    ];
    let error = error_of(&dashpot(&merge, folder.path()).code(1));
    assert!(error.contains(&format!("b.csv{expected}")), "{error}");
    assert!(!folder.path().join("merged").exists());
}

/// Rows in the old format, without the columns of physics and digest.
#[test]
fn rows_of_an_earlier_dashpot_are_refused_with_a_remedy() {
    let folder = folder(STUDY);
    let text = rows(folder.path());
    let older: Vec<String> = text
        .lines()
        .map(|line| line.rsplitn(3, ',').last().unwrap().to_owned() + "\n")
        .collect();
    fs::write(folder.path().join("one/rows.csv"), older.concat()).unwrap();
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "one"];
    let error = error_of(&dashpot(&sweep, folder.path()).code(1));
    assert!(
        error.contains("rows.csv:1: the columns are not those of the study"),
        "{error}"
    );
    assert!(error.contains("start over with --anew"), "{error}");
    let restarted = dashpot(
        &[&sweep[..], &["--anew", "--format", "json"]].concat(),
        folder.path(),
    );
    let report = json_of(&restarted.success());
    assert_eq!(report["physics"], PHYSICS);
    assert_eq!(read(folder.path(), "one/rows.csv"), text);
}
