//! The transfer system of a hybrid test, and its motion filter.

mod any;
mod explain;
mod motion;
mod settings;
mod transfer;
mod types;

pub use explain::dashpot_transfer_explain;
pub use motion::{
    dashpot_motion_filter_init, dashpot_motion_filter_push, dashpot_motion_filter_rest_at,
};
pub use settings::{dashpot_transfer_settings_init, dashpot_transfer_settings_set_delay};
pub use transfer::{
    dashpot_transfer_clear, dashpot_transfer_end, dashpot_transfer_init, dashpot_transfer_place,
    dashpot_transfer_read, dashpot_transfer_tick,
};
pub use types::*;
