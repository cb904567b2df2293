//! Self-contained HTML pages in one style, for light and dark screens, phones and desktops. A script in the page draws
//! the plots from numbers in the page, with zoom and a shared cursor.

mod colour;
mod contents;
mod figure;
mod heat;
mod policy;
mod series;
mod verdict;

pub use crate::plot::sheet::panel;
pub use figure::Figure;
pub use heat::{HeatAxis, HeatMap};
pub use verdict::{judged, share_cell, verdict};

use maud::{DOCTYPE, Markup, PreEscaped, html};
pub use policy::{content_policy, content_policy_with};

use crate::DrawError;

/// Scripts of a page: the plotting library (uplot/README.md), the controls of a plot, then the code that uses both.
const SCRIPTS: [&str; 5] = [
    include_str!("uplot/uPlot.iife.min.js"),
    include_str!("legend.js"),
    include_str!("data.js"),
    include_str!("keys.js"),
    include_str!("plots.js"),
];
/// Licence of the plotting library, which must accompany it.
const LICENCE: &str = include_str!("uplot/LICENSE");
/// Style sheets of a page: that of the library, then our own.
const STYLES: [&str; 2] = [
    include_str!("uplot/uPlot.min.css"),
    include_str!("page.css"),
];

/// Returns the text of a page with `title` and `body`. Its second-level headings become its contents.
pub fn document(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy::content_policy(&SCRIPTS, &STYLES));
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                @for style in STYLES { style { (PreEscaped(style)) } }
            }
            body {
                main.report { (content(body)) }
                (PreEscaped(licence()))
                @for script in SCRIPTS { script { (PreEscaped(script)) } }
            }
        }
    };
    page.into_string() + "\n"
}

/// What a page consists of, for a page that begins with something else.
#[derive(Debug, Clone)]
pub struct Parts {
    /// Style sheets.
    pub styles: &'static [&'static str],
    /// Content of the page's `body`.
    pub body: String,
    /// Scripts, which come after the body.
    pub scripts: &'static [&'static str],
}

/// Returns the parts of a page with `body`, which has no heading of the first level.
pub fn parts(body: &Markup) -> Parts {
    let article = html! { article.report { (content(body)) } };
    Parts {
        styles: &STYLES,
        body: article.into_string() + &licence(),
        scripts: &SCRIPTS,
    }
}

fn content(body: &Markup) -> Markup {
    html! {
        noscript {
            p.note {
                "The plots are missing because the page's script does not run here. Text and tables are complete."
            }
        }
        (PreEscaped(contents::with_contents(&body.0)))
    }
}

fn licence() -> String {
    format!("<!-- uPlot\n{LICENCE}-->\n")
}

/// Returns a row of key figures, each with a value and its meaning.
pub fn tiles(tiles: &[(Markup, String)]) -> Markup {
    html! {
        div.tiles {
            @for (value, meaning) in tiles {
                div.tile { b { (value) } span { (meaning) } }
            }
        }
    }
}

/// Returns a figure with its caption.
///
/// # Errors
/// Returns an error if the numbers cannot be written.
pub fn figure(figure: &Figure, caption: &Markup) -> Result<Markup, DrawError> {
    figure.html(caption)
}

/// Returns the footer, with the use of the plots, program version, platform and `text`.
pub fn footer(text: &Markup) -> Markup {
    html! {
        footer {
            p.on-screen {
                "Plots: drag to zoom, double-click to reset. A name in a legend hides its curve, and “data” saves the "
                "numbers. Keys: the arrows, Home and End move the cursor, + and − zoom, Escape resets."
            }
            "dashpot " (env!("CARGO_PKG_VERSION")) " on " (std::env::consts::ARCH) " "
            (std::env::consts::OS) (built()) ". " (text)
        }
    }
}

/// Returns a note if this is a development build; empty for a release build.
pub fn built() -> &'static str {
    if cfg!(debug_assertions) {
        "; development build, a release build is faster"
    } else {
        ""
    }
}
