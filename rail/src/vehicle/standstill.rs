//! A vehicle at standstill on rigid rails.

use nalgebra::{DVector, SymmetricEigen, Vector3};

use super::GRAVITY_M_PER_S2;
use super::body::{Body, COORDINATES, Coordinate, VehicleParameters, Wheelset};
use super::element::{Element, End};
use super::error::VehicleError;
use super::linear::{Linear, Place};
use super::modes::{self, Mode};

/// A vehicle at standstill: its wheelsets are held by the rails, its bodies rest on their elements.
#[derive(Debug, Clone)]
pub struct Standstill {
    bodies: Vec<Body>,
    linear: Linear,
    displacements: DVector<f64>,
    /// Force of each element on its second end, N.
    forces: Vec<Vector3<f64>>,
    axle_loads_n: Vec<f64>,
}

/// Frequency below which nothing holds a body, Hz.
const LEAST_FREQUENCY_HZ: f64 = 0.01;

impl Standstill {
    /// The equilibrium under gravity: displacements of the bodies from where the unloaded elements have them, forces of the
    /// elements, and the stiffness that these forces add where they turn with the bodies.
    ///
    /// # Errors
    /// A number out of bounds, a name used twice, an element without a body, a body that nothing holds.
    pub fn new(vehicle: &VehicleParameters) -> Result<Self, VehicleError> {
        let bodies = &vehicle.bodies;
        check(vehicle)?;
        let mut linear = Linear::new(bodies);
        let ends = places(vehicle, false)?;
        for (element, (places, line)) in vehicle.elements.iter().zip(&ends) {
            linear.add(element, places, *line);
        }
        check_held(&linear, bodies)?;
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
            .map(|(element, (places, line))| {
                let displacement = linear.displacement(places) * &displacements;
                -element
                    .law
                    .spring_force(displacement.fixed_rows::<3>(0).into(), *line)
            })
            .collect();
        for ((places, _), force) in ends.iter().zip(&forces) {
            linear.add_preload(places, *force);
        }
        let wheelsets = wheelset_bodies(vehicle);
        let mut axle_loads_n: Vec<f64> = wheelsets
            .iter()
            .map(|wheelset| wheelset.mass_kg * GRAVITY_M_PER_S2)
            .collect();
        for (element, force) in vehicle.elements.iter().zip(&forces) {
            for (end, sign) in element.ends.iter().zip([-1.0, 1.0]) {
                if let Some(number) = number_of(&wheelsets, end) {
                    axle_loads_n[number] += sign * force.z;
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

    /// Load of each wheelset on the rails, N.
    pub fn axle_loads_n(&self) -> &[f64] {
        &self.axle_loads_n
    }

    /// Force of each element on its second end, N.
    pub(super) fn forces(&self) -> &[Vector3<f64>] {
        &self.forces
    }

    /// Displacements of a body in the order of [`COORDINATES`], from where its unloaded elements have it, m and rad.
    pub fn displacements(&self, body: usize) -> [f64; COORDINATES.len()] {
        let first = COORDINATES.len() * body;
        std::array::from_fn(|k| self.displacements[first + k])
    }

    /// Modes of the bodies by rising frequency; overdamped motion is none.
    ///
    /// # Errors
    /// Equations with a number that is not finite; an iteration for the eigenvalues that does not converge, which is not known to happen.
    pub fn modes(&self) -> Result<Vec<Mode>, VehicleError> {
        modes::of(&self.linear, &self.bodies)
    }

    /// All eigenvalues, real and imaginary part, rad/s: also those of motion that does not oscillate. A pair of conjugates is adjacent.
    ///
    /// # Errors
    /// As [`Self::modes`].
    pub fn eigenvalues_rad_per_s(&self) -> Result<Vec<[f64; 2]>, VehicleError> {
        modes::all(&self.linear)
    }

    /// Rows of the state matrix `A` of `x' = A x`. The states are the velocities of all bodies, the displacements of the dashpots in
    /// series with springs, and the coordinates that a force depends on, m, rad and s.
    pub fn state_matrix(&self) -> Vec<Vec<f64>> {
        modes::rows(&self.linear)
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
        point.check(vehicle)?;
    }
    check_names(vehicle)
}

fn number_of(bodies: &[Body], end: &End) -> Option<usize> {
    let name = end.on.as_ref()?;
    bodies.iter().position(|body| body.name == *name)
}

/// The places of an element's ends, and the line from the first to the second, m.
pub(super) type PlacedEnds = ([Place; 2], Vector3<f64>);

/// The places of every element's ends, and the line from one to the other; wheelsets are held, or move as bodies that follow the
/// others in number.
pub(super) fn places(
    vehicle: &VehicleParameters,
    wheelsets_move: bool,
) -> Result<Vec<PlacedEnds>, VehicleError> {
    let wheelsets = wheelset_bodies(vehicle);
    let of_end = |element: &Element, end: &End| {
        let at = Vector3::from(end.position_m());
        let Some(name) = &end.on else {
            return Ok(Place {
                body: None,
                from_centre: at,
                is_axlebox: false,
            });
        };
        if let Some(number) = number_of(&vehicle.bodies, end) {
            return Ok(Place {
                body: Some(number),
                from_centre: at - Vector3::from(vehicle.bodies[number].centre_m()),
                is_axlebox: false,
            });
        }
        let Some(number) = number_of(&wheelsets, end) else {
            let all = vehicle.bodies.iter().chain(&wheelsets);
            return Err(VehicleError::NotThere {
                element: element.name.clone(),
                to: name.clone(),
                names: all.map(|body| body.name.clone()).collect(),
            });
        };
        Ok(Place {
            body: wheelsets_move.then_some(vehicle.bodies.len() + number),
            from_centre: at - Vector3::from(wheelsets[number].centre_m()),
            is_axlebox: true,
        })
    };
    let of_element = |element: &Element| {
        let [first, second] = &element.ends;
        let ends = [of_end(element, first)?, of_end(element, second)?];
        let line = Vector3::from(second.position_m()) - Vector3::from(first.position_m());
        Ok((ends, line))
    };
    vehicle.elements.iter().map(of_element).collect()
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

/// The motion that the springs resist least, against the least frequency that is one of a body that is held.
fn check_held(linear: &Linear, bodies: &[Body]) -> Result<(), VehicleError> {
    let root = linear.inertia.map(|inertia| 1.0 / inertia.sqrt());
    let scaled = linear.stiffness.component_mul(&(&root * root.transpose()));
    let eigen = SymmetricEigen::new(scaled);
    let (number, square) = eigen.eigenvalues.argmin();
    let least = (2.0 * std::f64::consts::PI * LEAST_FREQUENCY_HZ).powi(2);
    if square >= least {
        return Ok(());
    }
    let (place, _) = eigen.eigenvectors.column(number).abs().argmax();
    Err(VehicleError::NotHeld {
        body: bodies[place / COORDINATES.len()].name.clone(),
        coordinate: COORDINATES[place % COORDINATES.len()].word(),
    })
}
