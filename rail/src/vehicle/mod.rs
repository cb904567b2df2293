//! A rail vehicle: rigid bodies connected by elements; its equilibrium, its modes at standstill and at a speed, and its
//! step along a track.
//!
//! The axes are those of the whole crate: x forward, y right, z down; small rotations are roll about x, pitch about y
//! and yaw about z. The coordinates of a body are lateral, vertical, roll, pitch and yaw, in a frame that follows the
//! track at constant speed. There is no coordinate along the track. A point `r = (x, y, z)` from the centre of gravity
//! moves by `(-yaw y, lateral - roll z + yaw x, vertical + roll y - pitch x)`. Pitch does not move it along the track,
//! because a body is free in that direction; longitudinal stiffness therefore does not resist pitch.
//!
//! ```
//! use dashpot_rail::vehicle::{Body, Element, End, Law, Standstill, VehicleParameters};
//! // A body of 30 t on four springs of 1 MN/m.
//! let body = Body::new("body", 30e3, [40e3, 900e3, 900e3], 1.5);
//! let spring = |x: f64, y: f64| {
//!     let ends = [End::track([x, y, 0.5]), End::body("body", [x, y, 0.5])];
//!     let law = Law::SpringDamper { stiffness_n_per_m: [1e6; 3], damping_n_s_per_m: [0.0; 3] };
//!     Element::new(format!("spring {x} {y}"), ends, law)
//! };
//! let vehicle = VehicleParameters::new("wagon")
//!     .with_bodies([body])
//!     .with_elements([spring(5.0, 1.0), spring(5.0, -1.0), spring(-5.0, 1.0), spring(-5.0, -1.0)]);
//! let modes = Standstill::new(&vehicle)?.modes()?;
//! let bounce = modes.iter().find(|mode| mode.description() == "body bounce").unwrap();
//! // sqrt(4 MN/m / 30 t) / 2 pi
//! assert!((bounce.undamped_hz() - 1.8378).abs() < 1e-3);
//! # Ok::<(), dashpot_rail::vehicle::VehicleError>(())
//! ```

mod body;
mod carried;
mod element;
mod engine;
mod error;
mod friction;
mod linear;
mod modes;
mod parameters;
mod ride_point;
mod running;
mod standstill;

pub use body::{Body, COORDINATES, Coordinate, Wheelset};
pub use element::{Direction, Element, End, Law, MAX_STOP_POINTS};
pub use engine::{
    CANT_BASE_M, Energy, Extremes, FRICTION_FACTOR, MAX_APPLIED, RailSupport, SPEED_M_PER_S,
    STEP_S, Stop, Vehicle, VehicleState,
};

pub use error::VehicleError;
pub use friction::FrictionLoad;
pub use modes::Mode;
pub use parameters::VehicleParameters;
pub use ride_point::RidePoint;
pub use running::{Running, WithoutDamper};
pub use standstill::Standstill;

/// Acceleration due to gravity, m/s^2.
pub const GRAVITY_M_PER_S2: f64 = 9.81;
