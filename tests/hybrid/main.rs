//! Hybrid tests: compensators, guards, the published benchmark, and dampers of the locomotive on a virtual rig.

mod benchmark;
mod compensators;
mod coupled;
mod faults;
mod guard;
mod locomotive;

/// Page with the tables that these tests make.
const DOCUMENT: &str = "docs/hybrid.md";
