//! The demonstration's page in a browser, as wide as a phone and as a desk.

use std::path::Path;
use std::process::Command;

use serde_json::Value;
use xtask::tools::{CHROMIUM, have};

use crate::common::dashpot;

/// Frames of both widths, which measure themselves once loaded: the page's width, the figures shown,
/// those wider than the page, and the smallest lettering in pixels.
const FRAMES: &str = r#"<!DOCTYPE html><meta charset="utf-8"><body>
<iframe src="page.html" width="390" height="800"></iframe>
<iframe src="page.html" width="1280" height="800"></iframe>
<pre></pre>
<script>
addEventListener("load", () => {
  const measure = frame => {
    const page = frame.contentDocument;
    const shown = [...page.querySelectorAll("svg")].filter(svg => svg.getBoundingClientRect().width > 0);
    const size = element => parseFloat(getComputedStyle(element).fontSize);
    const lettering = shown.flatMap(svg => {
      const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
      return [...svg.querySelectorAll("text")].map(text => scale * size(text));
    });
    const text = [...page.querySelectorAll("p, td, th, figcaption, span, footer")].map(size);
    return {
      page_width: page.documentElement.scrollWidth,
      figures: shown.map(svg => svg.getAttribute("class")),
      too_wide: shown.filter(svg => svg.getBoundingClientRect().right > frame.clientWidth).length,
      figure_lettering: Math.min(...lettering),
      text_lettering: Math.min(...text),
    };
  };
  const found = [...document.querySelectorAll("iframe")].map(measure);
  document.querySelector("pre").textContent = JSON.stringify(found);
});
</script>"#;

/// What the frames measured.
fn measured(folder: &Path) -> Vec<Value> {
    std::fs::write(folder.join("frames.html"), FRAMES).unwrap();
    let output = Command::new(CHROMIUM.program)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-background-networking",
            // As on a phone, where they take no width.
            "--hide-scrollbars",
            // The frames read the pages in them.
            "--allow-file-access-from-files",
            "--dump-dom",
        ])
        .arg(format!(
            "--user-data-dir={}",
            folder.join("profile").display()
        ))
        .arg(format!("file://{}", folder.join("frames.html").display()))
        .output()
        .unwrap();
    let page = String::from_utf8(output.stdout).unwrap();
    let found = page
        .split_once("<pre>")
        .and_then(|(_, rest)| rest.split_once("</pre>"))
        .map(|(found, _)| found);
    serde_json::from_str(found.unwrap_or_default())
        .unwrap_or_else(|error| panic!("{error}: {page}"))
}

#[test]
fn the_page_fits_a_phone_and_a_desk() {
    if !have(&[CHROMIUM], "the page's layout in a browser") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    dashpot(&["--output", "page.html"], folder.path()).success();
    let found = measured(folder.path());
    for ((page, width), class) in found.iter().zip([390, 1280]).zip(["phone", "desk"]) {
        assert_eq!(page["page_width"], width, "scrolls sideways: {page}");
        assert_eq!(page["figures"], serde_json::json!(vec![class; 9]), "{page}");
        assert_eq!(page["too_wide"], 0, "{page}");
        for (key, least) in [("figure_lettering", 10.5), ("text_lettering", 13.0)] {
            assert!(page[key].as_f64().unwrap() >= least, "{key}: {page}");
        }
    }
    assert_eq!(found.len(), 2);
}
