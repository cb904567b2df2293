//! Viewers, and who hears of them.

/// A viewer: one connection, never used again for another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ViewerId(pub u64);

/// What a viewer wants to be (`?role=` of its address).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WantedRole {
    /// Whatever is free.
    #[default]
    Any,
    /// Operator.
    Operator,
    /// Viewer only.
    Viewer,
}

impl WantedRole {
    pub(crate) fn of(text: Option<&str>) -> Self {
        match text {
            Some("operator") => Self::Operator,
            Some("viewer") => Self::Viewer,
            _ => Self::Any,
        }
    }
}

/// Hears of viewers, on the threads of their connections: it must not wait for long.
pub trait Handler: Send + Sync + 'static {
    /// A viewer has come. It gets frames after [`Hub::begin`](crate::Hub::begin).
    fn joined(&self, viewer: ViewerId, role: WantedRole);
    /// A viewer has sent a text.
    fn message(&self, viewer: ViewerId, text: &str);
    /// A viewer has left.
    fn left(&self, viewer: ViewerId);
}
