//! Why there is no plot.

use std::error::Error;

/// A plot that cannot be drawn, with the plotting library's reason.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw: {0}")]
pub struct DrawError(#[source] pub(super) Box<dyn Error + Send + Sync>);
