//! Errors of a case in terms of command line options.

use dashpot_files::case::{Case, CaseOptions};
use dashpot_hil::commands::failure::{Failure, Kind};

#[test]
fn wrong_options_are_wrong_use() {
    let mut fast = CaseOptions::new("coach", "straight", 900.0);
    let failure = |options: &CaseOptions| Failure::from(options.case().unwrap_err());
    let found = failure(&fast);
    assert_eq!(found.kind(), Kind::WrongUse);
    assert_eq!(found.to_string(), "--speed-km-h 900, allowed: 3.6 to 540");
    fast.speed_km_h = 90.0;
    fast.dampers.push("verticl=paper".parse().unwrap());
    let found = failure(&fast).to_string();
    assert_eq!(
        found,
        "--damper verticl=paper: no damper `verticl`; did you mean `vertical`?"
    );
    // Options of a file may be overridden; an added option belongs to no line of the file.
    let mut options = CaseOptions::load("curve-r200").unwrap();
    options.overrides.push("bdy.mass_kg=3".into());
    let found = failure(&options);
    assert_eq!(found.kind(), Kind::WrongUse);
    assert!(
        found
            .to_string()
            .starts_with("--set bdy.mass_kg=3: no part")
    );
    let in_file = CaseOptions::parse(
        "case.toml",
        "vehicle = \"coach\"\ntrack = \"strait\"\nspeed_km_h = 90\n",
    );
    let error = in_file.and_then(|options| options.case()).unwrap_err();
    assert_eq!(Failure::from(error).kind(), Kind::Failed);
    let unknown = Failure::from(Case::load("curve-r100").unwrap_err());
    assert_eq!(unknown.kind(), Kind::WrongUse);
    assert!(unknown.to_string().contains("did you mean `curve-r"));
}
