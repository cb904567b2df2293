//! Reads the modules of a crate and the imports between them from its source text.

mod circles;
mod imports;
mod modules;
mod tokens;

pub use circles::{Graph, circles};
pub use modules::{Crate, Import, Module};
pub use tokens::{Token, tokens};
