//! What people look at: plots and pages.

mod error;
pub mod page;
pub mod plot;

pub use error::DrawError;
