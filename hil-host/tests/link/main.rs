//! Targets on the link: simulated in the test process, behind a TCP port, and in an emulator.

#[path = "../common/mod.rs"]
mod common;
mod link_command;
mod link_common;
mod link_health;
mod link_load;
mod link_samples;
mod link_states;
mod live_target;
mod missed_deadlines_exited_0;
mod pil_bank;
mod pil_by_tick;
mod pil_client;
mod pil_command;
mod pil_common;
mod pil_interruption;
mod pil_pacing;
mod pil_repeats_pile_up;
mod pil_run;
mod pil_tcp;
mod silence;
mod vehicle_outside;
