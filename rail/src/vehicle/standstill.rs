//! A vehicle at standstill on rigid rails.

use nalgebra::{DVector, SymmetricEigen, Vector3};

use super::GRAVITY_M_PER_S2;
use super::body::{Body, COORDINATES, Coordinate, Vehicle};
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
    pub fn new(vehicle: &Vehicle) -> Result<Self, VehicleError> {
        let bodies = &vehicle.bodies;
        if bodies.is_empty() {
            return Err(VehicleError::NoBody);
        }
        let wheelsets: Vec<Body> = vehicle.wheelsets.iter().map(|w| w.body()).collect();
        for body in bodies.iter().chain(&wheelsets) {
            body.check()?;
        }
        check_names(vehicle)?;
        let mut linear = Linear::new(bodies);
        let mut places = Vec::new();
        for element in &vehicle.elements {
            element.check()?;
            let [first, second] = &element.ends;
            let ends = [
                place(element, first, bodies, &wheelsets)?,
                place(element, second, bodies, &wheelsets)?,
            ];
            let [from, to] = [first, second].map(|end| Vector3::from(end.position_m()));
            linear.add(element, &ends, to - from);
            places.push((ends, to - from));
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
        let mut axle_loads_n: Vec<f64> = wheelsets
            .iter()
            .map(|wheelset| wheelset.mass_kg * GRAVITY_M_PER_S2)
            .collect();
        for (element, (ends, line)) in vehicle.elements.iter().zip(&places) {
            let displacement = linear.displacement(ends) * &displacements;
            let force = -element
                .law
                .spring_force(displacement.fixed_rows::<3>(0).into(), *line);
            linear.add_preload(ends, force);
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
            axle_loads_n,
        })
    }

    /// Load of each wheelset on the rails, N.
    pub fn axle_loads_n(&self) -> &[f64] {
        &self.axle_loads_n
    }

    /// Displacements of a body in the order of [`COORDINATES`], from where its unloaded elements have it, m and rad.
    pub fn displacements(&self, body: usize) -> [f64; COORDINATES.len()] {
        let first = COORDINATES.len() * body;
        std::array::from_fn(|k| self.displacements[first + k])
    }

    /// Modes of the bodies by rising frequency; overdamped motion is none.
    ///
    /// # Errors
    /// Numbers so far apart that the eigenvalues are not found.
    pub fn modes(&self) -> Result<Vec<Mode>, VehicleError> {
        modes::of(&self.linear, &self.bodies)
    }
}

fn number_of(bodies: &[Body], end: &End) -> Option<usize> {
    let name = end.on.as_ref()?;
    bodies.iter().position(|body| body.name == *name)
}

fn place(
    element: &Element,
    end: &End,
    bodies: &[Body],
    wheelsets: &[Body],
) -> Result<Place, VehicleError> {
    let at = Vector3::from(end.position_m());
    let body = number_of(bodies, end);
    let owner = match (body, number_of(wheelsets, end), &end.on) {
        (Some(body), _, _) => Some(&bodies[body]),
        (None, Some(wheelset), _) => Some(&wheelsets[wheelset]),
        (None, None, None) => None,
        (None, None, Some(name)) => {
            let names = bodies.iter().chain(wheelsets).map(|body| body.name.clone());
            return Err(VehicleError::NotThere {
                element: element.name.clone(),
                to: name.clone(),
                names: names.collect(),
            });
        }
    };
    let centre = owner.map_or(Vector3::zeros(), |owner| owner.centre_m().into());
    Ok(Place {
        body,
        from_centre: at - centre,
    })
}

fn check_names(vehicle: &Vehicle) -> Result<(), VehicleError> {
    let bodies = vehicle.bodies.iter().map(|body| &body.name);
    let wheelsets = vehicle.wheelsets.iter().map(|wheelset| &wheelset.name);
    let elements = vehicle.elements.iter().map(|element| &element.name);
    let mut names = std::collections::HashSet::new();
    for name in bodies.chain(wheelsets).chain(elements) {
        if !names.insert(name) {
            return Err(VehicleError::NameUsedTwice { name: name.clone() });
        }
    }
    Ok(())
}

/// The motion that the springs resist least, against the least frequency that is one of a body that is held.
fn check_held(linear: &Linear, bodies: &[Body]) -> Result<(), VehicleError> {
    let root = linear.inertia.map(|inertia| 1.0 / inertia.sqrt());
    let mut scaled = linear.stiffness.clone();
    for ((i, j), number) in (0..scaled.nrows())
        .flat_map(|j| (0..linear.inertia.len()).map(move |i| (i, j)))
        .zip(scaled.iter_mut())
    {
        *number *= root[i] * root[j];
    }
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
