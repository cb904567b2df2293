//! Content security policy: the browser may load and run only the content of the page itself.
//!
//! An inline script or style is allowed if the policy contains the hash of its text (W3C, Content Security Policy Level
//! 3).

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};

/// Returns the policy of a page with these scripts and styles.
pub fn content_policy(scripts: &[&str], styles: &[&str]) -> String {
    content_policy_with(scripts, styles, "", "")
}

/// Returns the policy of a page that needs more: another source of scripts after a space, and other directives after a
/// semicolon and a space.
pub fn content_policy_with(
    scripts: &[&str],
    styles: &[&str],
    script_source: &str,
    directives: &str,
) -> String {
    format!(
        "default-src 'none'; script-src {}{script_source}; style-src {}; base-uri 'none'; form-action 'none'\
         {directives}",
        hashes(scripts),
        hashes(styles)
    )
}

fn hashes(texts: &[&str]) -> String {
    let hash = |text: &&str| format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(text)));
    texts.iter().map(hash).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example in section 2.3.3 of the specification.
    #[test]
    fn a_script_is_allowed_by_its_hash() {
        let policy = content_policy(&["doSomething();"], &[]);
        assert!(
            policy.contains("script-src 'sha256-RFWPLDbv2BY+rCkDzsE+0fr8ylGr2R2faWMhq4lfEQc=';"),
            "{policy}"
        );
    }
}
