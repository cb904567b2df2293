//! Drawing of each kind of curve, in its own panel.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

use crate::browser::Browser;
use crate::shown::DEMONSTRATION;

/// Numbers of pixels in the curve's colour (opaque and pale) and of all pixels between the axes, in the first plot.
const COUNT: &str = "
    const canvas = document.querySelector('canvas');
    const { clientWidth, clientHeight } = document.querySelector('.u-over');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let [opaque, pale] = [0, 0];
    for (let i = 0; i < data.length; i += 4)
        if (data[i] > 180 && data[i + 1] < 60 && data[i + 2] < 60) data[i + 3] > 200 ? opaque++ : pale++;
    return [opaque, pale, clientWidth * clientHeight];";

fn column(values: &[f32]) -> String {
    let bytes: Vec<u8> = values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    BASE64_STANDARD.encode(bytes)
}

/// Returns the demo page with the first plot replaced by a curve with abscissas 2, 10 and 50 and the ordinate 2, or 2
/// to 20 for bands and bars, on linear or logarithmic axes.
fn page(stroke: &str, decades: bool) -> String {
    let marker = "<script type=\"application/json\">";
    let (before, rest) = DEMONSTRATION.split_once(marker).unwrap();
    let (_, after) = rest.split_once("</script>").unwrap();
    let mut columns = vec![column(&[2.0, 10.0, 50.0]), column(&[2.0, f32::NAN, 2.0])];
    if matches!(stroke, "band" | "bars") {
        columns = vec![
            column(&[2.0, 10.0, 50.0]),
            column(&[2.0; 3]),
            column(&[20.0; 3]),
        ];
    }
    let places: Vec<usize> = (0..columns.len()).collect();
    let axis = |label: &str| json!({ "label": label, "decades": decades, "range": [1.0, 100.0] });
    let curve = json!({
        "stroke": stroke, "width": 4, "colours": ["#ff0000", "#ff0000"], "rises": true, "columns": places,
    });
    let plot = json!({ "height": 300, "x": axis("x"), "y": axis("y"), "columns": columns, "curves": [curve, curve] });
    format!("{before}{marker}{plot}</script>{after}")
}

fn drawn(browser: &Browser, stroke: &str, decades: bool) -> [f64; 3] {
    browser.open(&page(stroke, decades), 1280);
    let found: Value = browser.find(COUNT);
    serde_json::from_value(found).unwrap()
}

#[test]
fn bands_are_areas_and_bars_are_strokes() {
    let Some(browser) = Browser::start("kinds of curves") else {
        return;
    };
    // On logarithmic scales, 2 to 20 is half of two decades and 2 to 50 is 1.4 decades; on linear scales they are 18
    // and 48 of 99.
    for (decades, part) in [(true, 0.5 * 0.699), (false, 18.0 * 48.0 / 99.0 / 99.0)] {
        let [opaque, pale, all] = drawn(&browser, "band", decades);
        // Grid lines show through.
        let share = pale / all / part;
        assert!(opaque == 0.0 && (0.88..1.01).contains(&share), "{share}");
    }
    let [bars, ..] = drawn(&browser, "bars", true);
    // Three strokes of half the height, four pixels wide.
    assert!((1400.0..1600.0).contains(&bars), "{bars}");
}

#[test]
fn missing_values_interrupt_a_line_and_isolated_points_are_dots() {
    let Some(browser) = Browser::start("kinds of curves") else {
        return;
    };
    assert_eq!(drawn(&browser, "line", true)[0], 0.0, "no two neighbours");
    let [points, ..] = drawn(&browser, "points", true);
    // Two dots, seven pixels wide.
    assert!((60.0..90.0).contains(&points), "{points}");
    let [marks, ..] = drawn(&browser, "marks", true);
    // Three dots, ten pixels high.
    assert!((110.0..130.0).contains(&marks), "{marks}");
}
