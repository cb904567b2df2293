//! Where the numbers of a page come from.

use serde_json::Value;

/// A vehicle on this machine, a recording, or a target.
pub(super) trait Source {
    /// What a page draws, without the role of the viewer.
    fn scene(&self) -> &Value;

    /// State, without what differs between viewers.
    fn status(&self) -> Value;

    /// Health of the dampers as a message, if it is known.
    fn health(&self) -> Option<Value> {
        None
    }

    /// Looks after the source between two messages. Returns true if viewers should know what has happened.
    fn look_after(&mut self) -> bool;

    /// A viewer has come, and has been told scene and status.
    fn joined(&mut self) {}

    /// Does what the operator wants.
    ///
    /// # Errors
    /// It is not possible; nothing changes.
    fn operate(&mut self, message: Value) -> Result<Told, String>;

    /// Says how it ended.
    fn end(&mut self, ending: String);
}

/// What all viewers are told after a message of the operator.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Told {
    /// The status.
    Status,
    /// The scene, too: everything begins anew.
    Scene,
    /// The status; the operator's answer has these fields.
    Answer(Value),
}

/// Reads a message.
///
/// # Errors
/// It is not of the protocol, or not one that the source knows.
pub(super) fn read<T: serde::de::DeserializeOwned>(message: Value) -> Result<T, String> {
    serde_json::from_value(message).map_err(|error| format!("message: {error}"))
}
