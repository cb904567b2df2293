//! Rejection of invalid grids, elastic constants and frictions; types that can be shared between threads.

use dashpot_rail::contact::{
    ContactGeometry, GeometryError, Grid, Installation, InstallationError, Motion, Pair, PairError,
    Steel, SteelError, SurfaceError, Tables, TablesError, WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::{CreepLaw, Friction, FrictionError, KalkerError, KalkerTable, Polach};
use dashpot_rail::indices::{RollingRadiusDifference, RollingRadiusError};
use dashpot_rail::profile::{CurveError, Profile, measured::ProfileError};

use crate::common::{geometry, tables};

fn refused(change: impl Fn(&mut Grid)) -> TablesError {
    let mut grid = Grid::default();
    change(&mut grid);
    Tables::new(geometry().clone(), grid).unwrap_err()
}

#[test]
fn grids_without_cells_or_order_are_rejected() {
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
        let error = refused(change);
        assert!(
            matches!(error, TablesError::Axis { name, .. } if name == expected),
            "{expected}: {error}"
        );
    }
    let huge = refused(|grid| grid.lateral_m.cells[1] = 1_000_000);
    assert!(matches!(huge, TablesError::TooManyNodes { .. }), "{huge}");
}

#[test]
fn elastic_constants_and_loads_out_of_bounds_are_rejected() {
    let refused = |steel: Steel, nominal_load_n: f64| {
        let pair = Pair::standard(Installation::default()).unwrap();
        ContactGeometry::new(pair, steel, nominal_load_n).unwrap_err()
    };
    let steel = Steel::default();
    for young_modulus_pa in [0.0, -210e9, 1e13, f64::NAN] {
        let bad = steel.with_young_modulus_pa(young_modulus_pa);
        assert!(matches!(
            refused(bad, 100e3),
            GeometryError::Steel(SteelError::YoungModulus { .. })
        ));
    }
    for poisson_ratio in [-0.1, 0.6, f64::NAN] {
        let bad = steel.with_poisson_ratio(poisson_ratio);
        assert!(matches!(
            refused(bad, 100e3),
            GeometryError::Steel(SteelError::PoissonRatio { .. })
        ));
    }
    for nominal_load_n in [0.0, -100e3, 1e7, f64::NAN] {
        let error = refused(steel, nominal_load_n);
        assert!(
            error.to_string().contains("allowed: 100 to 1000000 N"),
            "{error}"
        );
    }
}

#[test]
fn frictions_and_dampings_out_of_bounds_are_rejected() {
    let friction = Friction::default();
    for bad in [
        friction.with_static_coefficient(-0.1),
        friction.with_static_coefficient(f64::NAN),
        friction.with_residual_ratio(1.1),
        friction.with_decay_speed_m_per_s(0.0),
    ] {
        let error = WheelsetContact::new(tables(), Polach, bad).unwrap_err();
        assert!(matches!(
            error,
            SurfaceError::Friction(FrictionError::OutOfBounds { .. })
        ));
        assert!(error.to_string().contains("allowed: "), "{error}");
    }
    for damping in [-1.0, 101.0, f64::NAN] {
        let contact = WheelsetContact::new(tables(), Polach, friction).unwrap();
        let error = contact.with_normal_damping(damping).unwrap_err();
        assert!(
            matches!(error, SurfaceError::NormalDamping { .. }),
            "{error}"
        );
    }
}

#[test]
fn every_type_can_be_shared_between_threads() {
    fn shared<T: Send + Sync + ?Sized>() {}
    shared::<(Profile, Pair, Tables, KalkerTable)>();
    shared::<(WheelsetContact<Polach>, Motion, WheelsetForces)>();
    shared::<dyn CreepLaw>();
    shared::<RollingRadiusDifference>();
    shared::<(CurveError, ProfileError, InstallationError, PairError)>();
    shared::<(TablesError, GeometryError, SurfaceError)>();
    shared::<(KalkerError, RollingRadiusError, ContactGeometry)>();
}
