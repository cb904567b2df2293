//! One harmonic of a plate's deflection, in cubic Hermite elements over the radius.

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

use super::quadrature::points;

/// A function of the radius, given by value and slope at the nodes and cubic between them.
#[derive(Clone, Debug)]
pub(super) struct Harmonic {
    /// Order m of `cos(m t)`.
    pub(super) order: f64,
    /// Value and slope at each node.
    values: Vec<Vector2<f64>>,
}

/// Value and first two derivatives of a function of the radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct Derivatives {
    pub(super) value: f64,
    pub(super) first: f64,
    pub(super) second: f64,
}

/// Returns the shape functions of an element (value and slope at its start, then at its end) and their first two
/// derivatives at `fraction` of its length.
fn shapes(fraction: f64, length: f64) -> [Vector4<f64>; 3] {
    let (x, l) = (fraction, length);
    let value = Vector4::new(
        1.0 - x * x * (3.0 - 2.0 * x),
        l * x * (1.0 - x) * (1.0 - x),
        x * x * (3.0 - 2.0 * x),
        l * x * x * (x - 1.0),
    );
    let first = Vector4::new(
        -6.0 * x * (1.0 - x) / l,
        1.0 - x * (4.0 - 3.0 * x),
        6.0 * x * (1.0 - x) / l,
        x * (3.0 * x - 2.0),
    );
    let second = Vector4::new(
        (12.0 * x - 6.0) / (l * l),
        (6.0 * x - 4.0) / l,
        (6.0 - 12.0 * x) / (l * l),
        (6.0 * x - 2.0) / l,
    );
    [value, first, second]
}

impl Harmonic {
    /// Solves a plate of unit bending stiffness under the pressure `load(r) cos(m t)`, clamped at the first node and
    /// free at the last; `None` if rounding makes the stiffness matrix singular.
    ///
    /// Principle of virtual work in polar coordinates, integrated over `r dr`, with the curvatures
    /// `k_r = w''`, `k_t = w'/r - m^2 w/r^2` and `k_rt = m (w'/r - w/r^2)`:
    /// `k_r k_r + k_t k_t + nu (k_r k_t + k_t k_r) + 2 (1 - nu) k_rt k_rt = load w`.
    pub(super) fn solve(
        nodes: &[f64],
        order: f64,
        poisson_ratio: f64,
        load: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        // Value and slope are zero at the clamped first node, so the chain of blocks starts at the second.
        let mut chain = Chain::default();
        for (i, pair) in nodes.windows(2).enumerate() {
            let (stiffness, force) = element(pair[0], pair[1], order, poisson_ratio, &load);
            let end = stiffness.fixed_view::<2, 2>(2, 2).into_owned();
            let end_force = force.fixed_rows::<2>(2).into_owned();
            if i > 0 {
                let start = stiffness.fixed_view::<2, 2>(0, 0).into_owned();
                let start_force = force.fixed_rows::<2>(0).into_owned();
                let between = stiffness.fixed_view::<2, 2>(0, 2).into_owned();
                chain.close(start, start_force, between)?;
            }
            chain.open(end, end_force);
        }
        let mut values = chain.solve()?;
        values.push(Vector2::zeros());
        values.reverse();
        Some(Self { order, values })
    }

    /// Returns value and derivatives at `radius`, which is in the element that starts at node `element`.
    pub(super) fn at(&self, nodes: &[f64], element: usize, radius: f64) -> Derivatives {
        let (start, end) = (nodes[element], nodes[element + 1]);
        let length = end - start;
        let (a, b) = (self.values[element], self.values[element + 1]);
        let values = Vector4::new(a.x, a.y, b.x, b.y);
        let [value, first, second] =
            shapes((radius - start) / length, length).map(|shape| shape.dot(&values));
        Derivatives {
            value,
            first,
            second,
        }
    }

    /// Returns the value at the last node.
    pub(super) fn at_edge(&self) -> f64 {
        self.values.last().map_or(0.0, |value| value.x)
    }
}

/// Returns the stiffness matrix and load vector of the element between two radii.
fn element(
    start: f64,
    end: f64,
    order: f64,
    nu: f64,
    load: impl Fn(f64) -> f64,
) -> (Matrix4<f64>, Vector4<f64>) {
    let (mut stiffness, mut force) = (Matrix4::zeros(), Vector4::zeros());
    let length = end - start;
    for (r, weight) in points(start, end) {
        let [w, w1, w2] = shapes((r - start) / length, length);
        let tangential = w1 / r - w * (order * order / (r * r));
        let twist = (w1 / r - w / (r * r)) * order;
        let across = w2 * tangential.transpose();
        stiffness += (w2 * w2.transpose()
            + tangential * tangential.transpose()
            + (across + across.transpose()) * nu
            + twist * twist.transpose() * (2.0 * (1.0 - nu)))
            * (weight * r);
        force += w * (weight * r * load(r));
    }
    (stiffness, force)
}

/// Block row of an eliminated node.
struct EliminatedBlock {
    /// Inverse of the diagonal block.
    inverse: Matrix2<f64>,
    force: Vector2<f64>,
    /// Coupling to the next node.
    coupling: Matrix2<f64>,
}

/// Elimination of a symmetric block tridiagonal system.
#[derive(Default)]
struct Chain {
    eliminated: Vec<EliminatedBlock>,
    diagonal: Matrix2<f64>,
    force: Vector2<f64>,
}

impl Chain {
    /// Starts a node: adds the contribution of the element before it.
    fn open(&mut self, diagonal: Matrix2<f64>, force: Vector2<f64>) {
        self.diagonal += diagonal;
        self.force += force;
    }

    /// Completes the node: adds the contribution of the element after it, and eliminates it.
    fn close(
        &mut self,
        diagonal: Matrix2<f64>,
        force: Vector2<f64>,
        coupling: Matrix2<f64>,
    ) -> Option<()> {
        let inverse = (self.diagonal + diagonal).try_inverse()?;
        let force = self.force + force;
        self.eliminated.push(EliminatedBlock {
            inverse,
            force,
            coupling,
        });
        self.diagonal = -coupling.transpose() * inverse * coupling;
        self.force = -coupling.transpose() * inverse * force;
        Some(())
    }

    /// Returns the solution from the last node back to the first.
    fn solve(self) -> Option<Vec<Vector2<f64>>> {
        let mut next = self.diagonal.try_inverse()? * self.force;
        let mut values = vec![next];
        for node in self.eliminated.into_iter().rev() {
            next = node.inverse * (node.force - node.coupling * next);
            values.push(next);
        }
        Some(values)
    }
}
