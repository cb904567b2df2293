//! Addresses of both ends.

use core::net::Ipv4Addr;

/// Address of the target, in a network of 24 bits.
pub const TARGET: Ipv4Addr = Ipv4Addr::new(192, 168, 7, 2);

/// Address of the host.
pub const HOST: Ipv4Addr = Ipv4Addr::new(192, 168, 7, 1);

/// TCP port of the target.
pub const PORT: u16 = 5555;

/// Hardware address of the target's card.
pub const TARGET_CARD: [u8; 6] = [2, 0, 0, 0, 0, 2];

/// Hardware address of the host's card.
pub const HOST_CARD: [u8; 6] = [2, 0, 0, 0, 0, 1];
