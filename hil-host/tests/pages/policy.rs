//! A page loads nothing: a request made by a script in it never leaves the browser.

use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::net::{SocketAddr, TcpListener};

use serde_json::Value;

use crate::browser::Browser;
use crate::shown::{DEMONSTRATION, all};

/// Result of a request to a server on this machine.
fn fetched(browser: &Browser, server: SocketAddr) -> Value {
    browser.find_later(&format!(
        "addEventListener('securitypolicyviolation', event => done(event.effectiveDirective));
         fetch('http://{server}/', {{ mode: 'no-cors' }}).then(() => done('fetched'));"
    ))
}

#[test]
fn the_policy_of_a_page_stops_a_request() {
    let Some(browser) = Browser::start("the security policy of pages") else {
        return;
    };
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let server = listener.local_addr().unwrap();
    listener.set_nonblocking(true).unwrap();
    browser.open(&DEMONSTRATION, 1280);
    assert_eq!(fetched(&browser, server), "connect-src");
    let nobody = listener.accept().unwrap_err();
    assert_eq!(nobody.kind(), ErrorKind::WouldBlock);

    // Without its policy, the same page reaches the server, so the policy blocks the request.
    listener.set_nonblocking(false).unwrap();
    let serving = std::thread::spawn(move || {
        let (mut asked, _) = listener.accept().unwrap();
        let request = BufReader::new(asked.try_clone().unwrap()).lines();
        let lines = request.map_while(Result::ok);
        assert!(lines.take_while(|line| !line.is_empty()).count() > 0);
        asked.write_all(b"HTTP/1.1 204 No Content\r\n\r\n").unwrap();
    });
    let (before, rest) = DEMONSTRATION.split_once("<meta http-equiv").unwrap();
    let (_, after) = rest.split_once('>').unwrap();
    browser.open(&format!("{before}{after}"), 1280);
    assert_eq!(fetched(&browser, server), "fetched");
    serving.join().unwrap();
}

/// The policy allows content of the page only by its hash, never by a keyword, and the content has no address.
#[test]
fn the_policy_allows_only_the_content_of_the_page() {
    for (name, page, ..) in all() {
        let policy = page
            .split_once("Content-Security-Policy\" content=\"")
            .unwrap()
            .1;
        let policy = policy.split_once('"').unwrap().0;
        assert!(
            policy.starts_with("default-src 'none'; script-src 'sha256-"),
            "{name}: {policy}"
        );
        assert!(
            !policy.contains("unsafe") && !policy.contains('*'),
            "{name}: {policy}"
        );
        for outside in ["<link", "src=", "url(", "@import", " style=\""] {
            assert!(!page.contains(outside), "{name}: {outside}");
        }
    }
}
