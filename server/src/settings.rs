//! What a server serves, where, and to whom.

use std::net::SocketAddr;

/// A page and what it may do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page {
    /// The page, complete in itself.
    pub html: String,
    /// Its `Content-Security-Policy`.
    pub policy: String,
}

/// Settings of a server.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Settings {
    /// Address and port; port 0 takes a free one.
    pub listen: SocketAddr,
    /// Token that viewers must give. Without one, an address that others can reach gets a random one.
    pub token: Option<String>,
    /// The page.
    pub page: Page,
}
