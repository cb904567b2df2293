//! `dashpot` from outside, as its users run it.

mod bench_to_firmware;
mod budget;
mod c_library_page;
#[path = "../common/mod.rs"]
mod common;
mod contact;
mod demonstration;
mod documented;
mod export;
mod export_c;
mod export_health;
mod export_standalone;
mod firmware_bank;
mod gaps;
mod interruption;
mod labview_page;
mod lifted_wheel_without_a_word;
mod modes;
mod modes_coach;
mod overturned_called_left_the_tables;
mod replay;
mod response;
mod rig;
mod rig_report;
mod rig_sheet;
mod shims;
mod shims_plates;
mod standard_streams;
mod step_size;
mod sweep;
mod vehicle;
mod verify;
mod wheel_load_beyond_the_model;
mod wrong_use;
