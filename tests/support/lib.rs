//! Shared by tests and benches across the crates.

pub mod accuracy;
pub mod bench_test;
pub mod budget;
pub mod controller;
pub mod document;
pub mod documented_damper;
pub mod golden;
pub mod in_turn;
pub mod library;
pub mod look_up;
pub mod memory;
pub mod newton;
pub mod random_damper;
pub mod requests;
pub mod search;
pub mod searched_motion;
pub mod signed_image;
pub mod speed;
pub mod standalone;
pub mod standalone_count;
pub mod target;
pub mod tolerance;
pub mod transfer_sequence;

use dashpot_core::DamperParameters;
pub use dashpot_experiment::digest;
use dashpot_files::damper;

/// A preset of the product with overrides, which must be valid.
pub fn damper(name: &str, overrides: &[&str]) -> DamperParameters {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let checked = damper::load(name, &overrides).expect("a preset with valid overrides");
    (*checked).clone()
}
