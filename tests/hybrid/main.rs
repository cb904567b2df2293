//! Hybrid tests: compensators, guards, the published benchmark, and the delay that a damper position bears.

mod benchmark;
mod compensators;
mod delay_equation;
mod guard;
mod plan;
mod plan_of_vehicles;
