//! The server of `dashpot-device` that boards use, over a byte stream of `embedded-io` on the UART that the emulator
//! has.
#![no_std]
#![no_main]

use core::cell::RefCell;
use core::convert::Infallible;
use core::future::poll_fn;
use core::task::Poll;

use cortex_m_rt::{entry, exception};
use dashpot_core::link::{Device, Line};
use dashpot_device::{Progress, Server, Ticks};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, Port, Uart};
use dashpot_firmware::outputs::SerialOutputs;
use dashpot_firmware::safe_state;
use dashpot_firmware::serving::{SharedOutputs, send, watch};
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
        outputs: SharedOutputs(&outputs),
        ticks: &TICKS,
        progress: &PROGRESS,
    };
    block_on(join3(
        server.serve(&mut reader, &mut writer),
        send(&outputs),
        watch(&PROGRESS),
    ));
    safe_state::halt()
}
