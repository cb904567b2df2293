//! Pages: self-contained HTML, all in one style, for light and dark screens, phones and desks. Their plots are drawn
//! by the page itself, with zoom and shared cursor, from the numbers it carries.

mod colour;
mod figure;
mod policy;
mod series;

pub use figure::{Figure, panel};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::DrawError;

/// The plotting library (uplot/README.md), then what uses it.
const SCRIPTS: [&str; 2] = [
    include_str!("uplot/uPlot.iife.min.js"),
    include_str!("plots.js"),
];
/// The library's licence asks to be kept where the library is.
const LICENCE: &str = include_str!("uplot/LICENSE");
/// The library's style, then the page's own.
const STYLES: [&str; 2] = [
    include_str!("uplot/uPlot.min.css"),
    include_str!("page.css"),
];

/// The text of a page with `title` and `body`.
pub fn document(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy::of(&SCRIPTS, &STYLES));
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                @for style in STYLES { style { (PreEscaped(style)) } }
            }
            body {
                main {
                    noscript {
                        p.note {
                            "The plots are missing: they are drawn by the page's own script, which does not run here. Text and tables are \
                             complete."
                        }
                    }
                    (body)
                }
                (PreEscaped(format!("<!-- uPlot\n{LICENCE}-->\n")))
                @for script in SCRIPTS { script { (PreEscaped(script)) } }
            }
        }
    };
    page.into_string() + "\n"
}

/// The headline in figures: each a value and what it is.
pub fn tiles(tiles: &[(Markup, String)]) -> Markup {
    html! {
        div.tiles {
            @for (value, meaning) in tiles {
                div.tile { b { (value) } span { (meaning) } }
            }
        }
    }
}

/// A figure with its caption.
///
/// # Errors
/// Its numbers cannot be written.
pub fn figure(figure: &Figure, caption: &Markup) -> Result<Markup, DrawError> {
    figure.html(caption)
}

/// What made the page, and `text`.
pub fn footer(text: &Markup) -> Markup {
    html! {
        footer {
            "dashpot " (env!("CARGO_PKG_VERSION")) " on " (std::env::consts::ARCH) " "
            (std::env::consts::OS) (built()) ". " (text)
        }
    }
}

/// A note where the program is slower than it could be.
pub fn built() -> &'static str {
    if cfg!(debug_assertions) {
        "; development build, a release build is faster"
    } else {
        ""
    }
}
