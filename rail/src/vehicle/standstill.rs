//! A vehicle at standstill on rigid rails.

use nalgebra::{DVector, SymmetricEigen, Vector3};

use super::GRAVITY_M_PER_S2;
use super::body::{Body, COORDINATES, Coordinate, Wheelset};
use super::element::{Element, End, Law};
use super::error::VehicleError;
use super::linear::{Attachment, Linear};
use super::modes::{self, Mode};
use super::parameters::VehicleParameters;

/// A vehicle at standstill: the rails hold its wheelsets, and its bodies rest on their elements.
#[derive(Debug, Clone)]
pub struct Standstill {
    bodies: Vec<Body>,
    linear: Linear,
    displacements: DVector<f64>,
    /// Force of each element on its second end, N.
    forces: Vec<Vector3<f64>>,
    axle_loads_n: Vec<f64>,
}

/// A body with a lower natural frequency counts as not held, Hz.
const MIN_FREQUENCY_HZ: f64 = 0.01;

/// Minimum load of a spring at standstill that friction can follow, N.
const MIN_LOAD_N: f64 = 1.0;

impl Standstill {
    /// Computes the equilibrium under gravity: the displacements of the bodies from their unloaded positions, the
    /// forces of the elements, and the geometric stiffness due to these forces. Friction elements exert no force in
    /// equilibrium, and stick in the equations of motion.
    ///
    /// # Errors
    /// A value out of bounds, a duplicate name, an element on a missing body, a body that no element holds or that tips
    /// over under its weight, or friction that follows a spring without load.
    pub fn new(vehicle: &VehicleParameters) -> Result<Self, VehicleError> {
        let bodies = &vehicle.bodies;
        check(vehicle)?;
        let mut linear = Linear::new(bodies);
        let ends = attach(vehicle, false)?;
        for (element, (ends, line)) in vehicle.elements.iter().zip(&ends) {
            linear.add(element, ends, *line);
        }
        if let Some((body, coordinate)) = not_held(&linear, bodies) {
            return Err(VehicleError::NotHeld { body, coordinate });
        }
        let weight = DVector::from_fn(linear.inertia.len(), |i, _| {
            if COORDINATES[i % COORDINATES.len()] == Coordinate::Vertical {
                linear.inertia[i] * GRAVITY_M_PER_S2
            } else {
                0.0
            }
        });
        let displacements = linear
            .stiffness
            .clone()
            .cholesky()
            .ok_or(VehicleError::NoModes)?
            .solve(&weight);
        let forces: Vec<Vector3<f64>> = vehicle
            .elements
            .iter()
            .zip(&ends)
            .map(|(element, (ends, line))| {
                let displacement = linear.displacement(ends) * &displacements;
                -element
                    .law
                    .spring_force(displacement.fixed_rows::<3>(0).into(), *line)
            })
            .collect();
        for ((ends, _), force) in ends.iter().zip(&forces) {
            linear.add_preload(ends, *force);
        }
        for (element, (ends, _)) in vehicle.elements.iter().zip(&ends) {
            check_load(element, &vehicle.elements, &forces)?;
            linear.add_sticking(element, ends);
        }
        // Springs that hold a body without its weight may not hold it with it.
        if let Some((body, _)) = not_held(&linear, bodies) {
            return Err(VehicleError::TipsOver { body });
        }
        let wheelsets = wheelset_bodies(vehicle);
        let mut axle_loads_n: Vec<f64> = wheelsets
            .iter()
            .map(|wheelset| wheelset.mass_kg * GRAVITY_M_PER_S2)
            .collect();
        for (element, force) in vehicle.elements.iter().zip(&forces) {
            for (end, sign) in element.ends.iter().zip([-1.0, 1.0]) {
                if let Some(index) = index_of(&wheelsets, end) {
                    axle_loads_n[index] += sign * force.z;
                }
            }
        }
        Ok(Self {
            bodies: bodies.clone(),
            linear,
            displacements,
            forces,
            axle_loads_n,
        })
    }

    /// Returns the load of each wheelset on the rails, N.
    pub fn axle_loads_n(&self) -> &[f64] {
        &self.axle_loads_n
    }

    /// Force of each element on its second end, N.
    pub(super) fn forces(&self) -> &[Vector3<f64>] {
        &self.forces
    }

    /// Returns the displacements of a body from its unloaded position, in the order of [`COORDINATES`], m and rad.
    pub fn displacements(&self, body: usize) -> [f64; COORDINATES.len()] {
        let first = COORDINATES.len() * body;
        std::array::from_fn(|k| self.displacements[first + k])
    }

    /// Returns the oscillating modes of the bodies in order of frequency. Overdamped motion is not a mode.
    ///
    /// # Errors
    /// Equations with a non-finite value, or an eigenvalue iteration that does not converge (no such case is known).
    pub fn modes(&self) -> Result<Vec<Mode>, VehicleError> {
        modes::oscillating(&self.linear, &self.bodies)
    }

    /// Returns the real and imaginary parts of all eigenvalues, rad/s, including those of motion that does not
    /// oscillate. Conjugate pairs are adjacent.
    ///
    /// # Errors
    /// The same as for [`Self::modes`].
    pub fn eigenvalues_rad_per_s(&self) -> Result<Vec<[f64; 2]>, VehicleError> {
        modes::eigenvalues_rad_per_s(&self.linear)
    }

    /// Returns the rows of the state matrix `A` of `x' = A x`. The states are the velocities of all bodies, the
    /// displacements of the dashpots in series with springs, and the coordinates that a force depends on, in m, rad and
    /// s.
    pub fn state_matrix(&self) -> Vec<Vec<f64>> {
        modes::state_matrix(&self.linear)
    }
}

pub(super) fn wheelset_bodies(vehicle: &VehicleParameters) -> Vec<Body> {
    vehicle.wheelsets.iter().map(Wheelset::body).collect()
}

fn check(vehicle: &VehicleParameters) -> Result<(), VehicleError> {
    if vehicle.bodies.is_empty() {
        return Err(VehicleError::NoBody);
    }
    for body in vehicle.bodies.iter().chain(&wheelset_bodies(vehicle)) {
        body.check()?;
    }
    for element in &vehicle.elements {
        element.check()?;
    }
    for point in &vehicle.ride_points {
        point.check(&vehicle.bodies)?;
    }
    check_names(vehicle)
}

fn index_of(bodies: &[Body], end: &End) -> Option<usize> {
    let name = end.on.as_ref()?;
    bodies.iter().position(|body| body.name == *name)
}

/// Both ends of an element, and the line from the first to the second, m.
pub(super) type AttachedEnds = ([Attachment; 2], Vector3<f64>);

/// Attaches the ends of all elements. Wheelsets are fixed, or they are moving bodies with indices after those of the
/// other bodies.
pub(super) fn attach(
    vehicle: &VehicleParameters,
    wheelsets_move: bool,
) -> Result<Vec<AttachedEnds>, VehicleError> {
    let wheelsets = wheelset_bodies(vehicle);
    let attach_end = |element: &Element, end: &End| {
        let at = Vector3::from(end.position_m());
        let Some(name) = &end.on else {
            return Ok(Attachment::new(None, at));
        };
        if let Some(index) = index_of(&vehicle.bodies, end) {
            let centre = Vector3::from(vehicle.bodies[index].centre_m());
            return Ok(Attachment::new(Some(index), at - centre));
        }
        let Some(index) = index_of(&wheelsets, end) else {
            let all = vehicle.bodies.iter().chain(&wheelsets);
            return Err(VehicleError::NotThere {
                element: element.name.clone(),
                to: name.clone(),
                names: all.map(|body| body.name.clone()).collect(),
            });
        };
        Ok(Attachment {
            body: wheelsets_move.then_some(vehicle.bodies.len() + index),
            from_centre: at - Vector3::from(wheelsets[index].centre_m()),
            is_axlebox: true,
        })
    };
    let attach_element = |element: &Element| {
        let [first, second] = &element.ends;
        let ends = [attach_end(element, first)?, attach_end(element, second)?];
        let line = Vector3::from(second.position_m()) - Vector3::from(first.position_m());
        Ok((ends, line))
    };
    vehicle.elements.iter().map(attach_element).collect()
}

fn check_names(vehicle: &VehicleParameters) -> Result<(), VehicleError> {
    let bodies = vehicle.bodies.iter().map(|body| &body.name);
    let wheelsets = vehicle.wheelsets.iter().map(|wheelset| &wheelset.name);
    let elements = vehicle.elements.iter().map(|element| &element.name);
    let points = vehicle.ride_points.iter().map(|point| &point.name);
    let mut names = std::collections::HashSet::new();
    for name in bodies.chain(wheelsets).chain(elements).chain(points) {
        if !names.insert(name) {
            return Err(VehicleError::NameUsedTwice { name: name.clone() });
        }
    }
    Ok(())
}

/// Returns the body and the coordinate that move most in the lowest mode if its natural frequency is less than
/// [`MIN_FREQUENCY_HZ`], or if it grows.
fn not_held(linear: &Linear, bodies: &[Body]) -> Option<(String, &'static str)> {
    let root = linear.inertia.map(|inertia| 1.0 / inertia.sqrt());
    let scaled = linear.stiffness.component_mul(&(&root * root.transpose()));
    let eigen = SymmetricEigen::new(scaled);
    let (mode, square) = eigen.eigenvalues.argmin();
    let min_square = (2.0 * std::f64::consts::PI * MIN_FREQUENCY_HZ).powi(2);
    if square >= min_square {
        return None;
    }
    let (largest, _) = eigen.eigenvectors.column(mode).abs().argmax();
    let body = &bodies[largest / COORDINATES.len()];
    let coordinate = COORDINATES[largest % COORDINATES.len()];
    Some((body.name.clone(), coordinate.name()))
}

/// Checks that the friction of an element follows a spring that carries a load at standstill. `forces` are those of all
/// elements on their second ends, N.
fn check_load(
    element: &Element,
    elements: &[Element],
    forces: &[Vector3<f64>],
) -> Result<(), VehicleError> {
    let Law::Friction {
        load: Some(load), ..
    } = &element.law
    else {
        return Ok(());
    };
    let refused = |reason: String| VehicleError::FrictionSpring {
        element: element.name.clone(),
        spring: load.spring.clone(),
        reason,
    };
    let springs = || {
        let springs = elements
            .iter()
            .zip(forces)
            .filter(|(element, _)| element.law.vertical_stiffness().is_some());
        springs.map(|(element, force)| (element.name.as_str(), force.z))
    };
    match springs().find(|(name, _)| *name == load.spring) {
        Some((_, force)) if force.abs() >= MIN_LOAD_N => Ok(()),
        Some(_) => Err(refused(
            "which carries no load at standstill, allowed: a spring that carries weight".to_owned(),
        )),
        None => {
            let names: Vec<&str> = springs().map(|(name, _)| name).collect();
            Err(refused(format!(
                "which is not a spring with vertical stiffness; allowed: {}",
                names.join(", ")
            )))
        }
    }
}
