//! A damper on its test bench: compares it with closed forms and other tools.

mod damper_response;
mod plate;
mod sheet_file;
mod steady;
mod swept_sine;
mod trend;
