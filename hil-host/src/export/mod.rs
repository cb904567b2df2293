//! A built damper as source text for firmware.

mod rust;

pub use rust::{Provenance, Word, rust_source};
