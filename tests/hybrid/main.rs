//! Hybrid tests: compensators, guards, the published benchmark, the delay that a damper position bears, and dampers of
//! the locomotive on a virtual rig.

mod benchmark;
mod compensators;
mod coupled;
mod datagram;
mod delay_equation;
mod faults;
mod growth;
mod guard;
mod guard_searched;
mod locomotive;
mod network;
mod plan;
mod plan_of_vehicles;
mod sequence;

/// Page with the tables that these tests make.
const DOCUMENT: &str = "docs/hybrid.md";
