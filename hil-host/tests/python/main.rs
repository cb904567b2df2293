//! The package `dashpot` of Python: built as a wheel, installed, and used as its users do, beside the command.

#[path = "../common/mod.rs"]
mod common;
mod empty_folder;
mod installed;
mod licences;
mod suites;
