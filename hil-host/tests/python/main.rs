//! The Python package `dashpot`: built as a wheel, installed, used as a user does, and compared with the command.

#[path = "../common/mod.rs"]
mod common;
mod empty_folder;
mod installed;
mod licences;
mod suites;
