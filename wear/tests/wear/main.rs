//! Wear laws, their accumulation and removal, and worn pairs.

#[path = "../support/sweep.rs"]
mod sweep;

mod accumulation;
mod family;
mod laws;
mod removal;
mod worn_pairs;
