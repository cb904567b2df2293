//! Developer commands, and code that they share with the tests of other packages.

pub mod aarch64;
pub mod bench;
pub mod book;
pub mod c_library;
pub mod ci;
pub mod firmware;
pub mod mutants;
pub mod nightly;
pub mod packages;
pub mod processor;
pub mod python;
pub mod run;
pub mod rust_version;
pub mod search;
pub mod setup;
pub mod slurm;
pub mod tags;
pub mod target_toolchain;
pub mod test_run;
pub mod timings;
pub mod tools;
pub mod vehicle_validation;
pub mod web;
pub mod wheel;
