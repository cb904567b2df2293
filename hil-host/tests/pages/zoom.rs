//! Dragging over a plot enlarges the selected part; a double click shows everything again.

use serde_json::Value;

use crate::browser::Browser;
use crate::shown::{DEMONSTRATION, VEHICLE};

/// Clears the recorded canvas texts before a mouse action.
const FORGET: &str = "window.lettering = [];";
/// Waits until the plots are redrawn; returns the texts of all redrawn canvases.
const WRITTEN: &str = "return window.lettering.map(({ text }) => text);";

/// Texts of the canvases that are redrawn after a mouse action.
fn written_after(browser: &Browser, act: impl FnOnce()) -> Vec<String> {
    browser.find(FORGET);
    act();
    browser.wait_for("window.lettering.length > 0");
    let written: Value = browser.find(WRITTEN);
    serde_json::from_value(written).unwrap()
}

fn shown_at_cursor(browser: &Browser, plot: usize) -> f64 {
    browser.point(plot, [0.5, 0.5]);
    let at = format!("document.querySelectorAll('.at')[{plot}].textContent");
    browser.wait_for(&format!("{at} !== ''"));
    let at = browser.find(&format!("return {at}"));
    at.as_str()
        .unwrap()
        .split(' ')
        .nth(1)
        .unwrap()
        .parse()
        .unwrap()
}

fn check_histories(width: u32) {
    let Some(browser) = Browser::start("zoom of histories") else {
        return;
    };
    browser.open(&VEHICLE, width);
    let middle = shown_at_cursor(&browser, 0);
    assert!((middle - 2.5).abs() < 0.02, "{middle}");
    let zoomed = written_after(&browser, || browser.drag(0, [0.2, 0.5], [0.4, 0.52]));
    assert!(
        ["1.4", "1.5", "1.50"]
            .iter()
            .any(|text| zoomed.iter().any(|found| found == text)),
        "{width}: {zoomed:?}"
    );
    // From 1 to 2 s, in the other panel and in the other figures too.
    for plot in [0, 1, 4] {
        let middle = shown_at_cursor(&browser, plot);
        assert!((middle - 1.5).abs() < 0.02, "{width}, {plot}: {middle}");
    }
    written_after(&browser, || browser.double_click(4));
    for plot in [0, 1, 4] {
        assert!(
            (shown_at_cursor(&browser, plot) - 2.5).abs() < 0.02,
            "{width}, {plot}"
        );
    }
}

fn check_loops(width: u32) {
    let Some(browser) = Browser::start("zoom of loops") else {
        return;
    };
    browser.open(&DEMONSTRATION, width);
    let whole = written_after(&browser, || {
        browser.double_click(3);
    });
    let zoomed = written_after(&browser, || browser.drag(3, [0.3, 0.3], [0.6, 0.6]));
    assert_ne!(whole, zoomed, "{width}");
    let last = |texts: &[String]| {
        let numbers = texts
            .iter()
            .filter_map(|text| text.replace('−', "-").parse::<f64>().ok());
        numbers.fold(0.0, f64::max)
    };
    // The whole plot goes up to 8 mm in displacement and 10 kN in force; the zoomed area covers a part of each range.
    assert!(
        last(&zoomed) < 0.7 * last(&whole),
        "{width}: {zoomed:?} of {whole:?}"
    );
    let again = written_after(&browser, || browser.double_click(3));
    assert_eq!(again, whole, "{width}");
}

#[test]
fn histories_zoom_together_on_a_desk() {
    check_histories(1280);
}

#[test]
fn histories_zoom_together_on_a_phone() {
    check_histories(390);
}

#[test]
fn loops_zoom_both_ways_on_a_desk() {
    check_loops(1280);
}

#[test]
fn loops_zoom_both_ways_on_a_phone() {
    check_loops(390);
}
