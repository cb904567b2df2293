//! Vehicle files: errors with file, line and the name of the part.

use dashpot_files::vehicle;

const WAGON: &str = r#"name = "wagon"

[[body]]
name = "body"
mass_kg = 30e3
roll_inertia_kg_m2 = 40e3
pitch_inertia_kg_m2 = 900e3
yaw_inertia_kg_m2 = 900e3
x_m = 0
height_m = 1.5

[[wheelset]]
name = "axle"
mass_kg = 1500
roll_inertia_kg_m2 = 800
spin_inertia_kg_m2 = 100
yaw_inertia_kg_m2 = 800
radius_m = 0.46
x_m = [4, -4]

[[bush]]
name = "spring"
between = ["track", "body"]
stiffness_n_per_m = [5e6, 5e6, 1e6]
damping_n_s_per_m = [0, 0, 20e3]
stiffness_n_m_per_rad = [1e6, 1e6, 1e6]
damping_n_m_s_per_rad = [0, 0, 0]
at_m = [[4, -1, 0.46], [4, 1, 0.46], [-4, -1, 0.46], [-4, 1, 0.46]]

[[bump_stop]]
name = "stop"
between = ["axle 1", "body"]
direction = "lateral"
points_m_n = [[0.02, 0], [0.03, 10e3]]
at_m = [[4, 0, 0.46]]

[[friction]]
name = "friction"
between = ["track", "body"]
direction = "vertical"
stiffness_n_per_m = 5e6
friction_n = 100
friction_coefficient = 0.06
load_of = "spring"
at_m = [[4, -1, 0.46], [4, 1, 0.46]]

[[damper]]
name = "damper"
between = ["axle 2", "body"]
direction = "lateral"
damper = "reduced-lateral"
at_m = [[-4, 0, 0.46]]

[[ride_point]]
name = "seat"
body = "body"
at_m = [4, 0.5, 1.1]
"#;

#[test]
fn errors_have_file_line_and_name() {
    assert!(vehicle::parse("wagon.toml", WAGON, &[]).is_ok());
    for (from, to, expected) in [
        (
            "mass_kg = 30e3",
            "mass_kg = -30e3",
            "wagon.toml:4: body: mass_kg = -30000, allowed: 1 to 1000000",
        ),
        (
            "mass_kg = 30e3",
            "mas_kg = 30e3",
            "wagon.toml: TOML parse error at line 5, column 1",
        ),
        (
            "radius_m = 0.46",
            "radius_m = -1",
            "wagon.toml:13: axle 1: height_m = -1, allowed: 0 to 10",
        ),
        (
            "[\"axle 2\", \"body\"]",
            "[\"axle 3\", \"body\"]",
            "wagon.toml:48: damper 1: attached to axle 3, which does not exist; allowed: body, axle 1, axle 2",
        ),
        (
            "[\"axle 1\", \"body\"]",
            "[\"body\", \"body\"]",
            "wagon.toml:31: stop 1: both ends are on body",
        ),
        (
            "[0.02, 0], ",
            "",
            "wagon.toml:31: stop 1: points of a stop, allowed: 2 to 16 points",
        ),
        (
            "name = \"stop\"",
            "name = \"spring\"",
            "wagon.toml:22: spring 1: used twice",
        ),
        (
            "load_of = \"spring\"",
            "load_of = \"stop\"",
            "wagon.toml:38: friction 1: friction follows the load of stop 1, which is not a spring with vertical \
             stiffness; allowed: spring 1, spring 2, spring 3, spring 4",
        ),
        (
            "load_of = \"spring\"",
            "",
            "wagon.toml:38: friction: friction_coefficient and load_of, allowed: both or neither",
        ),
        (
            "friction_n = 100\nfriction_coefficient = 0.06\nload_of = \"spring\"",
            "",
            "wagon.toml:38: friction: no friction, allowed: friction_n, or friction_coefficient and load_of",
        ),
        (
            "friction_n = 100",
            "friction_n = -100",
            "wagon.toml:38: friction 1: friction_n = -100, allowed: 0 to 100000000",
        ),
        (
            "\"reduced-lateral\"",
            "\"none.toml\"",
            "wagon.toml:48: damper: none.toml: cannot read",
        ),
        (
            "body = \"body\"",
            "body = \"axle 1\"",
            "wagon.toml:55: seat: on axle 1, which is not a body; allowed: body",
        ),
        (
            "0.5, 1.1]",
            "0.5, 11]",
            "wagon.toml:55: seat: height_m = 11, allowed: 0 to 10",
        ),
        (
            "[4, 0.5, 1.1]",
            "[4, 0.5]",
            "wagon.toml: TOML parse error at line 57, column 8",
        ),
        (
            "direction = \"lateral\"\npoints",
            "direction = \"lateraly\"\npoints",
            "line 33",
        ),
    ] {
        let text = WAGON.replacen(from, to, 1);
        assert_ne!(text, WAGON, "{from}");
        let error = vehicle::parse("wagon.toml", &text, &[])
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{error}\nexpected {expected}");
    }
}
