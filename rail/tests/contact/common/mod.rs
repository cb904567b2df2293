//! Tables of the default pair, stationary and rolling wheelsets, and the list of creep laws.

use std::sync::{Arc, OnceLock};

use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, PatchSource, RailDisplacement, Steel, Tables,
    WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::{
    CreepLaw, Fastsim, Friction, KalkerBook, KalkerTable, LoadedContact, Polach, ShenHedrickElkins,
};

/// S1002 on UIC 60.
pub fn geometry() -> &'static ContactGeometry {
    static GEOMETRY: OnceLock<ContactGeometry> = OnceLock::new();
    GEOMETRY.get_or_init(|| {
        let pair = Pair::standard(Installation::default()).unwrap();
        ContactGeometry::new(pair, Steel::default()).unwrap()
    })
}

pub fn tables() -> Arc<Tables> {
    static TABLES: OnceLock<Arc<Tables>> = OnceLock::new();
    Arc::clone(TABLES.get_or_init(|| Arc::new(Tables::new(geometry().clone()))))
}

/// Every creep law, with its name in docs/contact.md.
pub fn laws() -> [(&'static str, Box<dyn CreepLaw>); 4] {
    [
        ("Kalker's book of tables", Box::new(KalkerBook::new())),
        ("FASTSIM 80 x 81", Box::new(Fastsim::default())),
        ("Polach", Box::new(Polach)),
        ("Shen-Hedrick-Elkins", Box::new(ShenHedrickElkins)),
    ]
}

pub fn polach() -> &'static WheelsetContact<Polach> {
    static CONTACT: OnceLock<WheelsetContact<Polach>> = OnceLock::new();
    CONTACT.get_or_init(|| WheelsetContact::new(tables(), Polach, Friction::default()).unwrap())
}

/// True if the force and the moment on the wheelset are numbers.
pub fn is_finite(forces: &WheelsetForces) -> bool {
    let mut components = forces.force_n.iter().chain(&forces.moment_n_m);
    components.all(|component| component.is_finite())
}

/// Both rails in their nominal position.
pub const LEVEL: [RailDisplacement; 2] = [RailDisplacement {
    lateral_m: 0.0,
    vertical_m: 0.0,
    lateral_velocity_m_per_s: 0.0,
    vertical_velocity_m_per_s: 0.0,
    roll_rad: 0.0,
    roll_rate_rad_per_s: 0.0,
    yaw_rad: 0.0,
    friction_ratio: 1.0,
}; 2];

/// `motion` at the height at which the rails carry `load_n`, by bisection.
pub fn at_height_under_load<L: CreepLaw, S: PatchSource>(
    contact: &WheelsetContact<L, S>,
    motion: &Motion,
    load_n: f64,
) -> Motion {
    let (mut low, mut high) = (-40e-3, 1e-3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let motion = Motion {
            vertical_m: middle,
            ..*motion
        };
        if -contact.forces(&motion, &LEVEL).force_n[2] < load_n {
            low = middle;
        } else {
            high = middle;
        }
    }
    Motion {
        vertical_m: high,
        ..*motion
    }
}

pub fn rolling(speed_m_per_s: f64) -> Motion {
    Motion {
        speed_m_per_s,
        rotation_rad_per_s: speed_m_per_s / 0.625,
        ..Motion::default()
    }
}

/// A contact of steel with G 82 GPa and Poisson's ratio 0.28.
pub fn contact(load_n: f64, a: f64, b: f64, friction: f64) -> LoadedContact {
    LoadedContact {
        load_n,
        a_m: a,
        b_m: b,
        shear_modulus_pa: 82e9,
        kalker: KalkerTable::new(0.28).unwrap().at(a / b),
        friction,
    }
}
