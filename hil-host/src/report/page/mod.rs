//! Pages: self-contained HTML with inline SVG, all in one style, for light and dark screens, phones and
//! desks.

mod figure;

pub(crate) use figure::{Figure, panel};

use crate::report::DrawError;

const STYLE: &str = include_str!("page.css");

/// The page with `title` and the parts of its body.
pub(crate) fn document(title: &str, parts: &[String]) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{}\n</main>\n</body>\n</html>\n",
        parts.join("\n")
    )
}

/// The headline in figures: each a value and what it is.
pub(crate) fn tiles(tiles: &[(String, String)]) -> String {
    let tiles: Vec<String> = tiles
        .iter()
        .map(|(value, told)| format!("<div class=\"tile\"><b>{value}</b><span>{told}</span></div>"))
        .collect();
    format!("<div class=\"tiles\">\n{}\n</div>", tiles.join("\n"))
}

/// A figure drawn twice, for a desk and for a phone; the style shows the one that fits.
///
/// # Errors
/// The drawing fails.
pub(crate) fn figure(figure: &Figure, caption: &str) -> Result<String, DrawError> {
    // Sized by the page; inline SVG has its namespace from HTML.
    let inline = |svg: String, class: &str| {
        svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1)
            .replacen("<svg", &format!("<svg class=\"{class}\""), 1)
    };
    let (desk, phone) = (
        inline(figure.desk()?, "desk"),
        inline(figure.phone()?, "phone"),
    );
    Ok(format!(
        "<figure>\n{desk}\n{phone}\n<figcaption>{caption}</figcaption>\n</figure>"
    ))
}

/// What made the page, with what else there is to tell.
pub(crate) fn footer(told: &str) -> String {
    format!(
        "<footer>dashpot {} on {} {}{}. {told}</footer>",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::ARCH,
        std::env::consts::OS,
        built()
    )
}

/// A note where the program is slower than it could be.
pub(crate) fn built() -> &'static str {
    if cfg!(debug_assertions) {
        "; development build, a release build is faster"
    } else {
        ""
    }
}

/// `text` as HTML shows it.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
