//! Recordings as text.

mod header;
mod text;
