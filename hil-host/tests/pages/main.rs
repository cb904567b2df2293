//! Pages in a browser: what they look like on a desk and on a phone, what they do under the mouse, and what they may load.

mod browser;
#[path = "../common/mod.rs"]
mod common;
mod curves;
mod layout;
mod loops;
#[path = "../link/pil_common/mod.rs"]
mod pil_common;
mod policy;
mod printed;
mod schemes;
mod shared_cursor;
mod shown;
mod vendored;
mod zoom;
