//! How a model and its measurement wait for each other.

use std::sync::Arc;

use super::Gate;

/// How the model runs.
#[derive(Debug, Clone)]
pub enum Pacing {
    /// At its own pace. A tick that the server is too slow for is lost.
    Realtime,
    /// Only while a master measures, and only as fast as it reads. A datagram has no receiver that could be waited for,
    /// so over UDP the model runs at most as fast as in real time.
    Virtual(Arc<Gate>),
}
