//! Hybrid tests: compensators, guards and the published benchmark.

mod benchmark;
mod compensators;
mod guard;
mod sequence;
