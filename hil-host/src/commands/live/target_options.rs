//! Options for a target.

use dashpot_host_link::LinkChoice;

use crate::commands::arguments::damper_help;

/// The target, and the dampers that it runs.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct TargetArguments {
    /// Show a target in place of a vehicle: tcp:HOST:PORT, serial:DEVICE, qemu (a new emulator) or qemu:IMAGE.
    #[arg(
        long,
        value_name = "LINK",
        conflicts_with_all = [
            "case", "vehicle", "track", "speed_km_h", "duration_s", "start_m", "friction", "normal_damping_s_per_m",
            "step_us", "push_m", "dampers", "overrides", "choices",
        ]
    )]
    pub link: Option<LinkChoice>,
    /// Dampers of the target.
    #[arg(
        help = damper_help(" of the target; once for all slots, or once per slot [default: paper]. A target that runs \
            free keeps its own dampers: then without a model beside it, unless this says what they are"),
        long = "slot-damper",
        value_name = "NAME|FILE"
    )]
    pub slot_dampers: Vec<String>,
}
