//! Drawing errors.

use std::error::Error;

/// Error from drawing or writing a plot.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw: {0}")]
pub struct DrawError(#[source] pub(super) Box<dyn Error + Send + Sync>);
