//! A printed sheet: white, no table wider than the paper, no number broken over two lines.

use serde_json::json;

use crate::browser::Browser;
use crate::shown::{SHEET, VEHICLE};

/// A4 minus the margins of the style, at 96 pixels per inch.
const WIDTH: u32 = 687;

const MEASURE: &str = r#"
    const right = Math.max(...[...document.querySelectorAll("table, figure, .tiles")].map(e => e.getBoundingClientRect().right));
    const scrolls = [...document.querySelectorAll(".wide")].filter(e => getComputedStyle(e).overflowX !== "visible").length;
    const lines = cell => { const range = document.createRange(); range.selectNodeContents(cell);
        return new Set([...range.getClientRects()].map(r => Math.round(r.top / 4))).size; };
    const numbers = [...document.querySelectorAll("td")].filter(td => /^[−\d.]+$/.test(td.textContent));
    return { right, width: document.documentElement.scrollWidth, scrolls, numbers: numbers.length,
        broken: numbers.filter(td => lines(td) > 1).map(td => td.textContent),
        paper: getComputedStyle(document.body).backgroundColor,
        page: [...document.styleSheets].flatMap(s => [...s.cssRules]).filter(r => r.type === CSSRule.PAGE_RULE).map(r => r.style.size) };"#;

#[test]
fn a_sheet_fits_paper_and_is_white_from_a_dark_screen() {
    let Some(browser) = Browser::start("sheets on paper") else {
        return;
    };
    let features = json!([{ "name": "prefers-color-scheme", "value": "dark" }]);
    browser.tell(
        "Emulation.setEmulatedMedia",
        json!({ "media": "print", "features": features }),
    );
    browser.open(&SHEET, WIDTH);
    let found = browser.find(MEASURE);
    assert!(
        found["right"].as_f64().unwrap() <= f64::from(WIDTH),
        "{found}"
    );
    assert_eq!(found["width"], WIDTH, "{found}");
    assert_eq!(found["scrolls"], 0, "{found}");
    // Six tests with nine indices each.
    assert!(found["numbers"].as_u64().unwrap() > 60, "{found}");
    assert_eq!(found["broken"], json!([]), "{found}");
    assert_eq!(found["paper"], "rgb(255, 255, 255)", "{found}");
    assert_eq!(found["page"].as_array().unwrap().len(), 1, "{found}");
}

/// Half the height of A4 minus the margins of the style, at 96 pixels per inch.
const HALF: f64 = 500.0;

#[test]
fn two_figures_of_a_run_fit_on_a_page() {
    let Some(browser) = Browser::start("figures on paper") else {
        return;
    };
    browser.tell("Emulation.setEmulatedMedia", json!({ "media": "print" }));
    browser.open(&VEHICLE, WIDTH);
    browser.find("dispatchEvent(new Event('beforeprint'));");
    browser.wait_for("document.querySelector('canvas').clientHeight < 225");
    let found = browser.find(
        "const shown = element => getComputedStyle(element).display !== 'none';
         return {
             heights: [...document.querySelectorAll('figure')].map(figure => figure.getBoundingClientRect().height),
             controls: [...document.querySelectorAll('.contents, .data, .on-screen')].filter(shown).length,
         };",
    );
    let heights = found["heights"].as_array().unwrap();
    assert!(heights.len() > 10, "{found}");
    let all_fit = heights.iter().all(|height| height.as_f64().unwrap() < HALF);
    assert!(all_fit, "{found}");
    assert_eq!(found["controls"], 0, "{found}");
    // Back on the screen, plots have their own height again.
    browser.find("dispatchEvent(new Event('afterprint'));");
    browser.tell("Emulation.setEmulatedMedia", json!({ "media": "screen" }));
    browser.wait_for("document.querySelector('canvas').clientHeight >= 225");
}
