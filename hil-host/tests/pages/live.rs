//! The live page: a locomotive that runs in the browser.

use serde_json::Value;

use crate::browser::Browser;
use crate::shown::LIVE;

/// Waits until the run has gone on by this number of seconds.
fn run_for(browser: &Browser, seconds: f64) {
    let now = browser
        .find("return live.histories[0].newest.time_s;")
        .as_f64()
        .unwrap();
    browser.wait_for(&format!(
        "live.histories[0].newest.time_s > {}",
        now + seconds
    ));
}

#[test]
fn a_person_worsens_a_damper_and_sees_its_force_go() {
    let Some(browser) = Browser::start("the live page in a browser") else {
        return;
    };
    let address = browser.open(&LIVE, 1280);
    browser.wait_for("live.scene && live.status && live.histories[0].newest?.time_s > 0.5");
    assert_eq!(browser.find("return live.scene.wheelsets.length;"), 6);
    run_for(&browser, 0.5);
    // As new, some yaw damper always has a force after 0.1 s. In fifteen millimetres, all move freely at times.
    let free = "[...live.index].filter(([name]) => /yaw_damper_\\d_force_n$/.test(name))\
                .filter(([, place]) => live.histories[0].newest.last[place] === 0).length";
    assert!(browser.find(&format!("return {free};")).as_f64().unwrap() < 8.0);
    browser.click("#try-worsen");
    browser.wait_for("live.status.dampers.filter(damper => damper.changed).length === 8");
    browser.wait_for(&format!("{free} === 8"));
    let values = browser
        .find("return live.status.dampers.map(damper => damper.values['mount.clearance_m']);");
    let wide = values
        .as_array()
        .unwrap()
        .iter()
        .filter(|value| value.as_f64() == Some(0.015));
    assert_eq!(wide.count(), 8);
    assert_eq!(
        browser.requests(&address),
        std::slice::from_ref(&address),
        "the page loads nothing"
    );
    let said: Vec<Value> = browser.log("browser");
    assert!(said.is_empty(), "{said:?}");
}

#[test]
fn a_slider_changes_the_damper_under_the_keyboard() {
    let Some(browser) = Browser::start("sliders of the live page") else {
        return;
    };
    browser.open(&LIVE, 390);
    browser.wait_for("live.scene && live.status && live.histories[0].newest?.time_s > 0.1");
    let before = browser
        .find("return JSON.stringify(live.status.dampers.map(damper => damper.values.wear));");
    // End: the slider's greatest value, which is full wear.
    browser.press("#quantities input[type=range]", "\u{e010}");
    browser.wait_for("live.status.dampers.some(damper => damper.values.wear === 1)");
    assert!(!before.as_str().unwrap().contains('1'), "{before}");
}

#[test]
fn the_browser_has_the_bits_of_the_native_program() {
    let Some(browser) = Browser::start("bits of the vehicle in a browser") else {
        return;
    };
    browser.open(&LIVE, 1280);
    browser.wait_for("live.scene && live.status");
    let found = browser.find_later("live.source.send({ do: 'digest' }).then(done);");
    assert_eq!(found["digest"], dashpot_live::REFERENCE_DIGEST, "{found}");
}
