//! Tests of recordings: text files, intervals, ticks, and binary files.

#[cfg(feature = "parquet")]
mod columns;
mod force_history;
mod gaps;
mod header;
mod instants;
#[cfg(feature = "mdf")]
mod mdf;
mod overview;
#[cfg(feature = "parquet")]
mod parquet;
mod plain_rows;
mod position;
#[cfg(feature = "mdf")]
mod rates;
mod remedies;
mod separators;
mod text;
mod ticks;
mod titles;
#[cfg(feature = "mdf")]
mod unfinished;
mod writer;
