//! A click on a name in a legend hides its curve, and another click shows it again; the axes stay.

use serde_json::Value;

use crate::browser::Browser;
use crate::shown::HEALTH;

/// Pixels in the colours of the curves of the first plot, and whether the second button is pressed.
const FOUND: &str = r#"
    const { curves } = JSON.parse(document.querySelector('script[type="application/json"]').textContent);
    const canvas = document.querySelector("canvas");
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    const counts = curves.map(({ colours }) => {
        const wanted = [1, 3, 5].map(i => parseInt(colours[0].slice(i, i + 2), 16));
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4)
            if (pixels[i + 3] > 200 && wanted.every((part, k) => Math.abs(part - pixels[i + k]) < 8)) count++;
        return count;
    });
    const buttons = [...document.querySelector(".head").querySelectorAll("li button")];
    return { counts, names: curves.map(curve => curve.name), pressed: buttons.map(button => button.ariaPressed) };"#;

fn number(value: &Value) -> u64 {
    value.as_u64().unwrap()
}

fn check(act: impl Fn(&Browser)) {
    let Some(browser) = Browser::start("legends that hide curves") else {
        return;
    };
    browser.open(&HEALTH, 1280);
    let before = browser.find(FOUND);
    // A band, the estimate, the baseline, and the two limits, the first of which has no name.
    assert_eq!(
        before["names"],
        serde_json::json!(["", "estimate", "baseline", "", "alarm limits"])
    );
    assert_eq!(
        before["pressed"],
        serde_json::json!(["true", "true", "true"])
    );
    assert!(number(&before["counts"][4]) > 100, "{before}");
    browser.find("window.lettering = [];");
    act(&browser);
    browser.wait_for("window.lettering.length > 0");
    let hidden = browser.find(FOUND);
    assert_eq!(
        hidden["pressed"],
        serde_json::json!(["true", "true", "false"])
    );
    // Both limits disappear, and nothing else.
    assert_eq!(number(&hidden["counts"][4]), 0, "{hidden}");
    assert!(number(&hidden["counts"][1]) >= number(&before["counts"][1]));
    let written = browser.find("return window.lettering.map(({ text }) => text);");
    assert!(
        written
            .as_array()
            .unwrap()
            .iter()
            .any(|text| text == "1.50")
    );
    act(&browser);
    browser.wait_for(
        "document.querySelector('.head').querySelectorAll('li button')[2].ariaPressed === 'true'",
    );
    browser.wait_for("window.lettering.filter(({ text }) => text === '1.50').length > 1");
    assert_eq!(browser.find(FOUND), before);
}

#[test]
fn a_click_hides_and_shows_a_curve() {
    check(|browser| browser.click(".head li:nth-child(3) button"));
}

#[test]
fn the_space_bar_hides_and_shows_a_curve() {
    check(|browser| browser.press(".head li:nth-child(3) button", " "));
}
