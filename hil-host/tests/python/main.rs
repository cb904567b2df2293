//! The Python package `dashpot`: built as a wheel, installed, used as a user does, and compared with the command. And
//! programs in Python that the command works with.

#[path = "../common/mod.rs"]
mod common;
mod empty_folder;
mod installed;
mod licences;
mod suites;
mod xcp;
