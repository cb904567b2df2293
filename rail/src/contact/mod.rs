//! Contact of a wheelset: from two profiles to the forces on its wheels.
//!
//! In the order of use:
//!
//! 1. [`Installation`] holds the distances of wheels and rails; [`Pair`] lays a rail under a wheel.
//! 2. [`Pair::rigid_contact`] gives the contact points of a rigid wheelset ([`RigidContact`]), which is what
//!    [`indices`](crate::indices) need; [`Pair::patches`] gives the elastic contact patches of one wheel.
//! 3. [`Hertz`] turns local curvatures into stiffness and semi-axes of a patch.
//! 4. [`Tables`] precomputes patches, Hertz and Kalker over a [`Grid`] of [`WheelPose`]s.
//! 5. [`WheelsetContact`] reads the tables in every time step: [`Motion`] of the wheelset and
//!    [`RailDisplacement`] of both rails in, [`WheelsetForces`] with a [`Status`] out.
//!
//! Axes: x forward, y right, z down. Quantities of a single wheel are those of the right wheel, whose field side
//! is y positive; the left wheel is its mirror image.

mod forces;
mod frame;
mod hertz;
mod installation;
mod laid_rail;
mod motion;
mod pair;
mod patches;
mod rigid;
mod silhouette;
mod tables;
mod wheelset;

pub use forces::{PatchForces, Status, WheelForces, WheelsetForces};
pub use hertz::{Hertz, Steel};
pub use installation::{Installation, InstallationError};
pub use motion::{Motion, RailDisplacement, STANDSTILL_SPEED_M_PER_S};
pub use pair::{Pair, PairError};
pub use patches::{Patch, Patches, REGULARIZATION_M};
pub use rigid::RigidContact;
pub use silhouette::{SilhouettePoint, WheelPose};
pub use tables::{Axis, Grid, MAX_NODES, MIN_CURVATURE_PER_M, Tables, TablesError, TabulatedPatch};
pub use wheelset::{MAX_PENETRATION_M, WheelsetContact};
