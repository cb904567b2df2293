//! Grids and steels that tables refuse, and what can be shared between threads.

use dashpot_rail::contact::{
    Grid, Installation, InstallationError, Motion, Pair, PairError, Steel, Tables, TablesError,
    WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::{CreepLaw, KalkerError, KalkerTable, Polach};
use dashpot_rail::indices::{RollingRadiusDifference, RollingRadiusError};
use dashpot_rail::profile::{CurveError, Profile, measured::ProfileError};

fn refused(steel: Steel, change: impl Fn(&mut Grid)) -> TablesError {
    let pair = Pair::standard(Installation::default()).unwrap();
    let mut grid = Grid::default();
    change(&mut grid);
    Tables::new(pair, steel, grid).unwrap_err()
}

#[test]
fn grids_without_a_cell_or_an_order_are_refused() {
    type Change = fn(&mut Grid);
    let changes: [(&str, Change); 7] = [
        ("lateral_m", |grid| grid.lateral_m.cells = [0; 3]),
        ("lateral_m", |grid| grid.lateral_m.cells = [32, 0, 212]),
        ("lateral_m", |grid| grid.lateral_m.cells = [usize::MAX; 3]),
        ("roll_rad", |grid| grid.roll_rad.ends[1] = -0.1),
        ("roll_rad", |grid| grid.roll_rad.ends[3] = f64::NAN),
        ("yaw_squared_rad2", |grid| {
            grid.yaw_squared_rad2.ends[0] = -1e-4;
            grid.yaw_squared_rad2.cells[0] = 1;
        }),
        ("yaw_squared_rad2", |grid| {
            grid.yaw_squared_rad2.cells[0] = 1
        }),
    ];
    for (expected, change) in changes {
        let error = refused(Steel::default(), change);
        assert!(
            matches!(error, TablesError::Axis { name, .. } if name == expected),
            "{expected}: {error}"
        );
    }
    let huge = refused(Steel::default(), |grid| grid.lateral_m.cells[1] = 1_000_000);
    assert!(matches!(huge, TablesError::TooManyNodes { .. }), "{huge}");
}

#[test]
fn elastic_constants_out_of_bounds_are_refused() {
    let steel = Steel::default();
    for young_modulus_pa in [0.0, -210e9, f64::NAN] {
        let error = refused(
            Steel {
                young_modulus_pa,
                ..steel
            },
            |_| {},
        );
        assert!(matches!(error, TablesError::YoungModulus { .. }), "{error}");
    }
    let error = refused(
        Steel {
            poisson_ratio: 0.6,
            ..steel
        },
        |_| {},
    );
    assert!(matches!(error, TablesError::Kalker(_)), "{error}");
}

#[test]
fn every_type_can_be_shared_between_threads() {
    fn shared<T: Send + Sync + ?Sized>() {}
    shared::<(Profile, Pair, Tables, KalkerTable)>();
    shared::<(WheelsetContact<Polach>, Motion, WheelsetForces)>();
    shared::<dyn CreepLaw>();
    shared::<RollingRadiusDifference>();
    shared::<(CurveError, ProfileError, InstallationError, PairError)>();
    shared::<(TablesError, KalkerError, RollingRadiusError)>();
}
