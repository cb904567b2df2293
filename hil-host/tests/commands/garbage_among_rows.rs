//! Regression: garbage in the middle of a `.partial` file stopped a study without saying how to continue.

use std::fs;

use crate::common::{dashpot, error_of, files_in, text_of};
use crate::sweep::{STUDY, folder, read, rows};

#[test]
fn garbage_is_reported_with_its_line_and_a_remedy() {
    let folder = folder(STUDY);
    let text = rows(folder.path());
    let one = folder.path().join("one");
    let sweep = ["sweep", "study.toml", "--no-page", "--output", "one"];
    let lines: Vec<&[u8]> = text
        .as_bytes()
        .split_inclusive(|byte| *byte == b'\n')
        .collect();
    for garbage in [
        &b"\0\0\0\0\0\0\n"[..],
        b"\xff\xfe\xfd\n",
        b"3,clearance,\"\n",
        b"3,clea3,clearance,0,140,,2,completed\n",
        lines[2],
    ] {
        let mut bytes = lines[..5].concat();
        bytes.extend_from_slice(garbage);
        bytes.extend(lines[6..9].concat());
        // A row that was being written when the power failed.
        bytes.extend_from_slice(&lines[9][..20]);
        fs::remove_dir_all(&one).unwrap();
        fs::create_dir(&one).unwrap();
        let partial = one.join("rows.csv.partial");
        fs::write(&partial, &bytes).unwrap();
        let error = error_of(&dashpot(&sweep, folder.path()).code(1));
        let name = String::from_utf8_lossy(garbage);
        assert!(
            error.contains("one/rows.csv.partial:6: "),
            "{name}: {error}"
        );
        let remedy = "delete line 6 of this file and repeat the command to run its case again, or start over with \
         --anew";
        assert!(error.contains(remedy), "{name}: {error}");
        assert_eq!(fs::read(&partial).unwrap(), bytes, "nothing is changed");
        // The recovery that the message names.
        let mut mended = lines[..5].concat();
        mended.extend(lines[6..9].concat());
        fs::write(&partial, &mended).unwrap();
        let rest = text_of(&dashpot(&sweep, folder.path()).success());
        assert!(rest.contains("12 cases, 5 run now"), "{rest}");
        assert_eq!(files_in(&one), ["rows.csv", "rows.study"]);
        assert_eq!(read(&one, "rows.csv"), text);
    }
}
