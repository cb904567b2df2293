//! Tables `[contact]` of vehicle and case files: keys, files relative to the naming file, overrides, errors.

use std::fs;

use dashpot_files::case::{Case, CaseOptions};
use dashpot_files::contact::{ContactParameters, SharedProfile};
use dashpot_files::study::StudyParameters;
use dashpot_files::vehicle::VEHICLES;
use dashpot_rail::profile::{Profile, s1002, uic60};

const CASE: &str = "name = \"ride\"
vehicle = \"coach\"
track = \"straight\"
speed_km_h = 90
";

/// A folder that is removed at the end.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, text: &str) -> String {
        let path = self.0.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    }
}

/// A profile as a file of columns, `lower_mm` deeper than the original.
fn columns(profile: &Profile, lower_mm: f64) -> String {
    let rows = profile.points().iter().step_by(5);
    let rows =
        rows.map(|point| format!("{:.4},{:.4}\n", 1e3 * point.y_m, 1e3 * point.z_m + lower_mm));
    format!("y_mm,z_mm\n{}", rows.collect::<String>())
}

fn case(text: &str) -> Case {
    let options = CaseOptions::parse("case.toml", text).unwrap();
    options.case().unwrap()
}

fn error(text: &str) -> String {
    match CaseOptions::parse("case.toml", text) {
        Ok(options) => options.case().unwrap_err().to_string(),
        Err(error) => error.to_string(),
    }
}

/// Names of the wheels, `left right` of each wheelset.
fn wheels(case: &Case) -> Vec<String> {
    let names = |number| {
        let [left, right] = [0, 1].map(|side| case.contact.wheel(number, side).name());
        format!("{left} {right}")
    };
    (0..case.vehicle.wheelsets.len()).map(names).collect()
}

#[test]
fn a_case_without_a_table_has_the_standard_contact() {
    let case = case(CASE);
    assert_eq!(case.contact, ContactParameters::standard(&case.vehicle));
    assert!(case.contact.is_standard(&case.vehicle));
    assert_eq!(case.contact.wheel(0, 0), &SharedProfile::s1002());
    assert_eq!(case.contact.rail(1), &SharedProfile::uic60());
    assert_eq!(
        case.contact.installation(0.625),
        dashpot_rail::contact::Installation::STANDARD
    );
    assert!(case.track.gauge_changes.is_empty() && case.track.friction_ratios.is_empty());
}

#[test]
fn every_number_of_the_table_is_read() {
    let case = case(&format!(
        "{CASE}[contact]
        back_to_back_m = 1.3605
        back_to_datum_m = 0.0702
        rail_inclination = 0.05
        gauge_m = 1.437
        gauge_depth_m = 0.0145
        gauge_over_distance = [[0, 1.437], [50, 1.445]]
        friction = 0.4
        friction_over_distance = [[0, 0.4, 0.4], [100.0, 0.4, 0.1]]
        residual_friction_ratio = 0.5
        friction_decay_speed_m_per_s = 2\n"
    ));
    let contact = &case.contact;
    let installation = contact.installation(0.5);
    assert_eq!(installation.wheel_radius_m, 0.5);
    assert_eq!(installation.back_to_back_m, 1.3605);
    assert_eq!(installation.back_to_datum_m, 0.0702);
    assert_eq!(installation.inclination, 0.05);
    assert_eq!(installation.gauge_m, 1.437);
    assert_eq!(installation.gauge_depth_m, 0.0145);
    let friction = contact.friction(case.friction);
    assert_eq!(friction.static_coefficient, 0.4);
    assert_eq!(
        (friction.residual_ratio, friction.decay_speed_m_per_s),
        (0.5, 2.0)
    );
    assert_eq!(contact.greatest_friction(1, case.friction), 0.4);
    let track = case.track.build().unwrap();
    let [left, right] = track.displacements(75.0, 25.0);
    assert_eq!(left.friction_ratio, 1.0);
    // 0.4 to 0.1 over 100 m.
    assert!(
        (right.friction_ratio - 0.175 / 0.4).abs() < 1e-12,
        "{right:?}"
    );
    let plain = self::case(CASE).track.build().unwrap();
    let [without, _] = plain.displacements(75.0, 25.0);
    assert!((left.lateral_m - without.lateral_m + 4e-3).abs() < 1e-12);
}

#[test]
fn files_are_relative_to_the_file_that_names_them() {
    let folder = Folder::new();
    folder.write("profiles/worn.csv", &columns(&s1002::profile(), 0.0));
    folder.write("profiles/old.csv", &columns(&uic60::profile(), 0.0));
    folder.write("profiles/hollow.csv", &columns(&s1002::profile(), 0.1));
    let coach = VEHICLES[1].1;
    let with_wheels = format!(
        "{coach}\n[contact]\nwheel = \"../profiles/worn.csv\"\nback_to_back_m = 1.3602\n\
         [[contact.other_wheel]]\nwheelset = \"wheelset 2\"\nside = \"left\"\nwheel = \"s1002\"\n"
    );
    folder.write("vehicles/worn.toml", &with_wheels);
    let text = CASE.replace("coach", "vehicles/worn.toml");
    let rails = "[contact]\nleft_rail = \"profiles/old.csv\"\nleft_rail_smoothing_m = 0.0\n";
    let name = folder.write("ride.toml", &format!("{text}{rails}"));
    let worn = Case::load(&name).unwrap();
    assert_eq!(
        wheels(&worn),
        ["worn worn", "S1002 worn", "worn worn", "worn worn"]
    );
    assert_eq!(worn.contact.back_to_back_m, 1.3602);
    assert_eq!(
        [worn.contact.rail(0).name(), worn.contact.rail(1).name()],
        ["old", "UIC 60"]
    );
    assert!(!worn.contact.is_standard(&worn.vehicle));
    // The case's wheels replace the vehicle's.
    let other = format!(
        "{text}[contact]\nwheel = \"profiles/hollow.csv\"\n[[contact.other_wheel]]\nwheelset = \"wheelset 4\"\n\
         wheel = \"profiles/worn.csv\"\n"
    );
    let name = folder.write("other.toml", &other);
    let hollow = Case::load(&name).unwrap();
    assert_eq!(
        wheels(&hollow),
        [
            "hollow hollow",
            "hollow hollow",
            "hollow hollow",
            "worn worn"
        ]
    );
    // A built-in profile can be named over a file's, with its reading options forgotten.
    let mut options = CaseOptions::load(&name).unwrap();
    options.overrides.push("contact.wheel=\"s1002\"".into());
    assert_eq!(wheels(&options.case().unwrap()), ["S1002 S1002"; 4]);
    // A profile of the same points has the same content, whatever its name.
    let copy = folder.write("profiles/copy.csv", &columns(&s1002::profile(), 0.1));
    options.overrides.push(format!("contact.wheel={copy:?}"));
    let copied = options.case().unwrap();
    assert_eq!(
        copied.contact.wheel(0, 0).points(),
        hollow.contact.wheel(0, 0).points()
    );
    // A study's axis names files relative to the study.
    let study = "name = \"wheels\"\nobserved = [\"wheel_lift_longest_s\"]\n\
         [[sweep]]\nname = \"a\"\ncase = \"ride.toml\"\n\
         contact = { rail_inclination = 0.05 }\n\
         [[sweep.vary]]\nparameter = \"contact.wheel\"\nvalues = [\"s1002\", \"profiles/hollow.csv\"]\n\
         [[sweep.vary]]\nparameter = \"contact.gauge_m\"\nvalues = [1.432, 1.435]\n";
    let study = StudyParameters::load(&folder.write("study.toml", study)).unwrap();
    let sweep = &study.sweeps[0];
    let last = sweep.options(&sweep.values(2)).unwrap().case().unwrap();
    assert_eq!(wheels(&last), ["hollow hollow"; 4]);
    assert_eq!(
        (last.contact.gauge_m, last.contact.rail_inclination),
        (1.432, 0.05)
    );
}

#[test]
fn friction_of_the_case_and_of_the_table_are_the_same() {
    let mut options =
        CaseOptions::parse("case.toml", &format!("{CASE}[contact]\nfriction = 0.3\n")).unwrap();
    assert_eq!(options.case().unwrap().friction, 0.3);
    options.set_number("friction", 0.2);
    assert_eq!(options.case().unwrap().friction, 0.2);
    options.overrides.push("contact.friction=0.1".into());
    assert_eq!(options.case().unwrap().friction, 0.1);
    options.overrides.push("contact.right_friction=0.05".into());
    let case = options.case().unwrap();
    assert_eq!(case.track.friction_ratios, [[0.0, 1.0, 0.5]]);
    assert_eq!(case.contact.greatest_friction(0, case.friction), 0.1);
    assert_eq!(case.contact.greatest_friction(1, case.friction), 0.05);
}

#[test]
fn errors_name_file_line_and_what_is_allowed() {
    let named = |table: &str| error(&format!("{CASE}[contact]\n{table}\n"));
    for (table, parts) in [
        (
            "gauge_m = 1.2",
            vec![
                "case.toml:6: contact.gauge_m",
                "gauge minus back-to-back",
                "allowed: 0.03 to 0.12 m",
            ],
        ),
        (
            "rail_inclination = 0.5",
            vec![
                "case.toml:6: contact.rail_inclination",
                "allowed: -0.1 to 0.1",
            ],
        ),
        (
            "gauge_depth_m = 0.1",
            vec![
                "case.toml:6: contact.gauge_depth_m",
                "allowed: 0.005 to 0.03",
            ],
        ),
        (
            "left_friction = 3.0",
            vec!["case.toml:6: contact.left_friction: 3, allowed: 0 to 2"],
        ),
        (
            "residual_friction_ratio = 2.0",
            vec![
                "case.toml:6: contact.residual_friction_ratio",
                "allowed: 0 to 1",
            ],
        ),
        (
            "friction = 3.0",
            vec!["case.toml:6: friction 3, allowed: 0 to 2"],
        ),
        (
            "rail = \"uic54\"",
            vec![
                "case.toml:6: contact.rail: uic54: no such profile, allowed: uic60 or a profile file",
            ],
        ),
        (
            "rail_format = \"miniprof\"",
            vec!["case.toml:6: contact.rail_format", "allowed: with rail"],
        ),
        (
            "wheel = \"w.csv\"\nwheel_mirror = \"x\"",
            vec!["case.toml:7: contact.wheel_mirror: x: unknown axes, allowed: none, y, z, yz"],
        ),
        (
            "gauge_over_distance = [[0, 1.44], [0, 1.45]]",
            vec![
                "case.toml:6: contact.gauge_over_distance: point 2 of the gauge: distance_m 0, allowed",
            ],
        ),
        (
            "friction_over_distance = [[0, 0.4, -1]]",
            vec!["case.toml:6: contact.friction_over_distance: -1, allowed: 0 to 2"],
        ),
        (
            "left_friction = 0.1\nfriction_over_distance = [[0, 0.4, 0.4]]",
            vec![
                "case.toml:6: contact.left_friction",
                "allowed: one of the two",
            ],
        ),
        (
            "friction = 0.0\nright_friction = 0.1",
            vec!["case.toml:7: contact.right_friction", "allowed: above 0"],
        ),
        (
            "[[contact.other_wheel]]\nwheelset = \"wheelset 9\"\nwheel = \"s1002\"",
            vec!["contact.other_wheel: no wheelset `wheelset 9`, allowed: wheelset 1, wheelset 2"],
        ),
        (
            "gauge = 1.4",
            vec!["unknown field `gauge`", "did you mean `gauge_m`?", "line 6"],
        ),
        ("side = 1", vec!["unknown field `side`"]),
    ] {
        let message = named(table);
        for part in parts {
            assert!(message.contains(part), "{table}: {message}");
        }
    }
    let twice = error(&format!(
        "{CASE}friction = 0.4\n[contact]\nfriction = 0.4\n"
    ));
    assert!(
        twice.contains("case.toml:7") && twice.contains("allowed: one of the two"),
        "{twice}"
    );
    let folder = Folder::new();
    let broken = folder.write("flat.csv", "y_mm,z_mm\n0,0\n1,x\n");
    let message = named(&format!("wheel = {broken:?}"));
    assert!(
        message.contains("case.toml:6: contact.wheel") && message.contains("flat.csv:3"),
        "{message}"
    );
    let mut rail = columns(&uic60::profile(), 0.0);
    rail = rail.replace("y_mm,z_mm\n", "");
    let as_wheel = folder.write("rail.csv", &rail);
    let message = named(&format!("wheel = {as_wheel:?}"));
    assert!(message.contains("contact.wheel"), "{message}");
    // A vehicle file names its own line.
    let coach = VEHICLES[1].1;
    let lines = coach.lines().count();
    let name = folder.write(
        "bad.toml",
        &format!("{coach}\n[contact]\nback_to_datum_m = 0.07\nwheel = \"s1003\"\n"),
    );
    let message = dashpot_files::vehicle::load(&name, &[])
        .unwrap_err()
        .to_string();
    let line = format!(
        "bad.toml:{}: contact.wheel: s1003: no such profile",
        lines + 4
    );
    assert!(message.contains(&line), "{message}");
}

#[test]
fn an_override_names_what_is_wrong() {
    let refused = |assignment: &str| {
        let mut options = CaseOptions::parse("case.toml", CASE).unwrap();
        options.overrides.push(assignment.into());
        options.case().unwrap_err().to_string()
    };
    let unknown = refused("contact.gage_m=1.43");
    assert!(
        unknown.contains("override contact.gage_m=1.43: unknown field `gage_m`"),
        "{unknown}"
    );
    assert!(unknown.contains("did you mean `gauge_m`?"), "{unknown}");
    let wrong_kind = refused("contact.gauge_m='wide'");
    assert!(
        wrong_kind.contains("contact.gauge_m='wide': invalid type"),
        "{wrong_kind}"
    );
}
