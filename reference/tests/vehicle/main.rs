//! Compares the reference solution of a vehicle with closed forms, balances, the reference damper and other tolerances.

mod balance;
mod closed_forms;
mod common;
#[path = "../damper/common/dampers.rs"]
#[allow(dead_code)]
mod damper_parameters;
mod dampers;
mod friction;
mod running;
mod unequal;
