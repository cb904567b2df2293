//! The laws of Polach and of Shen, Hedrick and Elkins, compared with results of other implementations.
//!
//! Polach: the subroutine of the 1999 paper, evaluated in Python as implemented by two public codes,
//! leo-bart/mbs-flex-rail (from the FORTRAN) and wangjianbin123/OpenVSD. Each code agrees with these numbers except in
//! one respect. The first takes the smaller of the lateral creepages with and without spin, so that pure spin would
//! cause no force. In the second, the force caused by spin has the opposite sign, contrary to Kalker's linear theory.
//! Shen, Hedrick and Elkins: `mu N (1 - (1 - f / 3)^3)` in Python.

use dashpot_rail::creep::{
    CreepForces, CreepLaw, Creepage, KalkerCoefficients, LoadedContact, Polach, ShenHedrickElkins,
};

const CONTACTS: [LoadedContact; 2] = [
    LoadedContact {
        load_n: 80e3,
        a_m: 6e-3,
        b_m: 4e-3,
        shear_modulus_pa: 82e9,
        kalker: KalkerCoefficients {
            c11: 4.62,
            c22: 4.31,
            c23: 1.85,
            c33: 0.7,
        },
        friction: 0.3,
    },
    LoadedContact {
        load_n: 50e3,
        a_m: 2e-3,
        b_m: 7e-3,
        shear_modulus_pa: 80e9,
        kalker: KalkerCoefficients {
            c11: 3.5,
            c22: 2.7,
            c23: 0.7,
            c33: 1.5,
        },
        friction: 0.4,
    },
];

/// Index of the contact; longitudinal creepage, lateral creepage and spin; forces by Polach; forces by Shen, Hedrick
/// and Elkins, N.
type Row = (usize, [f64; 3], [f64; 2], [f64; 2]);

#[rustfmt::skip]
const ROWS: [Row; 14] = [
    (0, [0.001, -0.0005, 0.0], [-8385.361410, 4192.680705], [-7884.083862, 3677.532624]),
    (0, [0.0005, 0.001, 0.4], [-2820.710966, -12214.138617], [-3596.450367, -12354.421707]),
    (0, [0.0005, 0.001, -0.1], [-4042.423024, -6499.499628], [-4054.090908, -5973.534111]),
    (0, [-0.001, 0.002, -1.2], [4162.806523, 9531.449770], [7874.305805, 3844.662973]),
    (0, [0.0, 0.0, 0.5], [0.0, -8434.612287], [0.0, -7859.090492]),
    (0, [0.002, 0.0, 5.0], [-1595.523895, -6078.282186], [-4795.018055, -23516.117916]),
    (0, [0.05, -0.03, 0.2], [-20578.074951, 12221.477285], [-21012.359816, 11596.582900]),
    (1, [0.001, -0.0005, 0.0], [-3691.358340, 1845.679170], [-3651.909673, 1408.593731]),
    (1, [0.0005, 0.001, 0.4], [-1554.391111, -4197.966792], [-1812.567694, -3881.654181]),
    (1, [0.0005, 0.001, -0.1], [-1590.458346, -2921.562503], [-1852.249217, -2580.536656]),
    (1, [-0.001, 0.002, -1.2], [3062.589693, -3118.053147], [3623.157432, -2336.427019]),
    (1, [0.0, 0.0, 0.5], [0.0, -1449.833992], [0.0, -1431.166926]),
    (1, [0.002, 0.0, 5.0], [-3637.541579, -5754.074380], [-5867.650498, -10977.368915]),
    (1, [0.05, -0.03, 0.2], [-17138.124444, 10275.094866], [-18170.748434, 8356.069732]),
];

#[test]
fn the_closed_form_laws_agree_with_other_implementations() {
    for (contact, [longitudinal, lateral, spin], polach, she) in ROWS {
        let contact = &CONTACTS[contact];
        let creepage = Creepage {
            longitudinal,
            lateral,
            spin_per_m: spin,
        };
        let compare = |name: &str, forces: CreepForces, [x, y]: [f64; 2]| {
            // The numbers are rounded to a millionth of a newton.
            let off = (forces.longitudinal_n - x).hypot(forces.lateral_n - y);
            assert!(off < 2e-6, "{name} {creepage:?}: {forces:?} for {x} {y}");
        };
        compare(
            "Polach",
            Polach.unlimited_forces(contact, &creepage),
            polach,
        );
        compare(
            "she",
            ShenHedrickElkins.unlimited_forces(contact, &creepage),
            she,
        );
    }
}
