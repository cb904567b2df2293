//! Pages in a browser: layout on a desktop and a phone, mouse interaction, and what they may load.

mod browser;
#[path = "../common/mod.rs"]
mod common;
mod contents;
mod curves;
mod data;
mod in_browser;
mod keys;
mod layout;
mod legend;
mod live;
mod live_served;
mod loops;
mod panels;
#[path = "../link/pil_common/mod.rs"]
mod pil_common;
mod policy;
mod printed;
mod schemes;
mod shared_cursor;
mod shown;
mod vendored;
mod zoom;
