//! Tests of recordings in text files.

mod header;
mod text;
