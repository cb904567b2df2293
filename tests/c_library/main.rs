//! Tests of the C library (its header, and the example on the host and on targets) and of C without a library.

mod clang_reorders_forces;
mod header;
mod host;
mod misra;
mod standalone;
mod targets;
mod transfer;
