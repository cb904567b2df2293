//! Rejection of invalid elastic constants and frictions; types that can be shared between threads.

use dashpot_rail::contact::{
    ContactGeometry, GeometryError, Installation, InstallationError, Motion, NotKept,
    NotTheseTables, Pair, PairError, Steel, SteelError, SurfaceError, Tables, WheelsetContact,
    WheelsetForces,
};
use dashpot_rail::creep::{CreepLaw, Friction, FrictionError, KalkerError, KalkerTable, Polach};
use dashpot_rail::indices::{RollingRadiusDifference, RollingRadiusError};
use dashpot_rail::profile::{CurveError, Profile, measured::ProfileError};

use crate::common::tables;

#[test]
fn elastic_constants_out_of_bounds_are_rejected() {
    let refused = |steel: Steel| {
        let pair = Pair::standard(Installation::default()).unwrap();
        ContactGeometry::new(pair, steel).unwrap_err()
    };
    let steel = Steel::default();
    for young_modulus_pa in [0.0, -210e9, 1e13, f64::NAN] {
        let bad = steel.with_young_modulus_pa(young_modulus_pa);
        assert!(matches!(
            refused(bad),
            GeometryError::Steel(SteelError::YoungModulus { .. })
        ));
    }
    for poisson_ratio in [-0.1, 0.6, f64::NAN] {
        let bad = steel.with_poisson_ratio(poisson_ratio);
        assert!(matches!(
            refused(bad),
            GeometryError::Steel(SteelError::PoissonRatio { .. })
        ));
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
    shared::<(NotKept, NotTheseTables, GeometryError, SurfaceError)>();
    shared::<(KalkerError, RollingRadiusError, ContactGeometry)>();
}
