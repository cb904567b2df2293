//! The locomotive in real time against closed forms, balances, and an independent solution.

mod curving;
mod energy;
mod flange;
mod mirror;
mod rails;
mod reference;
mod rest;
mod states;
mod support;
