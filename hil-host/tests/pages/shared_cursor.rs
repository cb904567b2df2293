//! Under the mouse, a plot shows its values, and so does each plot that shares its cursor.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;

use crate::browser::Browser;
use crate::shown::VEHICLE;

/// Readout of each plot: cursor position, values, and whether the cursor line is visible.
const READOUTS: &str = "return [...document.querySelectorAll('.panel')].map(panel => {
    const plot = panel.querySelector('.plot').getBoundingClientRect();
    const line = panel.querySelector('.u-cursor-x')?.getBoundingClientRect();
    return {
        at: panel.querySelector('.at').textContent,
        values: [...panel.querySelectorAll('.head li')]
            .map(item => [item.dataset.curve, item.querySelector('.value').textContent]),
        line: line ? line.right > plot.left + 20 && line.right < plot.right : false,
        data: JSON.parse(panel.querySelector('script').textContent),
    };
});";

/// Abscissas (0) or ordinates (1) of a curve of a plot.
fn column(plot: &Value, curve: &Value, number: usize) -> Vec<f32> {
    let place = curve["columns"][number].as_u64().unwrap() as usize;
    let bytes = BASE64_STANDARD.decode(plot["columns"][place].as_str().unwrap());
    let bytes = bytes.unwrap();
    let numbers = bytes.chunks_exact(4);
    numbers
        .map(|four| f32::from_le_bytes(four.try_into().unwrap()))
        .collect()
}

/// Formats a number like the page.
fn number(text: &str) -> f32 {
    text.replace('−', "-").parse().unwrap()
}

/// Value of a curve at its abscissa nearest to `x`.
fn value_at(plot: &Value, curve: &Value, x: f32) -> f32 {
    let samples = column(plot, curve, 0)
        .into_iter()
        .zip(column(plot, curve, 1));
    let nearest = samples.min_by(|(a, _), (b, _)| (a - x).abs().total_cmp(&(b - x).abs()));
    nearest.unwrap().1
}

fn check(width: u32) {
    let Some(browser) = Browser::start("the cursor of plots") else {
        return;
    };
    browser.open(&VEHICLE, width);
    browser.point(1, [0.4, 0.6]);
    browser.wait_for("document.querySelectorAll('.at')[0].textContent !== ''");
    let readouts = browser.find(READOUTS);
    let readouts = readouts.as_array().unwrap();
    let (mut histories, mut loops) = (0, 0);
    for panel in readouts {
        if panel["data"]["x"]["label"] != "time, s" {
            loops += 1;
            assert_eq!((&panel["at"], &panel["line"]), (&"".into(), &false.into()));
            continue;
        }
        histories += 1;
        assert_eq!(
            (&panel["at"], &panel["line"]),
            (&readouts[1]["at"], &true.into()),
            "{width}"
        );
        let at = panel["at"].as_str().unwrap();
        let time = number(at.split(' ').nth(1).unwrap());
        assert!(at.starts_with("time ") && (time - 2.0).abs() < 0.03, "{at}");
        let curves = panel["data"]["curves"].as_array().unwrap();
        let values = panel["values"].as_array().unwrap();
        let named = curves.iter().filter(|curve| curve["name"] != "");
        assert!(values.len() == named.count() || values.len() == 1);
        let range = &panel["data"]["y"]["range"];
        let apart = (range[1].as_f64().unwrap() - range[0].as_f64().unwrap()) as f32;
        for item in values {
            let place: usize = item[0].as_str().unwrap().parse().unwrap();
            let (curve, shown) = (&curves[place], &item[1]);
            // The time is shown to the millisecond, so neighbouring samples are acceptable too.
            let near =
                [time - 1e-3, time, time + 1e-3].map(|time| value_at(&panel["data"], curve, time));
            let shown = number(shown.as_str().unwrap());
            let is_near = near
                .iter()
                .any(|value| (value - shown).abs() < 2e-3 * apart);
            assert!(
                is_near,
                "{width}, {}: {shown}, {near:?}",
                panel["data"]["y"]["label"]
            );
        }
    }
    assert!(histories == 44 && loops > 3, "{histories} {loops}");
    // With the mouse outside the plots, no values are shown.
    browser.leave();
    browser.wait_for(
        "[...document.querySelectorAll('.at, .value')].every(readout => readout.textContent === '')",
    );
}

#[test]
fn histories_share_their_cursor_on_a_desk() {
    check(1280);
}

#[test]
fn histories_share_their_cursor_on_a_phone() {
    check(390);
}
