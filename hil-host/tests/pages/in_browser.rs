//! The results of the model in a browser: each part has the bits of the native program.

use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use dashpot_physics::{Runs, STUDY, study};
use serde_json::Value;
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
    // In a worker, so that the page answers meanwhile.
    browser.find(
        "const text = id => document.getElementById(id).textContent;
         const work = async ({ data: { module, runs } }) => {
           const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
           const { instance: { exports } } = await WebAssembly.instantiate(bytes(module), {});
           const content = bytes(runs);
           // Each call may grow the memory, and with it replace its buffer.
           const input = exports.input(content.length);
           new Uint8Array(exports.memory.buffer, input, content.length).set(content);
           const at = exports.results();
           postMessage(new TextDecoder().decode(new Uint8Array(exports.memory.buffer, at, exports.results_len())));
         };
         const place = URL.createObjectURL(new Blob([`onmessage = ${work}; onerror = error => postMessage(error)`]));
         const worker = new Worker(place);
         worker.onmessage = ({ data }) => { window.results = data; };
         worker.onerror = error => { window.results = String(error.message); };
         worker.postMessage({ module: text('module'), runs: text('runs') });",
    );
    let mut found = Value::Null;
    while found.is_null() {
        found = browser.find_later("setTimeout(() => done(window.results ?? null), 200);");
    }
    let golden = fs::read_to_string(repository().join(PARTS)).unwrap();
    assert_eq!(found.as_str().unwrap(), golden);
}
