//! Errors of a server.

use std::net::SocketAddr;

/// A server that cannot start.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ServerError {
    /// The address cannot be listened at.
    #[error("cannot listen at {address}: {source}")]
    Listen {
        /// The address.
        address: SocketAddr,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The system gave no random numbers for a token.
    #[error("the system gives no random numbers for a token: {0}")]
    Random(String),
    /// A token that cannot stand in an address, or is too easy to guess.
    #[error("the token has {length} characters; allowed: 12 to 128 of A-Z, a-z, 0-9, - and _")]
    Token {
        /// Number of characters.
        length: usize,
    },
}
