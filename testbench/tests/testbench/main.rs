//! A damper on its test bench, against closed forms and other tools.

mod damper_response;
mod plate;
mod sheet_file;
mod swept_sine;
