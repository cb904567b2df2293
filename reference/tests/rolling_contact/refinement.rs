//! Convergence of the solution with its mesh.

use dashpot_reference::ReferenceError;
use dashpot_reference::rolling_contact::{RollingContact, ScaledForces};

fn forces(a_over_b: f64, creepage: [f64; 3], [along, strips]: [usize; 2]) -> ScaledForces {
    let contact = RollingContact::with_mesh(a_over_b, 0.28, along, strips).unwrap();
    contact.solve(creepage).unwrap()
}

fn distance(one: ScaledForces, other: ScaledForces) -> f64 {
    let squares = one.iter().zip(other).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

#[test]
fn a_finer_mesh_changes_less() {
    for (a_over_b, creepage) in [
        (1.0, [0.3, 0.2, 0.0]),
        (2.0, [0.3, -0.3, 0.4]),
        (0.5, [0.2, 0.2, 0.6]),
        (0.2, [0.2, 0.2, 0.4]),
    ] {
        let meshes = [[8, 4], [16, 8], [32, 12], [64, 16]];
        let all = meshes.map(|mesh| forces(a_over_b, creepage, mesh));
        let finest = all[3];
        let errors: Vec<f64> = all.iter().map(|&f| distance(f, finest)).collect();
        let usual = forces(a_over_b, creepage, RollingContact::usual_mesh(a_over_b));
        let usual_error = distance(usual, finest);
        println!("a/b {a_over_b} {creepage:?}: {errors:.4?}, usual {usual_error:.4}");
        // The convergence is at least of first order.
        assert!(errors[2] < 0.5 * errors[0], "{errors:?}");
        assert!(usual_error < 0.006, "{usual_error}");
    }
}

#[test]
fn a_long_contact_has_the_forces_of_a_finer_mesh() {
    // Spin opposite to lateral creepage, the case that is most sensitive to the number of strips.
    for (a_over_b, creepage) in [
        (6.0, [0.01, 0.03, 0.06]),
        (12.0, [0.006, 0.02, 0.025]),
        (18.0, [-0.326, 0.239, -0.159]),
        (25.0, [0.0036, 0.0107, 0.0131]),
    ] {
        let [along, strips] = RollingContact::usual_mesh(a_over_b);
        let usual = forces(a_over_b, creepage, [along, strips]);
        let finer = forces(a_over_b, creepage, [along * 3 / 2, strips * 3 / 2]);
        println!("a/b {a_over_b} {creepage:?}: {usual:.4?} {finer:.4?}");
        let off = (usual[0] - finer[0]).hypot(usual[1] - finer[1]);
        // The convergence is of second order in the strips: the error of the usual mesh is 1.8 times this difference,
        // so it is within 1 %.
        assert!(off < 0.005, "{a_over_b}: {off}");
    }
}

#[test]
fn invalid_contacts_are_refused() {
    for (a_over_b, poisson_ratio) in [(0.0, 0.3), (f64::NAN, 0.3), (1.0, 0.6), (-1.0, 0.3)] {
        let error = RollingContact::new(a_over_b, poisson_ratio).err();
        assert!(matches!(error, Some(ReferenceError::RollingContact { .. })));
    }
    let contact = RollingContact::new(1.0, 0.3).unwrap();
    let error = contact.solve([f64::NAN, 0.0, 0.0]).unwrap_err();
    assert!(matches!(error, ReferenceError::RollingDiverges { .. }));
}
