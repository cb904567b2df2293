//! Creep forces: the tangential forces of rolling contact.
//!
//! A [`CreepLaw`] computes [`CreepForces`] from a [`LoadedContact`] and a [`Creepage`]. There are four laws:
//!
//! | law | cost | use |
//! |---|---|---|
//! | [`KalkerBook`] | one table lookup | recommended: exact theory for any spin, with derivatives |
//! | [`Polach`] | closed form | comparison, without spin; falling friction |
//! | [`ShenHedrickElkins`] | closed form | comparison, with little spin |
//! | [`Fastsim`] | about a thousand times the others | comparison: Kalker's simplified theory |
//!
//! With large spin, as on flanges and other steep contacts, the two closed forms are wrong by up to 45 % and 29 % of
//! the friction limit.
//!
//! [`KalkerTable`] provides the coefficients of the linear theory ([`linear_forces`]). [`Friction`] provides the
//! friction coefficient as a function of the sliding speed.
//!
//! Contact axes: 1 in the rolling direction, 2 along the common tangent to the field side, 3 into the rail. Forces act
//! on the wheel; creepages are the velocity of the wheel's surface relative to the rail, divided by the speed.
//!
//! # Adding a creep law
//!
//! Add a file to `rail/src/creep/` with a type that implements [`CreepLaw::unlimited_forces`], the forces as the source
//! states them. [`CreepLaw::forces`] limits them to friction and makes them dissipative. Declare the file in `mod.rs`,
//! and add the law to `laws()` in `rail/tests/contact/common/mod.rs`: all tests of creep laws then cover it, and
//! `rail/tests/contact/laws.rs` measures its errors for `docs/contact.md`.

mod contact_lanes;
mod creepage;
mod derivatives;
mod fastsim;
mod forces;
mod friction;
mod kalker;
pub mod kalker_book;
mod law;
mod loaded_contact;
mod polach;
mod shape;
mod shen_hedrick_elkins;

pub use contact_lanes::ContactLanes;
pub use creepage::{Creepage, MAX_CREEPAGE};
pub use derivatives::CreepDerivatives;
pub use fastsim::Fastsim;
pub use forces::CreepForces;
pub use friction::{Friction, FrictionError};
pub(crate) use kalker::KalkerLookup;
pub use kalker::{KalkerCoefficients, KalkerError, KalkerTable};
pub use kalker_book::KalkerBook;
pub use law::{CreepLaw, linear_forces};
pub use loaded_contact::LoadedContact;
pub use polach::Polach;
pub use shen_hedrick_elkins::ShenHedrickElkins;
