//! Creep forces: the tangential forces of rolling contact.
//!
//! [`Creepage`] and [`LoadedContact`] in, [`CreepForces`] out, by one of four laws behind [`CreepLaw`]:
//!
//! | law | cost | use |
//! |---|---|---|
//! | [`KalkerBook`] | one reading of a table | recommended: exact theory with any spin, derivatives |
//! | [`Polach`] | closed form | for comparison, without spin; falling friction |
//! | [`ShenHedrickElkins`] | closed form | for comparison, with little spin |
//! | [`Fastsim`] | about a thousand times the others | for comparison: Kalker's simplified theory |
//!
//! The two closed forms are far off where spin counts, as on flanges and other steep contacts: by up to 45 % and 29 % of
//! friction.
//!
//! [`KalkerTable`] gives the coefficients of the linear theory ([`linear_forces`]), [`Friction`] the coefficient
//! of friction over the sliding speed.
//!
//! Contact axes: 1 in the rolling direction, 2 along the common tangent to the field side, 3 into the rail. Forces act
//! on the wheel; creepages are the velocity of the wheel's surface relative to the rail, divided by the speed.
//!
//! # To add a creep law
//!
//! Add a file to `rail/src/creep/` with a type that implements [`CreepLaw::unlimited_forces`]: the
//! forces as its source states them. [`CreepLaw::forces`] limits them to friction and dissipation. Declare the file
//! here, and add the law to `laws()` in `rail/tests/contact/common/mod.rs`: every test of the creep laws then runs
//! on it, and `rail/tests/contact/laws.rs` measures its errors for `docs/contact.md`.

mod contact_lanes;
mod creepage;
mod derivatives;
mod fastsim;
mod friction;
mod kalker;
pub mod kalker_book;
mod law;
mod polach;
mod shen_hedrick_elkins;

pub(crate) use contact_lanes::ContactLanes;
pub use creepage::{Creepage, MAX_CREEPAGE};
pub use derivatives::CreepDerivatives;
pub use fastsim::Fastsim;
pub use friction::{Friction, FrictionError};
pub use kalker::{KalkerCoefficients, KalkerError, KalkerTable};
pub use kalker_book::KalkerBook;
pub use law::{CreepForces, CreepLaw, LoadedContact, linear_forces};
pub use polach::Polach;
pub use shen_hedrick_elkins::ShenHedrickElkins;
