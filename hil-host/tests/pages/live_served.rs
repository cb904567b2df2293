//! The live page as `dashpot live` serves it: a recording, and a target.

use crate::browser::Browser;
use crate::common::dashpot;
use crate::common::live::Live;
use crate::pil_common::{desk, serve_tcp};

/// Texts of the notices that a page shows.
const NOTICES: &str =
    "return [...document.querySelectorAll('.notice:not([hidden])')].map(note => note.textContent);";

#[test]
fn a_recording_is_turned_by_the_slider_of_its_page() {
    let Some(browser) = Browser::start("a recording on the live page") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let case = ["--case", "straight-180", "--duration-s", "1"];
    let made = ["--output", "."];
    dashpot(&[&["vehicle"], &case[..], &made].concat(), folder.path()).success();
    let shown = [&case[..2], &["--recording", "history.csv"]].concat();
    let live = Live::start(&shown, folder.path());
    browser.visit(&format!("http://{}/", live.address), 1280);
    // The status may come before the last frames.
    browser.wait_for(
        "live.scene?.source === 'recording' && live.status?.factor === 0 && live.replay.isAtEnd()",
    );
    browser.find("document.getElementById('replay-time').focus(); return null;");
    for _ in 0..3 {
        // A tenth of a second back.
        browser.press("#replay-time", "\u{e012}");
    }
    browser.wait_for("Math.abs((live.histories[0].newest?.time_s ?? 0) - 0.7) < 0.002");
    let words = browser.find("return document.getElementById('replay-words').textContent;");
    assert!(words.as_str().unwrap().starts_with("0.7"), "{words}");
    // Nobody can change what has been recorded.
    let sliders = "return [...document.querySelectorAll('#quantities input')].filter(i => i.checkVisibility()).length;";
    assert_eq!(browser.find(sliders), 0);
    browser.click("#run");
    browser.wait_for("live.histories[0].newest.time_s > 0.8");
    assert_eq!(browser.find(NOTICES), serde_json::json!([]));
}

#[test]
fn who_watches_a_machine_takes_over_and_sees_the_vehicle_as_new() {
    let Some(browser) = Browser::start("a machine on the live page") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let live = Live::start(&["--case", "straight-180"], folder.path());
    browser.visit(&format!("http://{}/?role=viewer", live.address), 1280);
    browser.wait_for("live.scene?.source === 'machine' && live.histories[0].newest?.time_s > 0.2");
    let is_operable = "return !document.getElementById('compare').disabled;";
    assert_eq!(browser.find(is_operable), false);
    browser.click("#take-over");
    browser.wait_for("live.status.role === 'operator'");
    assert_eq!(browser.find(is_operable), true);
    browser.click("#compare");
    browser.wait_for("live.status.is_comparing && live.histories[1]?.newest?.ticks > 0");
    // A saved state is a file of the browser; the page hands it back to the program.
    // A busy machine may refuse to give it at once.
    browser.find(
        "const save = () => live.controls.ask({ do: 'save' }).then(answer => {
             if (/did not give its state in time/.test(answer.error)) save();
             else live.saved = answer.state ?? answer;
         });
         save();
         return null;",
    );
    browser.wait_for("live.saved");
    browser.find(
        "live.controls.ask({ do: 'load', state: live.saved }).then(({ error }) => (live.loaded = { error }));
         return null;",
    );
    browser.wait_for("live.loaded");
    assert_eq!(
        browser.find("return live.loaded.error;"),
        serde_json::Value::Null
    );
    browser.wait_for("live.status.is_comparing && live.histories[1]?.newest?.ticks > 0");
    assert_eq!(browser.find(NOTICES), serde_json::json!([]));
}

#[test]
fn a_target_moves_as_its_page_says() {
    let Some(browser) = Browser::start("a target on the live page") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let link = format!("tcp:{}", serve_tcp(|| Box::new(desk())));
    let live = Live::start(&["--link", &link, "--slot-damper", "paper"], folder.path());
    browser.visit(&format!("http://{}/?role=viewer", live.address), 390);
    browser.wait_for("live.scene?.source === 'target' && live.histories[0].newest?.time_s > 0.2");
    assert_eq!(browser.find("return live.status.role;"), "viewer");
    browser.visit(&format!("http://{}/", live.address), 1280);
    browser.wait_for("live.status?.role === 'operator'");
    let amplitude = "document.querySelector('#motion input[type=number]')";
    browser.find(&format!(
        "const field = {amplitude}; field.value = '20'; field.dispatchEvent(new Event('change', {{ bubbles: true }}));
         return null;"
    ));
    browser.wait_for("live.status.motion.amplitude_m === 0.02");
    assert_eq!(browser.find(NOTICES), serde_json::json!([]));
    browser.press("body", "\u{e00c}");
    browser.wait_for("/emergency stop/.test(live.status.ended ?? '')");
    assert!(live.end().status.success());
}
