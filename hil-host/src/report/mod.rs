//! What people look at: plots and pages.

mod error;
pub mod health;
pub mod page;
pub mod plot;

pub use error::DrawError;
