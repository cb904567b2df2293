//! Tests of recordings: text files, intervals, ticks, and binary files.

#[cfg(feature = "parquet")]
mod columns;
mod force_history;
mod gaps;
mod header;
#[cfg(feature = "mdf")]
mod mdf;
mod overview;
#[cfg(feature = "parquet")]
mod parquet;
mod plain_rows;
mod position;
mod remedies;
mod separators;
mod text;
mod ticks;
mod writer;
