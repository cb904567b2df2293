//! Files that describe dampers, vehicles, tracks and cases.

mod case_file;
mod profile_file;
mod track_file;
mod vehicle_dampers;
mod vehicle_file;
