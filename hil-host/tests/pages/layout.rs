//! Pages at the width of a phone and of a desktop: nothing is too wide, too small or empty, and nothing is requested
//! from a network.

use serde_json::Value;

use crate::browser::Browser;
use crate::shown::all;

/// Width of the page, smallest text, and for each plot: its right edge, the width of its canvas, and the number of
/// pixels in the colour of each curve.
const MEASURE: &str = r#"
    const size = element => parseFloat(getComputedStyle(element).fontSize);
    const text = [...document.querySelectorAll("p, td, th, figcaption, span, footer, .head li")].map(size);
    for (const drawing of document.querySelectorAll("svg.drawing")) {
        const scale = drawing.getBoundingClientRect().width / drawing.viewBox.baseVal.width;
        for (const text of drawing.querySelectorAll("text")) window.lettering.push({ text: text.textContent, size: scale * size(text) });
    }
    const parts = colour => [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16));
    const plots = [...document.querySelectorAll(".plot")].map(plot => {
        const canvas = plot.querySelector("canvas");
        const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        const { curves } = JSON.parse(plot.nextElementSibling.textContent);
        const drawn = curves.map(curve => {
            const wanted = parts(curve.colours[0]);
            let count = 0;
            for (let i = 0; i < pixels.length; i += 4)
                if (pixels[i + 3] > 60 && wanted.every((part, k) => Math.abs(part - pixels[i + k]) < 24)) count++;
            return count;
        });
        const { right } = plot.getBoundingClientRect();
        return { right, width: canvas.clientWidth, height: canvas.clientHeight, name: plot.ariaLabel, drawn };
    });
    return {
        width: document.documentElement.scrollWidth,
        text: Math.min(...text),
        lettering: Math.min(...window.lettering.map(({ size }) => size)),
        written: window.lettering.map(({ text }) => text),
        plots,
    };"#;

fn check((name, page, plots, label): (&str, &str, usize, &str), width: u32) {
    let Some(browser) = Browser::start("the layout of pages") else {
        return;
    };
    let address = browser.open(page, width);
    let found = browser.find(MEASURE);
    let number = |value: &Value| value.as_f64().unwrap();
    let context = format!("{name} at {width}");
    assert_eq!(found["width"], width, "{context}: scrolls sideways");
    assert!(
        number(&found["text"]) >= 13.0,
        "{context}: {}",
        found["text"]
    );
    assert!(
        number(&found["lettering"]) >= 10.5,
        "{context}: {}",
        found["lettering"]
    );
    let drawn = found["plots"].as_array().unwrap();
    assert_eq!(drawn.len(), plots, "{context}");
    for plot in drawn {
        assert!(
            number(&plot["right"]) <= f64::from(width),
            "{context}: {plot}"
        );
        // On a desktop, up to three plots are side by side.
        let min_px = 300.0;
        assert!(
            number(&plot["width"]) >= min_px && number(&plot["height"]) >= 200.0,
            "{context}: {plot}"
        );
        let curves = plot["drawn"].as_array().unwrap();
        assert!(
            curves.iter().any(|pixels| number(pixels) >= 40.0),
            "{context}: {plot}"
        );
    }
    let written = found["written"].as_array().unwrap();
    let is_written = |text: &str| written.iter().any(|other| other == text);
    assert!(
        is_written(label) && is_written("0"),
        "{context}: {written:?}"
    );
    let console = browser.log("browser");
    assert!(console.is_empty(), "{context}: {console:?}");
    assert_eq!(browser.requests(&address), [address], "{context}");
}

#[test]
fn pages_fit_a_desk() {
    for page in all() {
        check(page, 1280);
    }
}

#[test]
fn pages_fit_a_phone() {
    for page in all() {
        check(page, 390);
    }
}
