//! Contact of a wheelset: from two profiles to the forces on its wheels.
//!
//! The types in order of use:
//!
//! 1. [`Installation`] has the dimensions of wheelset and track; [`Pair`] lays a rail under a wheel.
//! 2. [`Pair::rigid_contact`] gives the contact points of a rigid wheelset ([`RigidContact`]) for the
//!    [`indices`](crate::indices).
//! 3. [`ContactGeometry`] adds the steel; [`elastic`] computes the contact patches of one wheel under any load, one in
//!    each of its [`Zones`].
//! 4. [`Tables`] holds these patches, precomputed over [`WheelPose`] and load.
//! 5. [`WheelsetContact`] reads the tables, or the geometry itself, in every time step. The input is the [`Motion`] of
//!    the wheelset and the [`RailDisplacement`] of both rails. The output is [`WheelsetForces`] with a [`Status`], and
//!    optionally [`WheelDerivatives`].
//!
//! Axes: x forward, y right, z down. Quantities of a single wheel refer to the right wheel, whose field side is at
//! positive y; the left wheel is its mirror image.

mod contact_point;
pub mod elastic;
mod energy;
mod forces;
mod frame;
mod geometry;
mod hertz;
mod installation;
mod laid_rail;
mod lanes;
mod loaded_contact;
mod loaded_zones;
mod motion;
mod one_by_one;
mod pair;
mod patch_numbers;
mod rigid;
mod side_by_side;
mod silhouette;
mod source;
mod status;
mod surface;
mod tables;
mod two_wheelsets;
mod wheel;
mod wheel_lengths;
mod wheelset;
mod wrench;
mod zones;

pub use contact_point::ContactPoint;
pub use forces::{PatchForces, WheelDerivatives, WheelForces, WheelsetForces};
pub use geometry::{ContactGeometry, GeometryError};
pub use hertz::{Hertz, Steel, SteelError};
pub use installation::{Installation, InstallationError};
pub use motion::{MOTION_FIELDS, Motion, RailDisplacement, STANDSTILL_SPEED_M_PER_S};
pub use pair::{Pair, PairError};
pub use rigid::RigidContact;
pub use silhouette::{SilhouettePoint, TurnedWheel, WheelPose};
pub use source::PatchSource;
pub use status::Status;
pub use surface::{MAX_NORMAL_DAMPING_S_PER_M, SurfaceError};
pub use tables::{Cached, NotKept, NotTheseTables, Tables};
pub use wheel::MAX_PENETRATION_M;
pub use wheelset::WheelsetContact;
pub use zones::{ZONES, Zones};
