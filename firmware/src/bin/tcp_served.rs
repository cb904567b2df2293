//! The server of `dashpot-device` on a TCP port, behind the Ethernet controller that the emulator has. The address is
//! that which QEMU's own network gives a guest. The image prints a line on the UART of the link when it listens.
#![no_std]
#![no_main]

use core::cell::RefCell;
use core::fmt::Write;
use core::sync::atomic::{AtomicU32, Ordering};
use core::task::Waker;

use cortex_m_rt::{entry, exception};
use dashpot_core::link::Device;
use dashpot_device::{Progress, Server, Ticks};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::lan9118::Lan9118;
use dashpot_firmware::outputs::SerialOutputs;
use dashpot_firmware::printer::Printer;
use dashpot_firmware::safe_state;
use dashpot_firmware::serving::{SharedOutputs, send, watch};
use embassy_futures::block_on;
use embassy_futures::join::join4;
use embassy_net::tcp::TcpSocket;
use embassy_net::{Config, Ipv4Address, Ipv4Cidr, StackResources, StaticConfigV4};
use embassy_time_driver::{Driver, TICK_HZ};
use static_cell::ConstStaticCell;

/// TCP port of the link.
const PORT: u16 = 5555;
/// Address of a guest in QEMU's network.
const ADDRESS: Ipv4Cidr = Ipv4Cidr::new(Ipv4Address::new(10, 0, 2, 15), 24);

static TICKS: Ticks = Ticks::new();
static PROGRESS: Progress = Progress::new();
static DEVICE: ConstStaticCell<Device<DAMPERS>> = ConstStaticCell::new(Device::new());
static CARD: ConstStaticCell<Lan9118> = ConstStaticCell::new(Lan9118::new());
static RESOURCES: ConstStaticCell<StackResources<1>> = ConstStaticCell::new(StackResources::new());
static BUFFERS: ConstStaticCell<[[u8; 4096]; 2]> = ConstStaticCell::new([[0; 4096]; 2]);

/// The time of embassy: the board's timer, which wraps, and the number of times that it did. All tasks are polled again
/// and again, so timers wake nobody. Only `main` asks for the time.
struct Time {
    last: AtomicU32,
    wraps: AtomicU32,
}

embassy_time_driver::time_driver_impl!(static TIME: Time = Time {
    last: AtomicU32::new(0),
    wraps: AtomicU32::new(0),
});

impl Driver for Time {
    fn now(&self) -> u64 {
        let now = board::clock_now();
        if now < self.last.swap(now, Ordering::Relaxed) {
            self.wraps.fetch_add(1, Ordering::Relaxed);
        }
        let wraps = u64::from(self.wraps.load(Ordering::Relaxed));
        let clocks = wraps << 32 | u64::from(now);
        let (seconds, rest) = (clocks / u64::from(CLOCK_HZ), clocks % u64::from(CLOCK_HZ));
        seconds * TICK_HZ + rest * TICK_HZ / u64::from(CLOCK_HZ)
    }

    fn schedule_wake(&self, _: u64, _: &Waker) {}
}

#[exception]
fn SysTick() {
    TICKS.count();
}

#[entry]
fn main() -> ! {
    let device = DEVICE.take();
    if device.start(&BANK, board::start_clock()).is_err() {
        safe_state::halt();
    }
    let card = CARD.take();
    card.start();
    let address = Config::ipv4_static(StaticConfigV4 {
        address: ADDRESS,
        gateway: None,
        dns_servers: Default::default(),
    });
    let (stack, mut runner) = embassy_net::new(card, address, RESOURCES.take(), 1);
    let [requests, answers] = BUFFERS.take();
    let mut socket = TcpSocket::new(stack, requests, answers);
    if let Some(mut core) = cortex_m::Peripherals::take() {
        board::start_ticks(&mut core.SYST, device.step_s());
    }
    let outputs = RefCell::new(SerialOutputs::start());
    let mut server = Server {
        device,
        outputs: SharedOutputs(&outputs),
        ticks: &TICKS,
        progress: &PROGRESS,
    };
    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    let serve = async {
        let _ = writeln!(printer, "listens");
        loop {
            let end = server.serve_tcp(&mut socket, PORT).await;
            let _ = writeln!(printer, "{end:?}");
        }
    };
    block_on(join4(runner.run(), serve, send(&outputs), watch(&PROGRESS)));
    safe_state::halt()
}
