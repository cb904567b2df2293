//! What the developer commands and the tests of other packages share.

pub mod c_library;
pub mod firmware;
pub mod run;
pub mod target_toolchain;
pub mod tools;
