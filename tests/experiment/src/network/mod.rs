//! Two network stacks that a cable joins, in time that only the test advances: embassy-net at the target, as on boards,
//! and a host's TCP client. The same on every processor.

mod addresses;
mod cable;
mod card;
mod clock;
mod host;
mod requests;
mod strangers;
mod tasks;

pub use addresses::{HOST, HOST_CARD, PORT, TARGET, TARGET_CARD};
pub use cable::{Cable, Counted, Faults};
pub use card::Card;
pub use clock::{advance, now_us};
pub use host::{Host, HostBuffers};
pub use requests::{displacements_m, hello_frame, step_frame};
pub use strangers::{CLOSED_PORT, FOREIGN_ARP};
pub use tasks::{Woken, run_woken};
