//! Regression: tables of worn profiles whose force jumps between poses were accepted without an error.

use std::f64::consts::TAU;

use dashpot_rail::contact::{
    ContactGeometry, Grid, Installation, Jump, Pair, Steel, Tables, TablesError, TabulatedPatch,
    WheelPose, ZONES,
};
use dashpot_rail::profile::measured::{self, Mirror, Options};
use dashpot_rail::profile::{Body, Profile, s1002, uic60};

/// A grid with few rolls and yaws, and the default shifts where there is contact.
fn grid() -> Grid {
    let mut grid = Grid::default();
    grid.lateral_m.cells = [40, 400, 40];
    grid.roll_rad.cells = [1, 2, 1];
    grid.yaw_squared_rad2.cells = [0, 1, 1];
    grid
}

fn geometry(wheel: Profile, rail: &Profile, nominal_load_n: f64) -> ContactGeometry {
    let pair = Pair::new(wheel, rail, Installation::default()).unwrap();
    ContactGeometry::new(pair, Steel::default(), nominal_load_n).unwrap()
}

/// S1002 with waves of 8 mm length and 60 um amplitude on the tread: more summits than zones.
fn worn_wheel() -> Profile {
    let wave = |y: f64| {
        let ramp = |t: f64| t.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * t.clamp(0.0, 1.0));
        60e-6 * ramp((y + 0.03) / 0.01) * ramp((0.05 - y) / 0.01) * (TAU * y / 0.008).sin()
    };
    let points: Vec<[f64; 2]> = s1002::profile()
        .points()
        .iter()
        .map(|point| [point.y_m, point.z_m + wave(point.y_m)])
        .collect();
    Profile::through("worn", &points, 0.0).unwrap()
}

/// Vertical force of all patches at a depth of the tread datum, N.
fn force_n(patches: &[TabulatedPatch; ZONES], depth_m: f64) -> f64 {
    let force = |patch: &TabulatedPatch| {
        let cosine = patch.slope.atan().cos();
        let penetration = (patch.interpenetration_m + depth_m) * cosine;
        patch.load_fraction * patch.hertz.load_n(penetration) * cosine
    };
    patches.iter().map(force).sum()
}

/// Change of the force over 0.1 um of shift about a pose, at the height at which the wheel carries a load, N.
fn change_n(geometry: &ContactGeometry, pose: &WheelPose, load_n: f64) -> f64 {
    let at = |by_m: f64| {
        let lateral_m = pose.lateral_m + by_m;
        geometry.patches(&WheelPose { lateral_m, ..*pose }, &mut Vec::new())
    };
    let (before, after) = (at(-0.05e-6), at(0.05e-6));
    let (mut low, mut high) = (-0.05, 0.05);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if force_n(&before, middle) < load_n {
            low = middle;
        } else {
            high = middle;
        }
    }
    (force_n(&after, high) - load_n).abs()
}

#[test]
fn a_worn_wheel_whose_force_jumps_is_rejected_with_its_pose() {
    let geometry = geometry(worn_wheel(), &uic60::profile(), 100e3);
    let error = Tables::new(geometry.clone(), grid()).unwrap_err();
    let TablesError::Jump { wheel, rail, jump } = &error else {
        panic!("{error}");
    };
    let Jump {
        pose,
        load_n,
        jump_n,
        ..
    } = *jump;
    assert_eq!((wheel.as_str(), rail.as_str()), ("worn", "UIC 60"));
    let place = format!("lateral shift of {:.6} m", pose.lateral_m);
    let size = format!("jumps by {jump_n:.0} N under a load of {load_n:.0} N");
    let text = error.to_string();
    assert!(text.contains(&place) && text.contains(&size), "{text}");
    // The same change of the force, computed from the geometry itself.
    let found = change_n(&geometry, &pose, load_n);
    assert!(
        (found / jump_n - 1.0).abs() < 0.6 && found > 0.1 * load_n,
        "{found}: {text}"
    );
    // One micrometre away there is no jump.
    let beside = WheelPose {
        lateral_m: pose.lateral_m + 1e-6,
        ..pose
    };
    let found = change_n(&geometry, &beside, load_n);
    assert!(found < 0.02 * load_n, "{found}");
}

/// The cache rejects such a pair as well.
#[test]
fn a_cache_rejects_it_too_and_stores_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let geometry = geometry(worn_wheel(), &uic60::profile(), 100e3);
    for _ in 0..2 {
        let error = Tables::cached(folder.path(), geometry.clone(), grid()).unwrap_err();
        assert!(error.to_string().contains("the force jumps"), "{error}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    assert!(Tables::kept(folder.path(), geometry, grid()).is_err());
}

/// Tread and flange of S1002 touch UIC 60 simultaneously, and the load moves from one to the other within hundredths of
/// a millimetre. Under usual wheel loads that is not a jump.
#[test]
fn the_shipped_pair_passes_under_any_wheel_load() {
    for nominal_load_n in [15e3, 20e3, 29e3, 40e3, 53e3, 75e3, 101.3e3, 130e3] {
        let geometry = geometry(s1002::profile().clone(), &uic60::profile(), nominal_load_n);
        let jump = Tables::greatest_jump(&geometry, &grid()).unwrap();
        let excess = jump.map_or(0.0, |jump| jump.excess());
        assert!(excess < 0.02, "{nominal_load_n} N: {jump:?}");
    }
}

#[test]
fn the_sample_files_pass() {
    let read = |name: &str, body: Body, mirror: Option<Mirror>| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/");
        let text = std::fs::read_to_string(format!("{folder}{name}")).unwrap();
        let options = Options::default().with_mirror(mirror);
        measured::parse(name, &text, body, &options).unwrap().0
    };
    for (wheel, rail, mirror) in [
        ("s1002.csv", "uic60.csv", None),
        ("s1002.whl", "uic60.ban", None),
        ("s1002.prw", "uic60.prr", None),
        ("s1002.wheel", "uic60.rail", Some(Mirror::Y)),
    ] {
        let rail = read(rail, Body::Rail, mirror);
        let geometry = geometry(read(wheel, Body::Wheel, None), &rail, 100e3);
        let jump = Tables::greatest_jump(&geometry, &grid()).unwrap();
        let excess = jump.map_or(0.0, |jump| jump.excess());
        assert!(excess < 0.02, "{wheel}: {jump:?}");
    }
}
