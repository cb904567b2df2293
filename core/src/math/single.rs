//! A group of one damper, for processors without vector instructions.

/// Number of lanes of a group.
pub(crate) const GROUP: usize = 1;

/// Numbers of a group in single precision.
pub(crate) type F32 = f32;
/// Numbers of a group in double precision.
pub(crate) type F64 = f64;
