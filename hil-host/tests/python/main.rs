//! The Python package `dashpot`: used as a user does, and compared with the command. And
//! programs in Python that the command works with.

#[path = "../common/mod.rs"]
mod common;
mod empty_folder;
mod installed;
mod suites;
mod xcp;
