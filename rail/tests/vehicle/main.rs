//! Vehicles at standstill, at a speed and stepped in time, against closed forms and first principles.

mod between_bodies;
mod closed_forms;
mod contacts;
mod curves;
mod dipped_joint;
mod errors;
mod flange;
mod friction;
mod limits;
mod modes_turned_in_a_circle;
mod rail_support;
mod random;
mod running;
mod states;
mod support;
mod suspended;
mod track;
mod turned_line_was_not_followed;
mod wagon;
mod wheelset;
