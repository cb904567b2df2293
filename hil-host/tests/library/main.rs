//! Parts of the host used as a library.

mod calibration;
mod calibration_intervals_with_offsets;
mod case_file;
mod coupled;
mod damper_response;
mod pacing;
mod plate;
mod profile_file;
mod recording_header;
mod recording_text;
mod sheet_file;
mod swept_sine;
mod timing;
mod track_file;
mod vehicle_dampers;
mod vehicle_file;
mod vehicle_indices;
