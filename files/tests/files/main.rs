//! Files that describe dampers, vehicles, tracks and cases.

mod case_file;
mod contact_tables;
mod documented_keys;
mod profile_file;
mod rail_tilt;
mod track_file;
mod vehicle_dampers;
mod vehicle_file;
