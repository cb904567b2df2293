//! Kinds of corners of a damper's law.

/// A corner of a damper's law, where the slope of velocity over force jumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Corner {
    /// The preloaded shim-pack valve of the piston opens.
    PistonValveOpens,
    /// The relief valve opens.
    ReliefOpens,
    /// The foot valve opens against its preload or the reservoir pressure.
    FootValveOpens,
    /// In compression, the pressure of the rod side reaches or leaves the vapour pressure.
    Vapour,
    /// The element yields at the saturation velocity or the force limit.
    Yields,
}
