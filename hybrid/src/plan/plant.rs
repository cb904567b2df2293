//! A vehicle without one of its dampers, and that damper.

use dashpot_rail::vehicle::WithoutDamper;
use nalgebra::{DMatrix, DVector};

use super::error::PlanError;

/// Bounds of damping (N s/m) and stiffness (N/m).
const ALLOWED: [f64; 2] = [1e-9, 1e15];

/// A linear system `x' = A x - b f`, `e = c x`, whose damper is taken out, and the parameters of that damper. `e` (m)
/// is the extension of the damper, and `f` (N) its force, positive if it resists extension.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantWithoutDamper {
    a: DMatrix<f64>,
    b: DVector<f64>,
    c: DVector<f64>,
    damping_n_s_per_m: f64,
    stiffness_n_per_m: f64,
}

impl PlantWithoutDamper {
    /// Checks a plant with the matrix `a` (1/s), the input `b` (per N), the output `c` (m per unit of each state), and
    /// a damper: a dashpot in series with the stiffness of its mounts.
    ///
    /// # Errors
    /// Sizes that do not fit each other, a value that is not finite, or a damper without damping or stiffness.
    pub fn new(
        a: DMatrix<f64>,
        b: DVector<f64>,
        c: DVector<f64>,
        damping_n_s_per_m: f64,
        stiffness_n_per_m: f64,
    ) -> Result<Self, PlanError> {
        let (rows, columns) = a.shape();
        let [inputs, outputs] = [b.len(), c.len()];
        if rows == 0 || [columns, inputs, outputs] != [rows; 3] {
            return Err(PlanError::Shape {
                rows,
                columns,
                inputs,
                outputs,
            });
        }
        for (name, values) in [
            ("matrix", a.as_slice()),
            ("input", b.as_slice()),
            ("output", c.as_slice()),
        ] {
            if !values.iter().all(|value| value.is_finite()) {
                return Err(PlanError::NotFinite { name });
            }
        }
        for (name, value) in [
            ("damping_n_s_per_m", damping_n_s_per_m),
            ("stiffness_n_per_m", stiffness_n_per_m),
        ] {
            if !(ALLOWED[0]..=ALLOWED[1]).contains(&value) {
                let allowed = ALLOWED;
                return Err(PlanError::OutOfBounds {
                    name,
                    value,
                    allowed,
                });
            }
        }
        Ok(Self {
            a,
            b,
            c,
            damping_n_s_per_m,
            stiffness_n_per_m,
        })
    }

    /// The loop `L(s) = C (s 1 - A)^-1 B` with the damper: its `A`, `B` and `C`. The last state is the force `f` of the
    /// damper, `f' = k (e' - f/c_d)`. The extension of the dashpot would do as well, but its difference from `e` is a
    /// matter of rounding in stiff mounts.
    pub(super) fn open_loop(&self) -> (DMatrix<f64>, DVector<f64>, DVector<f64>) {
        let size = self.b.len();
        let k = self.stiffness_n_per_m;
        let mut a = self.a.clone().resize(size + 1, size + 1, 0.0);
        a.view_mut((size, 0), (1, size))
            .copy_from(&(self.c.transpose() * &self.a * k));
        a[(size, size)] = -k / self.damping_n_s_per_m;
        let b = (self.b.clone()).resize_vertically(size + 1, k * self.c.dot(&self.b));
        let mut c = DVector::zeros(size + 1);
        c[size] = 1.0;
        (a, b, c)
    }
}

impl TryFrom<WithoutDamper> for PlantWithoutDamper {
    type Error = PlanError;

    fn try_from(vehicle: WithoutDamper) -> Result<Self, PlanError> {
        Self::new(
            vehicle.state_matrix,
            vehicle.input,
            vehicle.output,
            vehicle.damping_n_s_per_m,
            vehicle.stiffness_n_per_m,
        )
    }
}
