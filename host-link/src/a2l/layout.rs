//! Addresses: each value is a 64-bit floating-point number, little-endian.

/// Bytes of a value.
pub const VALUE_BYTES: u32 = 8;
/// Address of the first measured value.
pub const MEASUREMENTS: u32 = 0x1000_0000;
/// Address of the first parameter of a page.
pub const PARAMETERS: u32 = 0x2000_0000;
/// Address of the text that names the layout.
pub const EPK: u32 = 0x3000_0000;
