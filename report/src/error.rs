//! Why there is no plot.

use std::error::Error;

/// A plot that cannot be drawn or written, with the reason.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw: {0}")]
pub struct DrawError(#[source] pub(super) Box<dyn Error + Send + Sync>);
