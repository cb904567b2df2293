#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod files;
mod pack;

use dashpot_files::case::CASES;
use dashpot_files::track::TRACKS;
use dashpot_files::vehicle::VEHICLES;
use dashpot_live::{Choice, REFERENCE_DIGEST};
use dashpot_report::page::{Parts, content_policy_with};
use pack::packed;
use serde_json::{Value, json};

/// The engine of the page, built by `cargo xtask web`.
const MODULE: &[u8] = include_bytes!("../module/dashpot.wasm");

/// A page that follows the live page in the same file.
#[derive(Debug, Clone)]
pub struct Below<'a> {
    /// Title of the whole page.
    pub title: &'a str,
    /// The page.
    pub parts: Parts,
}

/// A page and its content policy, which is also in the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    /// The page.
    pub html: String,
    /// The policy, for a server's header.
    pub policy: String,
}

/// Returns a page that simulates by itself. It begins with a choice; `tables` are the names and contents of files of
/// contact tables, without which the page computes them in a few seconds.
pub fn in_browser(
    choice: &Choice,
    tables: &[(String, Vec<u8>)],
    below: Option<Below<'_>>,
) -> String {
    let names = |shipped: &[(&str, &str)]| -> Vec<Value> {
        shipped.iter().map(|(name, _)| json!(name)).collect()
    };
    let cases = CASES.iter().map(|(name, _)| {
        let title = Choice::of(name)
            .case()
            .map_or_else(|_| (*name).to_owned(), |case| case.name);
        json!({"name": name, "title": title})
    });
    let setup = json!({
        "source": "page",
        "version": env!("CARGO_PKG_VERSION"),
        "native_digest": REFERENCE_DIGEST,
        "choice": choice,
        "cases": cases.collect::<Vec<_>>(),
        "vehicles": names(&VEHICLES),
        "tracks": names(&TRACKS),
    });
    let mut data = vec![
        data_block("application/json", "id=\"setup\"", &setup.to_string()),
        data_block("text/plain", "id=\"worker\"", files::WORKER),
        data_block("application/octet-stream", "id=\"engine\"", &packed(MODULE)),
    ];
    for (name, content) in tables {
        let name = format!("data-tables=\"{name}\"");
        data.push(data_block(
            "application/octet-stream",
            &name,
            &packed(content),
        ));
    }
    document(" 'wasm-unsafe-eval'", "; worker-src blob:", &data, below).html
}

/// Returns the page of a vehicle that runs on the machine that serves it.
pub fn of_server(vehicle: &str) -> Document {
    let setup = json!({
        "source": "server",
        "version": env!("CARGO_PKG_VERSION"),
        "native_digest": REFERENCE_DIGEST,
        "vehicle": vehicle,
        "choice": null, "cases": [], "vehicles": [], "tracks": [],
    });
    let data = [data_block(
        "application/json",
        "id=\"setup\"",
        &setup.to_string(),
    )];
    document("", "; connect-src 'self'", &data, None)
}

/// Content that the browser does not run. `<` is escaped, so that nothing in it ends the block.
fn data_block(mime: &str, name: &str, content: &str) -> String {
    let content = match mime {
        "application/json" => content.replace('<', "\\u003c"),
        _ => content.to_owned(),
    };
    format!("<script type=\"{mime}\" {name}>{content}</script>\n")
}

fn document(
    script_source: &str,
    directives: &str,
    data: &[String],
    below: Option<Below<'_>>,
) -> Document {
    let (title, parts) = match &below {
        Some(below) => (below.title, Some(&below.parts)),
        None => ("Dashpot live", None),
    };
    // The style of the live page comes last: it undoes what the other would do to it.
    let mut styles = parts.map_or_else(Vec::new, |parts| parts.styles.to_vec());
    styles.push(files::STYLE);
    let mut scripts = files::SCRIPTS.to_vec();
    scripts.extend(parts.map_or(&[][..], |parts| parts.scripts));
    let policy = content_policy_with(&scripts, &styles, script_source, directives);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n"
    );
    for style in styles {
        page += &format!("<style>{style}</style>\n");
    }
    page += "</head><body>\n";
    page += files::BODY;
    page += parts.map_or("", |parts| &parts.body);
    page.extend(data.iter().map(String::as_str));
    for script in scripts {
        page += &format!("<script>{script}</script>\n");
    }
    page += "</body></html>\n";
    Document { html: page, policy }
}
