//! The vehicle at rest: forces of its elements under its weight, and position of its wheelsets on the rails.

use dashpot_rail::contact::{Motion, PatchSource, RailDisplacement, WheelsetContact};
use dashpot_rail::creep::CreepLaw;
use dashpot_rail::vehicle::{GRAVITY_M_PER_S2, VehicleError, VehicleParameters};

use super::attachment::{Coordinates, Pose};
use super::coupling::Coupling;
use crate::linear::{Factors, Matrix};

/// Coordinates of a body.
const N: usize = 5;

/// A wheelset's rest position is searched for within this distance above and below 0 (m).
const DEEPEST_M: f64 = 2e-3;

/// Equilibrium of a wheelset on the rails.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    /// Vertical position of the centre at which the rails carry the load (m).
    pub(super) vertical: f64,
    /// Load on the rails (N).
    pub(super) load: f64,
    /// Speed divided by the rolling radius (rad/s).
    pub(super) rotation: f64,
    /// Forces of the left and right rail on their wheels (N).
    pub(super) wheel_forces: [[f64; 3]; 2],
}

/// Sets the force of each element with the vehicle at rest and the wheelsets fixed; returns the loads of the elements
/// on each wheelset.
pub(super) fn load_elements(
    vehicle: &VehicleParameters,
    couplings: &mut [Coupling],
) -> Result<Vec<Coordinates>, VehicleError> {
    let bodies = vehicle.bodies.len();
    let size = N * bodies;
    let poses = |coupling: &Coupling, displacements: &[f64]| {
        std::array::from_fn(|end| match coupling.attachments[end].body {
            Some(body) if body < bodies => Pose {
                displacement: std::array::from_fn(|k| displacements[N * body + k]),
                rate: [0.0; N],
            },
            _ => Pose::default(),
        })
    };
    let loads = |couplings: &[Coupling], displacements: &[f64]| {
        let mut all = vec![0.0; N * (bodies + vehicle.wheelsets.len())];
        for coupling in couplings {
            let motion = coupling.motion(&poses(coupling, displacements));
            let loads = coupling.loads(&coupling.spring_wrench(&motion));
            for (attachment, load) in coupling.attachments.iter().zip(loads) {
                if let Some(body) = attachment.body {
                    for (k, load) in load.into_iter().enumerate() {
                        all[N * body + k] += load;
                    }
                }
            }
        }
        all
    };
    // Each column contains the loads that a unit displacement causes, with opposite signs.
    let mut stiffness = Matrix::zeros(size);
    for column in 0..size {
        let mut unit = vec![0.0; size];
        unit[column] = 1.0;
        for (row, load) in loads(couplings, &unit)[..size].iter().enumerate() {
            stiffness.add(row, column, -load);
        }
    }
    let factors = Factors::new(stiffness);
    if factors.is_singular() {
        return Err(VehicleError::NoModes);
    }
    let mut displacements = vec![0.0; size];
    for (body, weights) in vehicle.bodies.iter().zip(displacements.chunks_mut(N)) {
        weights[1] = body.mass_kg * GRAVITY_M_PER_S2;
    }
    factors.solve(&mut displacements);
    let on_wheelsets = loads(couplings, &displacements)[size..]
        .chunks(N)
        .map(|load| std::array::from_fn(|k| load[k]))
        .collect();
    for coupling in couplings {
        let motion = coupling.motion(&poses(coupling, &displacements));
        let [force, _] = coupling.spring_wrench(&motion);
        coupling.standing_force = force;
    }
    Ok(on_wheelsets)
}

impl Standing {
    /// Finds the equilibrium of a centred wheelset that rolls freely under `load` (N) at `speed` (m/s); `None` if the
    /// rails do not carry it.
    pub(super) fn new<L: CreepLaw, S: PatchSource>(
        contact: &WheelsetContact<L, S>,
        speed: f64,
        load: f64,
    ) -> Option<Self> {
        if load <= 0.0 {
            return None;
        }
        let rails = [RailDisplacement::default(); 2];
        let at = |vertical: f64, rotation: f64| Motion {
            speed_m_per_s: speed,
            vertical_m: vertical,
            rotation_rad_per_s: rotation,
            ..Motion::default()
        };
        let mut rotation = speed / 0.5;
        let mut vertical = 0.0;
        // The height depends slightly on the creep, and the rolling radius on the height, so both are found by
        // iteration.
        for _ in 0..4 {
            let carried =
                |vertical: f64| -contact.forces(&at(vertical, rotation), &rails).force_n[2];
            let (mut above, mut below) = (-DEEPEST_M, DEEPEST_M);
            if carried(below) < load || carried(above) > load {
                return None;
            }
            while below - above > 1e-16 {
                let middle = 0.5 * (above + below);
                if middle <= above || middle >= below {
                    break;
                }
                if carried(middle) > load {
                    below = middle;
                } else {
                    above = middle;
                }
            }
            vertical = below;
            let patches = contact.forces(&at(vertical, rotation), &rails).wheels[1].patches;
            let heaviest = patches
                .iter()
                .max_by(|a, b| a.load_n.total_cmp(&b.load_n))?;
            rotation = speed / heaviest.rolling_radius_m;
        }
        let forces = contact.forces(&at(vertical, rotation), &rails);
        Some(Self {
            vertical,
            load,
            rotation,
            wheel_forces: forces.wheels.map(|wheel| wheel.force_n),
        })
    }
}
