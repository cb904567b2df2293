//! Plots follow the light or dark scheme of the screen, and are light on paper.

use serde_json::json;

use crate::browser::Browser;
use crate::shown::DEMONSTRATION;

/// Returns an expression that is true if the key of the second curve in the legend and some pixels of the first canvas
/// have the curve's colour for a light (0) or dark (1) screen.
fn is(scheme: usize) -> String {
    format!(
        "(() => {{
            const {{ curves }} = JSON.parse(document.querySelector('script[type=\"application/json\"]').textContent);
            const canvas = document.querySelector('canvas');
            const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            const wanted = [1, 3, 5].map(i => parseInt(curves[1].colours[{scheme}].slice(i, i + 2), 16));
            let count = 0;
            for (let i = 0; i < pixels.length; i += 4)
                if (wanted.every((part, k) => pixels[i + k] === part)) count++;
            const key = getComputedStyle(document.querySelectorAll('.key')[1]).color;
            return count > 20 && key === `rgb(${{wanted.join(', ')}})`;
        }})()"
    )
}

#[test]
fn plots_are_drawn_again_when_the_screen_turns_dark() {
    let Some(browser) = Browser::start("light and dark screens") else {
        return;
    };
    let turn = |scheme: &str| {
        let features = json!([{ "name": "prefers-color-scheme", "value": scheme }]);
        browser.tell(
            "Emulation.setEmulatedMedia",
            json!({ "features": features }),
        );
    };
    browser.open(&DEMONSTRATION, 1280);
    let (light, dark) = (is(0), is(1));
    browser.wait_for(&light);
    turn("dark");
    browser.wait_for(&dark);
    // Paper is white.
    browser.find("dispatchEvent(new Event('beforeprint'));");
    browser.wait_for(&light);
    browser.find("dispatchEvent(new Event('afterprint'));");
    browser.wait_for(&dark);
    turn("light");
    browser.wait_for(&light);
}
