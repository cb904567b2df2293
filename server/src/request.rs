//! Reads the head of a request.

use std::io::{self, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use crate::response::Refusal;

/// Largest head, bytes.
const MAX_HEAD: usize = 16 * 1024;

/// Most headers.
const MAX_HEADERS: usize = 64;

/// How long a client may take to send the head.
const PATIENCE: Duration = Duration::from_secs(5);

/// The head of a request.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Request {
    pub method: String,
    pub path: String,
    pub query: String,
    pub host: Option<String>,
    pub origin: Option<String>,
    /// Key of a WebSocket; `None` for a plain request.
    pub socket_key: Option<String>,
    /// What came behind the head.
    pub rest: Vec<u8>,
}

impl Request {
    /// Reads from `stream` until the head is complete.
    ///
    /// # Errors
    /// The client is too slow, gone, or does not speak HTTP.
    pub fn read(stream: &mut TcpStream) -> Result<Self, Refusal> {
        let gone = |_: io::Error| Refusal::BAD;
        let started = Instant::now();
        let mut bytes = Vec::new();
        let mut part = [0; 2048];
        loop {
            let left = PATIENCE.checked_sub(started.elapsed());
            let left = left.filter(|left| !left.is_zero()).ok_or(Refusal::SLOW)?;
            stream.set_read_timeout(Some(left)).map_err(gone)?;
            let count = stream.read(&mut part).map_err(gone)?;
            if count == 0 {
                return Err(Refusal::BAD);
            }
            bytes.extend(&part[..count]);
            if let Some(request) = Self::parse(&bytes)? {
                return Ok(request);
            }
            if bytes.len() > MAX_HEAD {
                return Err(Refusal::LARGE);
            }
        }
    }

    /// Returns the request if its head is complete.
    fn parse(bytes: &[u8]) -> Result<Option<Self>, Refusal> {
        let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
        let mut head = httparse::Request::new(&mut headers);
        let parsed = head.parse(bytes).map_err(|error| match error {
            httparse::Error::TooManyHeaders => Refusal::LARGE,
            _ => Refusal::BAD,
        })?;
        let httparse::Status::Complete(length) = parsed else {
            return Ok(None);
        };
        let target = head.path.unwrap_or_default();
        let (path, query) = target.split_once('?').unwrap_or((target, ""));
        let mut request = Self {
            method: head.method.unwrap_or_default().to_owned(),
            path: path.to_owned(),
            query: query.to_owned(),
            rest: bytes[length..].to_vec(),
            ..Self::default()
        };
        let (mut is_upgrade, mut is_version, mut key) = (false, false, None);
        for header in head.headers {
            let text = std::str::from_utf8(header.value).map_err(|_| Refusal::BAD)?;
            let text = text.trim();
            match header.name.to_ascii_lowercase().as_str() {
                // A second one could tell a proxy something else.
                "host" => put(&mut request.host, text)?,
                "origin" => put(&mut request.origin, text)?,
                "upgrade" => is_upgrade = text.eq_ignore_ascii_case("websocket"),
                "sec-websocket-version" => is_version = text == "13",
                "sec-websocket-key" => put(&mut key, text)?,
                _ => {}
            }
        }
        request.socket_key = key.filter(|_| is_upgrade && is_version);
        Ok(Some(request))
    }

    /// Value of a key of the query.
    pub fn query(&self, key: &str) -> Option<&str> {
        let pairs = self.query.split('&');
        pairs
            .filter_map(|pair| pair.split_once('='))
            .find_map(|(name, value)| (name == key).then_some(value))
    }
}

fn put(place: &mut Option<String>, text: &str) -> Result<(), Refusal> {
    match place.replace(text.to_owned()) {
        None => Ok(()),
        Some(_) => Err(Refusal::BAD),
    }
}

#[cfg(test)]
mod tests {
    use super::Request;
    use crate::response::Refusal;

    #[test]
    fn the_head_of_a_socket_is_read() {
        let text = "GET /live?token=abc&role=viewer HTTP/1.1\r\nHost: localhost:1\r\nUpgrade: WebSocket\r\n\
                    Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: a2V5\r\n\
                    Origin: http://localhost:1\r\n\r\nrest";
        let request = Request::parse(text.as_bytes()).unwrap().unwrap();
        assert_eq!((&*request.method, &*request.path), ("GET", "/live"));
        assert_eq!(request.query("role"), Some("viewer"));
        assert_eq!(request.query("other"), None);
        assert_eq!(request.socket_key.as_deref(), Some("a2V5"));
        assert_eq!(request.origin.as_deref(), Some("http://localhost:1"));
        assert_eq!(request.rest, b"rest");
        for end in 0..text.len() - "rest".len() {
            assert_eq!(Request::parse(&text.as_bytes()[..end]).unwrap(), None);
        }
    }

    #[test]
    fn a_second_host_and_no_http_are_refused() {
        let twice = b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n";
        assert_eq!(Request::parse(twice), Err(Refusal::BAD));
        assert_eq!(
            Request::parse(b"\x16\x03\x01 no\r\n\r\n"),
            Err(Refusal::BAD)
        );
    }
}
