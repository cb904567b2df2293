//! What people look at: plots and pages.

pub mod page;
pub mod plot;
