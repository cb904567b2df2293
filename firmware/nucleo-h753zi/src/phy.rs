//! The chip at the Ethernet connector (LAN8742A, or any other with the standard's registers).

use core::task::Context;

use embassy_stm32::eth::{GenericPhy, Phy, StationManagement};
use embassy_time::{Duration, Instant};

/// Time between two looks whether there is a cable.
const LOOK: Duration = Duration::from_millis(500);

/// A chip that is asked for the state of its cable twice in a second. The network stack wants the state whenever it
/// runs, several times in a tick, and each look at the chip stops the processor for 33 us.
pub struct RarePhy<M: StationManagement> {
    phy: GenericPhy<M>,
    next_look: Instant,
    is_up: bool,
}

impl<M: StationManagement> RarePhy<M> {
    /// The chip behind a management interface, whatever its address.
    pub fn new(management: M) -> Self {
        Self {
            phy: GenericPhy::new_auto(management),
            next_look: Instant::MIN,
            is_up: false,
        }
    }
}

impl<M: StationManagement> Phy for RarePhy<M> {
    fn phy_reset(&mut self) {
        self.phy.phy_reset();
    }

    fn phy_init(&mut self) {
        self.phy.phy_init();
    }

    fn poll_link(&mut self, context: &mut Context<'_>) -> bool {
        let now = Instant::now();
        if now >= self.next_look {
            self.next_look = now + LOOK;
            // This also wakes the stack for the next look.
            self.is_up = self.phy.poll_link(context);
        }
        self.is_up
    }
}
