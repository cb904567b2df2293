//! Who may have the page, and who may connect.

use std::net::{IpAddr, SocketAddr};

use crate::request::Request;
use crate::response::Refusal;
use crate::token::Token;

/// Names of this machine's own address.
const OWN_NAMES: [&str; 3] = ["localhost", "127.0.0.1", "[::1]"];

/// What a request must have.
pub(crate) struct Access {
    /// Values of `Host` that are this server; `None` if others reach it by names that it does not know.
    hosts: Option<Vec<String>>,
    token: Option<Token>,
}

impl Access {
    /// Access to a server at `address`.
    pub fn new(address: SocketAddr, token: Option<Token>) -> Self {
        let names = OWN_NAMES.iter().map(|name| (*name).to_owned());
        let own = match address.ip() {
            IpAddr::V4(ip) => ip.to_string(),
            IpAddr::V6(ip) => format!("[{ip}]"),
        };
        let with_port = |name: String| format!("{name}:{}", address.port());
        Self {
            hosts: address
                .ip()
                .is_loopback()
                .then(|| names.chain([own]).map(with_port).collect()),
            token,
        }
    }

    /// Checks a request for the page or the socket.
    ///
    /// # Errors
    /// A page of another site asks, whose name its owner has pointed to this machine.
    pub fn check_host(&self, request: &Request) -> Result<(), Refusal> {
        let host = request.host.as_deref().ok_or(Refusal::BAD)?;
        match &self.hosts {
            Some(hosts) if !hosts.iter().any(|own| own.eq_ignore_ascii_case(host)) => {
                Err(Refusal::HOST)
            }
            _ => Ok(()),
        }
    }

    /// Checks a request for the socket.
    ///
    /// # Errors
    /// The page of another site asks, or the token is not right.
    pub fn check_socket(&self, request: &Request) -> Result<(), Refusal> {
        let host = request.host.as_deref().unwrap_or_default();
        let origin = request.origin.as_deref().unwrap_or_default();
        let origin = origin
            .strip_prefix("http://")
            .or_else(|| origin.strip_prefix("https://"));
        if !origin.is_some_and(|origin| origin.eq_ignore_ascii_case(host)) {
            return Err(Refusal::ORIGIN);
        }
        match &self.token {
            Some(token) if !token.is(request.query("token").unwrap_or_default()) => {
                Err(Refusal::TOKEN)
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Access;
    use crate::request::Request;
    use crate::response::Refusal;
    use crate::token::Token;

    fn from(host: &str, origin: Option<&str>, query: &str) -> Request {
        Request {
            host: Some(host.into()),
            origin: origin.map(str::to_owned),
            query: query.into(),
            ..Request::default()
        }
    }

    #[test]
    fn on_this_machine_only_its_own_names_with_the_port_are_the_host() {
        let access = Access::new("127.0.0.1:8089".parse().unwrap(), None);
        for host in [
            "localhost:8089",
            "127.0.0.1:8089",
            "[::1]:8089",
            "LocalHost:8089",
        ] {
            assert_eq!(access.check_host(&from(host, None, "")), Ok(()), "{host}");
        }
        for host in [
            "localhost",
            "evil.example:8089",
            "localhost:80890",
            "127.0.0.1.evil.example:8089",
        ] {
            assert_eq!(
                access.check_host(&from(host, None, "")),
                Err(Refusal::HOST),
                "{host}"
            );
        }
        let without = Request::default();
        assert_eq!(access.check_host(&without), Err(Refusal::BAD));
    }

    #[test]
    fn other_addresses_have_names_that_the_server_does_not_know() {
        let access = Access::new("0.0.0.0:8089".parse().unwrap(), None);
        assert_eq!(
            access.check_host(&from("bench.example:8089", None, "")),
            Ok(())
        );
    }

    #[test]
    fn only_the_page_of_the_same_host_connects() {
        let access = Access::new("127.0.0.1:1".parse().unwrap(), None);
        let check = |origin| access.check_socket(&from("localhost:1", origin, ""));
        assert_eq!(check(Some("http://localhost:1")), Ok(()));
        for origin in [
            None,
            Some("null"),
            Some("http://localhost:2"),
            Some("http://evil.example"),
            Some("file://"),
        ] {
            assert_eq!(check(origin), Err(Refusal::ORIGIN), "{origin:?}");
        }
    }

    #[test]
    fn the_token_is_needed_if_there_is_one() {
        let token = Token::new("abcdefghijkl".into()).unwrap();
        let access = Access::new("127.0.0.1:1".parse().unwrap(), Some(token));
        let check = |query| access.check_socket(&from("a", Some("http://a"), query));
        assert_eq!(check("token=abcdefghijkl"), Ok(()));
        assert_eq!(check("role=viewer&token=abcdefghijkl"), Ok(()));
        assert_eq!(check("token=abcdefghijk"), Err(Refusal::TOKEN));
        assert_eq!(check(""), Err(Refusal::TOKEN));
    }
}
