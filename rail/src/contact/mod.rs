//! Contact of a wheelset: from two profiles to the forces on its wheels.
//!
//! The types in order of use:
//!
//! 1. [`Installation`] has the dimensions of wheelset and track; [`Pair`] lays a rail under a wheel.
//! 2. [`Pair::rigid_contact`] gives the contact points of a rigid wheelset ([`RigidContact`]) for the
//!    [`indices`](crate::indices); [`TurnedWheel::patches`] gives the elastic contact patches of one wheel, one in each
//!    of its [`Zones`].
//! 3. [`Hertz`] turns local curvatures into stiffness and semi-axes of a patch; [`ContactGeometry`] does so for a pair
//!    under its nominal load.
//! 4. [`Tables`] holds these patches, precomputed over a [`Grid`] of [`WheelPose`]s.
//! 5. [`WheelsetContact`] reads the tables, or the geometry itself, in every time step. The input is the [`Motion`] of
//!    the wheelset and the [`RailDisplacement`] of both rails. The output is [`WheelsetForces`] with a [`Status`], and
//!    optionally [`WheelDerivatives`].
//! 6. [`elastic`] computes the contact at any load from the elasticity of both bodies, and [`load_tables`] holds its
//!    results over pose and load. The step does not read them yet.
//!
//! Axes: x forward, y right, z down. Quantities of a single wheel refer to the right wheel, whose field side is at
//! positive y; the left wheel is its mirror image.

pub mod elastic;
mod forces;
mod frame;
mod geometry;
mod hertz;
mod installation;
mod laid_rail;
pub mod load_tables;
mod loaded_contact;
mod loaded_zones;
mod motion;
mod one_by_one;
mod pair;
mod patches;
mod rigid;
mod side_by_side;
mod silhouette;
mod source;
mod status;
mod surface;
mod tables;
mod tabulated_patch;
mod wheel;
mod wheelset;
mod zones;

pub use forces::{PatchForces, WheelDerivatives, WheelForces, WheelsetForces};
pub use geometry::{ContactGeometry, GeometryError, NOMINAL_LOAD_RANGE_N};
pub use hertz::{Hertz, Steel, SteelError};
pub use installation::{Installation, InstallationError};
pub use motion::{MOTION_FIELDS, Motion, RailDisplacement, STANDSTILL_SPEED_M_PER_S};
pub use pair::{Pair, PairError};
pub use patches::{Patch, softness_m};
pub use rigid::RigidContact;
pub use silhouette::{SilhouettePoint, TurnedWheel, WheelPose};
pub use source::PatchSource;
pub use status::Status;
pub use surface::{MAX_NORMAL_DAMPING_S_PER_M, SurfaceError};
pub use tables::{Axis, CacheError, Grid, Jump, MAX_JUMP, MAX_NODES, Tables, TablesError};
pub use tabulated_patch::{MIN_CURVATURE_PER_M, TabulatedPatch};
pub use wheel::MAX_PENETRATION_M;
pub use wheelset::WheelsetContact;
pub use zones::{ZONES, Zones};
