//! Answers to requests.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha1::{Digest, Sha1};

use crate::Page;

/// Text that the standard (RFC 6455) appends to the key of a WebSocket.
const SOCKET_TEXT: &str = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";

/// A request that is refused, with the reason in words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Refusal {
    status: &'static str,
    reason: &'static str,
}

impl Refusal {
    pub const BAD: Self = Self::new("400 Bad Request", "this is no request of HTTP/1.1");
    pub const SLOW: Self = Self::new("408 Request Timeout", "the request came too slowly");
    pub const LARGE: Self = Self::new(
        "431 Request Header Fields Too Large",
        "the request is too large",
    );
    pub const METHOD: Self = Self::new("405 Method Not Allowed", "allowed: GET, HEAD");
    pub const PATH: Self = Self::new("404 Not Found", "there is only the page at /");
    pub const HOST: Self = Self::new(
        "403 Forbidden",
        "this server is not known by the name in the header Host",
    );
    pub const ORIGIN: Self = Self::new(
        "403 Forbidden",
        "only the page of this server may connect (header Origin)",
    );
    pub const TOKEN: Self = Self::new(
        "403 Forbidden",
        "the token is missing or wrong; open the address that dashpot printed",
    );
    pub const UPGRADE: Self = Self::new("426 Upgrade Required", "here is a WebSocket only");
    pub const FULL: Self = Self::new("503 Service Unavailable", "too many viewers");

    const fn new(status: &'static str, reason: &'static str) -> Self {
        Self { status, reason }
    }

    /// The refusal as an answer.
    pub fn answer(self) -> Vec<u8> {
        let Self { status, reason } = self;
        format!(
            "HTTP/1.1 {status}\r\nContent-Type: text/plain; charset=utf-8\r\nContent-Length: {}\r\n\
             X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n{reason}\n",
            reason.len() + 1
        )
        .into_bytes()
    }
}

/// The page as an answer, without itself if only the head is wanted.
pub(crate) fn page(page: &Page, is_head: bool) -> Vec<u8> {
    let head = format!(
        "HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {}\r\n\
         Content-Security-Policy: {}\r\nX-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\n\
         Referrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n\
         Cross-Origin-Opener-Policy: same-origin\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
        page.html.len(),
        page.policy
    );
    let body = if is_head { "" } else { &page.html };
    [head.as_bytes(), body.as_bytes()].concat()
}

/// Accepts a WebSocket with this key.
pub(crate) fn accept(key: &str) -> Vec<u8> {
    let digest = Sha1::digest(format!("{key}{SOCKET_TEXT}").as_bytes());
    format!(
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Accept: {}\r\n\r\n",
        BASE64_STANDARD.encode(digest)
    )
    .into_bytes()
}

#[cfg(test)]
mod tests {
    use super::accept;

    #[test]
    fn the_key_of_the_standard_gets_the_answer_of_the_standard() {
        let answer = String::from_utf8(accept("dGhlIHNhbXBsZSBub25jZQ==")).unwrap();
        assert!(
            answer.contains("Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n"),
            "{answer}"
        );
    }
}
