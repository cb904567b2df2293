//! Pages: self-contained HTML with inline SVG, all in one style, for light and dark screens, phones and
//! desks.

mod figure;

pub(crate) use figure::{Figure, panel};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::report::DrawError;

const STYLE: &str = include_str!("page.css");

/// The text of a page with `title` and `body`.
pub(crate) fn document(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { main { (body) } }
        }
    };
    page.into_string() + "\n"
}

/// The headline in figures: each a value and what it is.
pub(crate) fn tiles(tiles: &[(Markup, String)]) -> Markup {
    html! {
        div.tiles {
            @for (value, meaning) in tiles {
                div.tile { b { (value) } span { (meaning) } }
            }
        }
    }
}

/// A figure drawn twice, for a desk and for a phone; the style shows the one that fits.
///
/// # Errors
/// The drawing fails.
pub(crate) fn figure(figure: &Figure, caption: &Markup) -> Result<Markup, DrawError> {
    // Sized by the page; inline SVG has its namespace from HTML.
    let inline = |svg: String, class: &str| {
        let svg = svg
            .replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1)
            .replacen("<svg", &format!("<svg class=\"{class}\""), 1);
        PreEscaped(svg)
    };
    Ok(html! {
        figure {
            (inline(figure.desk()?, "desk"))
            (inline(figure.phone()?, "phone"))
            figcaption { (caption) }
        }
    })
}

/// What made the page, and `text`.
pub(crate) fn footer(text: &Markup) -> Markup {
    html! {
        footer {
            "dashpot " (env!("CARGO_PKG_VERSION")) " on " (std::env::consts::ARCH) " "
            (std::env::consts::OS) (built()) ". " (text)
        }
    }
}

/// A note where the program is slower than it could be.
pub(crate) fn built() -> &'static str {
    if cfg!(debug_assertions) {
        "; development build, a release build is faster"
    } else {
        ""
    }
}
