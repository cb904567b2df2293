//! Recordings in every form that is read and written, as other programs write and read them.

#[path = "../common/mod.rs"]
mod common;
mod damaged;
mod forms;
mod listed;
mod python;
mod refused;
mod unsorted;
mod written;
