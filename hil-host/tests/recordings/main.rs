//! Recordings in every file format, as other programs write and read them.

#[path = "../common/mod.rs"]
mod common;
mod counted_channels_began_again;
mod cut_last_lines_were_whole;
mod damaged;
mod decimals_were_whole_numbers;
mod forms;
mod found;
mod half_floats_were_zeros;
mod listed;
mod mdf4;
mod parquet_had_no_sums;
mod python;
mod refused;
mod unsorted;
mod widths;
mod written;
