//! The server of `dashpot-device` that boards use, over a byte stream of `embedded-io` on the UART that the emulator
//! has.
#![no_std]
#![no_main]

use core::cell::RefCell;
use core::convert::Infallible;
use core::future::poll_fn;
use core::task::Poll;

use cortex_m_rt::{entry, exception};
use dashpot_core::link::{Device, Line, Outputs};
use dashpot_device::{Progress, ProgressCheck, Server, Ticks};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::outputs::SerialOutputs;
use dashpot_firmware::safe_state;
use embassy_futures::block_on;
use embassy_futures::join::join3;
use embassy_futures::yield_now;
use embedded_io_async::{ErrorType, Read, Write};
use static_cell::ConstStaticCell;

const BAUD: u32 = 1_000_000;

static TICKS: Ticks = Ticks::new();
static PROGRESS: Progress = Progress::new();
static DEVICE: ConstStaticCell<Device<DAMPERS, DAMPERS>> = ConstStaticCell::new(Device::new());

#[exception]
fn SysTick() {
    TICKS.count();
}

/// One direction of the UART. It has no interrupt, so it is asked again at once.
struct Stream(Uart);

impl ErrorType for Stream {
    type Error = Infallible;
}

impl Read for Stream {
    async fn read(&mut self, into: &mut [u8]) -> Result<usize, Infallible> {
        poll_fn(|context| {
            let received = core::iter::from_fn(|| self.0.receive());
            let slots = into.iter_mut().zip(received);
            match slots.map(|(slot, byte)| *slot = byte).count() {
                0 => {
                    context.waker().wake_by_ref();
                    Poll::Pending
                }
                count => Poll::Ready(Ok(count)),
            }
        })
        .await
    }
}

impl Write for Stream {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        loop {
            match bytes.iter().take_while(|byte| self.0.send(**byte)).count() {
                0 => yield_now().await,
                count => return Ok(count),
            }
        }
    }

    async fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// Outputs that the server sets while another future sends.
struct Shared<'a>(&'a RefCell<SerialOutputs>);

impl Outputs<DAMPERS> for Shared<'_> {
    fn drive(&mut self, forces_n: &[f32; DAMPERS]) {
        self.0.borrow_mut().drive(forces_n);
    }
}

/// Stops if a watchdog of 100 ms would not be fed.
async fn watch() {
    let mut check = ProgressCheck::default();
    loop {
        let start = board::clock_now();
        while board::clock_now().wrapping_sub(start) < CLOCK_HZ / 10 {
            yield_now().await;
        }
        if !check.both_moved(&PROGRESS) {
            safe_state::halt();
        }
    }
}

#[entry]
fn main() -> ! {
    let Some(device) = DEVICE.try_take() else {
        safe_state::halt();
    };
    if device.start(&BANK, board::start_clock()).is_err() {
        safe_state::halt();
    }
    if let Some(mut core) = cortex_m::Peripherals::take() {
        board::start_ticks(&mut core.SYST, device.step_s());
    }
    let outputs = RefCell::new(SerialOutputs::start());
    let mut reader = Stream(Uart::start(Port::Link, BAUD));
    let mut writer = Stream(Uart::start(Port::Link, BAUD));
    let mut server = Server {
        device,
        outputs: Shared(&outputs),
        ticks: &TICKS,
        progress: &PROGRESS,
    };
    let send = async {
        loop {
            outputs.borrow_mut().send_waiting();
            yield_now().await;
        }
    };
    block_on(join3(server.serve(&mut reader, &mut writer), send, watch()));
    safe_state::halt()
}
