//! What a page's browser may load and run: nothing but what stands in the page.
//!
//! W3C, Content Security Policy Level 3: an inline script or style runs where the policy has the hash of its text.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};

/// The policy of a page with these texts as its scripts and styles.
pub(super) fn of(scripts: &[&str], styles: &[&str]) -> String {
    format!(
        "default-src 'none'; script-src {}; style-src {}; base-uri 'none'; form-action 'none'",
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

    /// The example of the specification, section 2.3.3.
    #[test]
    fn a_script_is_allowed_by_its_hash() {
        let policy = of(&["doSomething();"], &[]);
        assert!(
            policy.contains("script-src 'sha256-RFWPLDbv2BY+rCkDzsE+0fr8ylGr2R2faWMhq4lfEQc=';"),
            "{policy}"
        );
    }
}
