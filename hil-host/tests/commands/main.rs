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
mod force_limit_of_the_oil;
mod gaps;
mod interruption;
mod labview_page;
mod modes;
mod modes_coach;
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
mod verify_probed;
mod wrong_use;
