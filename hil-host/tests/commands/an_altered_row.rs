//! Regression: an altered index in a row (0.014 to 9.014) was accepted silently on resume and merge.

use std::fs;

use crate::common::{dashpot, error_of, text_of};
use crate::sweep::{STUDY, altered, folder, read, rows, with_its_digest};

#[test]
fn an_altered_cell_is_refused_on_resume_and_merge() {
    let folder = folder(STUDY);
    let text = rows(folder.path());
    let (header, rest) = text.split_once('\n').unwrap();
    let row = rest.lines().nth(3).unwrap();
    for (column, cell) in [
        ("derailment_greatest", "9.014"),
        ("derailment_greatest", ""),
        ("ending", "derailed"),
        ("row_digest", "0123456789abcdef"),
    ] {
        let altered = altered(row, column, header, cell);
        assert_ne!(altered, row);
        let whole = text.replace(row, &altered);
        fs::write(folder.path().join("one/rows.csv"), &whole).unwrap();
        let sweep = ["sweep", "study.toml", "--no-page", "--output", "one"];
        let merge = ["merge", "study.toml", "one/rows.csv", "--output", "merged"];
        for (command, way_on) in [
            (
                &sweep[..],
                "delete line 5 of this file and repeat the command to run its case again",
            ),
            (
                &merge,
                "delete line 5 of this file, run the command of its shard again, then merge",
            ),
        ] {
            let error = error_of(&dashpot(command, folder.path()).code(1));
            assert!(
                error.contains("one/rows.csv:5: column row_digest: "),
                "{error}"
            );
            assert!(error.contains("was altered or damaged"), "{error}");
            assert!(error.contains(way_on), "{error}");
        }
        assert!(!folder.path().join("merged").exists());
        // The recovery that the message names.
        let without: Vec<&str> = whole.lines().filter(|line| *line != altered).collect();
        fs::write(
            folder.path().join("one/rows.csv"),
            without.join("\n") + "\n",
        )
        .unwrap();
        let again = dashpot(&sweep, folder.path()).success();
        assert!(text_of(&again).contains("12 cases, 1 run now"));
        assert_eq!(read(folder.path(), "one/rows.csv"), text);
    }
}

#[test]
fn a_check_finds_an_altered_cell_with_a_matching_digest() {
    let folder = folder(STUDY);
    let text = rows(folder.path());
    let (header, rest) = text.split_once('\n').unwrap();
    let merge = [
        "merge",
        "study.toml",
        "one/rows.csv",
        "--no-page",
        "--output",
        "merged",
    ];
    let check = |more: &[&str]| dashpot(&[&merge[..], more].concat(), folder.path());
    // The same seed chooses the same cases; without a seed, the command prints the one it used.
    let four = ["--check", "4", "--check-seed", "7"];
    let output = text_of(&check(&four).success());
    assert!(
        output.contains("4 cases repeated with bit-identical results (--check-seed 7): "),
        "{output}"
    );
    let again = text_of(&check(&four).success());
    assert_eq!(output, again);
    let output = text_of(&check(&["--check", "99"]).success());
    assert!(
        output.contains("12 cases repeated with bit-identical results (--check-seed "),
        "{output}"
    );
    fs::remove_dir_all(folder.path().join("merged")).unwrap();
    // All twelve cases are run, including the altered one.
    let row = rest.lines().nth(3).unwrap();
    let altered = with_its_digest(&altered(row, "derailment_greatest", header, "9.014"));
    fs::write(
        folder.path().join("one/rows.csv"),
        text.replace(row, &altered),
    )
    .unwrap();
    let error = error_of(&check(&["--check", "12"]).code(1));
    let expected = "case 3: column derailment_greatest: `9.014`, but a new run gives `";
    assert!(error.contains(expected), "{error}");
    assert!(error.contains("run its shard again with --anew"), "{error}");
    assert!(!folder.path().join("merged").exists(), "nothing is written");
    // Without a run to compare with, the alteration is not found.
    check(&[]).success();
}
