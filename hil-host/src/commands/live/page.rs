//! The page that viewers get.

use dashpot_server::Page;

/// What the page is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setup {
    /// Name of the vehicle.
    pub vehicle: String,
}

/// What stands before the content policy in the page, and behind it.
const POLICY: [&str; 2] = ["http-equiv=\"Content-Security-Policy\" content=\"", "\""];

/// The page and its content policy.
pub fn document(setup: &Setup) -> Page {
    let html = dashpot_page::of_server(&setup.vehicle);
    let [before, behind] = POLICY;
    let policy = html
        .split_once(before)
        .and_then(|(_, rest)| rest.split_once(behind));
    // A page cannot forbid by itself that another one frames it, and clicks on it.
    let policy = policy.map_or("default-src 'none'", |(policy, _)| policy);
    let policy = format!("{policy}; frame-ancestors 'none'");
    Page { html, policy }
}
