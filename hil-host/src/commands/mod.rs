//! The commands of `dashpot`, one a file.

pub mod contact;

/// How a command prints its results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Format {
    /// Lines and tables for people.
    #[default]
    Text,
    /// One JSON object with SI names for programs.
    Json,
}
