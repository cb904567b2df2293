//! The results of the model in a browser: each part has the bits of the native program.

use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use dashpot_physics::{Runs, STUDY, study};
use xtask::run::repository;
use xtask::web;

use crate::browser::Browser;

/// Digest of each part, which `tests/vehicle_validation/physics.rs` writes.
const PARTS: &str = "tests/golden/physics.txt";

#[test]
fn a_browser_has_the_bits_of_damper_bank_contact_vehicle_and_every_index() {
    let Some(browser) = Browser::start("results of the model in a browser") else {
        return;
    };
    let module = fs::read(web::build("dashpot-physics").unwrap()).unwrap();
    let path = repository().join(STUDY);
    let runs = serde_json::to_string(&Runs::of(&study(&path.to_string_lossy()))).unwrap();
    let encoded = |bytes: &[u8]| BASE64_STANDARD.encode(bytes);
    browser.open(
        &format!(
            "<!DOCTYPE html><title>results</title><script type='text/plain' id='module'>{}</script>\n\
             <script type='text/plain' id='runs'>{}</script>",
            encoded(&module),
            encoded(runs.as_bytes())
        ),
        1280,
    );
    let found = browser.find_later(
        "const text = id => atob(document.getElementById(id).textContent);
         const bytes = id => Uint8Array.from(text(id), letter => letter.charCodeAt(0));
         WebAssembly.instantiate(bytes('module'), {}).then(({ instance: { exports } }) => {
           const runs = bytes('runs');
           new Uint8Array(exports.memory.buffer, exports.input(runs.length), runs.length).set(runs);
           const at = exports.results();
           done(new TextDecoder().decode(new Uint8Array(exports.memory.buffer, at, exports.results_len())));
         }).catch(error => done(String(error)));",
    );
    let golden = fs::read_to_string(repository().join(PARTS)).unwrap();
    assert_eq!(found.as_str().unwrap(), golden);
}
