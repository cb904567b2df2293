//! What the developer commands and the tests of other packages share.

pub mod aarch64;
pub mod c_library;
pub mod ci;
pub mod firmware;
pub mod nightly;
pub mod processor;
pub mod python;
pub mod run;
pub mod rust_version;
pub mod search;
pub mod slurm;
pub mod target_toolchain;
pub mod test_run;
pub mod tools;
pub mod vehicle_validation;
pub mod wheel;
