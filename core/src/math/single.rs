//! Where there are no vector instructions a group is one damper.

/// Lanes of a group.
pub(crate) const GROUP: usize = 1;

/// A number for each damper of a group.
pub type F32 = f32;
/// As [`F32`].
pub type F64 = f64;
