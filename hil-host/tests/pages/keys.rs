//! Keys move the cursor of a plot and zoom it.

use crate::browser::Browser;
use crate::shown::{DEMONSTRATION, VEHICLE};

const RIGHT: &str = "\u{e014}";
const LEFT: &str = "\u{e012}";
const HOME: &str = "\u{e011}";
const END: &str = "\u{e010}";
const ESCAPE: &str = "\u{e00c}";

/// Time under the cursor of a plot.
fn time(browser: &Browser, plot: usize) -> f64 {
    let at = format!("document.querySelectorAll('.at')[{plot}].textContent");
    browser.wait_for(&format!("{at} !== ''"));
    let at = browser.find(&format!("return {at}"));
    let at = at.as_str().unwrap();
    at.split(' ').nth(1).unwrap().parse().unwrap()
}

#[test]
fn arrows_move_the_cursor_of_all_histories() {
    let Some(browser) = Browser::start("keys of a history") else {
        return;
    };
    browser.open(&VEHICLE, 1280);
    let pressed = |keys: &str| {
        browser.press(".plot", keys);
        // Another figure follows.
        let [own, other] = [0, 8].map(|plot| time(&browser, plot));
        assert!((own - other).abs() < 2e-3, "{own} {other}");
        own
    };
    // The run takes 5 s; a step is a two-hundredth of what is visible.
    assert!((pressed(RIGHT) - 2.5).abs() < 0.01);
    assert!((pressed(&RIGHT.repeat(4)) - 2.6).abs() < 0.01);
    assert!((pressed(LEFT) - 2.575).abs() < 0.01);
    assert!((pressed(END) - 5.0).abs() < 0.01);
    // Twice enlarged, the last 1.25 s are visible, and a step is shorter.
    assert!((pressed(&format!("++{LEFT}")) - (5.0 - 1.25 / 200.0)).abs() < 2e-3);
    // The visible part follows the cursor.
    assert!(pressed(HOME).abs() < 0.01);
    assert!((pressed(RIGHT) - 1.25 / 200.0).abs() < 2e-3);
    browser.press(".plot", ESCAPE);
    assert!((pressed(RIGHT) - 1.25 / 200.0 - 0.025).abs() < 3e-3);
    // Without the focus there is no cursor.
    browser.find("document.activeElement.blur();");
    browser.wait_for("[...document.querySelectorAll('.at')].every(at => at.textContent === '')");
}

#[test]
fn keys_move_along_a_loop_and_zoom_both_axes() {
    let Some(browser) = Browser::start("keys of a loop") else {
        return;
    };
    browser.open(&DEMONSTRATION, 1280);
    let value = "document.querySelectorAll('.panel')[3].querySelector('.value').textContent";
    // The fourth plot is the first loop.
    browser.find("document.querySelectorAll('.plot')[3].id = 'loop';");
    browser.press("#loop", HOME);
    let start = browser.find(&format!("return {value}"));
    browser.press("#loop", &RIGHT.repeat(20));
    browser.wait_for(&format!("{value} !== {start}"));
    browser.find("window.lettering = [];");
    browser.press("#loop", "+");
    browser.wait_for("window.lettering.length > 0");
    let written = browser.find("return window.lettering.map(({ text }) => text);");
    browser.find("window.lettering = [];");
    browser.press("#loop", "-");
    browser.wait_for("window.lettering.length > 0");
    let again = browser.find("return window.lettering.map(({ text }) => text);");
    assert_ne!(written, again);
}
