//! Measures one tick of the bank over TCP: the network stack takes a step request from a frame, the server answers it,
//! and the stack writes the answer into a frame. Executor, interrupts and the DMA of a network card are not in it.
//!
//! The image prints one JSON object on the UART of the link: clock ticks at [`CLOCK_HZ`] of the target's part alone,
//! the largest number of a tick, and what the cable carried, for a host that acknowledges each answer at once and for
//! one that does so with its next request; then the numbers for frames that are not of the link. Under QEMU's
//! `-icount shift=0` a clock tick is 40 instructions.
#![no_std]
#![no_main]

use core::fmt::Write;
use core::pin::{Pin, pin};

use cortex_m_rt::entry;
use dashpot_core::link::{Clock, Device, Outputs, RESPONSE_FRAME_BYTES};
use dashpot_device::{FewFrames, Progress, Server, Ticks};
use dashpot_experiment::digest::Digest;
use dashpot_experiment::network::{
    CLOSED_PORT, Cable, Card, FOREIGN_ARP, Host, HostBuffers, PORT, TARGET, Woken, advance,
    hello_frame, run_woken, step_frame,
};
use dashpot_firmware::bank::{BANK, DAMPERS};
use dashpot_firmware::board::{self, CLOCK_HZ, Port, Uart};
use dashpot_firmware::printer::Printer;
use dashpot_firmware::safe_state;
use embassy_net::tcp::TcpSocket;
use embassy_net::{Config, Ipv4Cidr, StackResources, StaticConfigV4};
use static_cell::ConstStaticCell;

/// Steps of each client.
const REQUESTS: u32 = 1000;
/// Time between two requests (us).
const PERIOD_US: u32 = 1000;
/// Bytes of each buffer of the target's socket.
const BUFFER_BYTES: usize = 2048;

static TICKS: Ticks = Ticks::new();
static PROGRESS: Progress = Progress::new();
static DEVICE: ConstStaticCell<Device<DAMPERS>> = ConstStaticCell::new(Device::new());
static CABLE: ConstStaticCell<Cable> = ConstStaticCell::new(Cable::new());
static HOST: ConstStaticCell<HostBuffers> = ConstStaticCell::new(HostBuffers::new());
static RESOURCES: ConstStaticCell<StackResources<1>> = ConstStaticCell::new(StackResources::new());
static BUFFERS: ConstStaticCell<[[u8; BUFFER_BYTES]; 2]> =
    ConstStaticCell::new([[0; BUFFER_BYTES]; 2]);
static NETWORK: Woken = Woken::new();
static LINK: Woken = Woken::new();

/// Outputs that nobody reads: the image `link-cost` counts those of a board.
struct NoOutputs;

impl Outputs<DAMPERS> for NoOutputs {
    fn drive(&mut self, _: &[f32; DAMPERS]) {}
}

/// The target's tasks.
type Tasks<'a> = [(&'static Woken, Pin<&'a mut dyn Future<Output = ()>>); 2];

/// Runs the target until it is idle, and returns the clock ticks.
fn run_target(tasks: &mut Tasks<'_>) -> u32 {
    let start = board::clock_now();
    run_woken(tasks);
    board::clock_now().wrapping_sub(start)
}

/// Lets both ends exchange frames until none is on its way, and returns the target's clock ticks.
fn exchange(tasks: &mut Tasks<'_>, host: &mut Host<'_>) -> u32 {
    let mut ticks = 0;
    while host.poll() {
        NETWORK.wake();
        ticks += run_target(tasks);
    }
    ticks
}

/// Cost of a client's requests.
struct Cost {
    /// Clock ticks of all.
    total: u32,
    /// Clock ticks of the request that took most.
    most: u32,
    /// Answers of the expected length.
    answers: u32,
    /// Frames to the target and to the host.
    frames: [u32; 2],
    /// Bytes on the line in each direction.
    line_bytes: [u32; 2],
}

/// Connects a client and steps the bank.
fn measure(
    tasks: &mut Tasks<'_>,
    host: &mut Host<'_>,
    cable: &Cable,
    client: u16,
    digest: &mut Digest,
) -> Cost {
    let (session, client) = (client + 1, usize::from(client));
    let mut answer = [0; RESPONSE_FRAME_BYTES];
    host.connect(client);
    exchange(tasks, host);
    host.send(client, hello_frame(session).bytes());
    exchange(tasks, host);
    host.receive(client, &mut answer);
    let before = cable.counted();
    let (mut total, mut most, mut answers) = (0, 0, 0);
    for number in 1..=REQUESTS {
        // The timer's interrupt, and the tick of the host.
        TICKS.count();
        if advance(PERIOD_US) {
            LINK.wake();
            NETWORK.wake();
        }
        let mut ticks = run_target(tasks);
        let tick = u32::from(session - 1) * REQUESTS + number;
        host.send(client, step_frame(session, number, tick).bytes());
        ticks += exchange(tasks, host);
        let count = host.receive(client, &mut answer);
        let answer = answer.get(..count).unwrap_or_default();
        answers += u32::from(answer.last() == Some(&0));
        digest.add(answer.iter().copied());
        total += ticks;
        most = most.max(ticks);
    }
    let after = cable.counted();
    host.close(client);
    exchange(tasks, host);
    Cost {
        total,
        most,
        answers,
        frames: [0, 1].map(|way| after[way].frames - before[way].frames),
        line_bytes: [0, 1].map(|way| after[way].line_bytes - before[way].line_bytes),
    }
}

/// Clock ticks of a frame that is not of the link.
fn stranger(tasks: &mut Tasks<'_>, cable: &Cable, host: &mut Host<'_>, frame: &[u8]) -> u32 {
    cable.inject(frame);
    NETWORK.wake();
    let ticks = run_target(tasks);
    exchange(tasks, host);
    ticks
}

#[entry]
fn main() -> ! {
    board::start_clock();
    let device = core::hint::black_box(DEVICE.take());
    // The clock of the link stands still, so that answers are the same on every processor.
    if device.start(&BANK, Clock::new(|| 0, CLOCK_HZ)).is_err() {
        safe_state::halt();
    }
    let cable = &*CABLE.take();
    let address = Config::ipv4_static(StaticConfigV4 {
        address: Ipv4Cidr::new(TARGET, 24),
        gateway: None,
        dns_servers: Default::default(),
    });
    let card = FewFrames::new(Card(cable));
    let (stack, mut runner) = embassy_net::new(card, address, RESOURCES.take(), 1);
    let mut server = Server {
        device,
        outputs: NoOutputs,
        ticks: &TICKS,
        progress: &PROGRESS,
    };
    let [requests, answers] = BUFFERS.take();
    let mut socket = TcpSocket::new(stack, requests, answers);
    let network = pin!(async {
        runner.run().await;
    });
    let link = pin!(async {
        loop {
            server.serve_tcp(&mut socket, PORT).await;
        }
    });
    let tasks: &mut Tasks<'_> = &mut [(&NETWORK, network), (&LINK, link)];
    let host = &mut Host::new(cable, HOST.take());
    let mut digest = Digest::default();
    run_target(tasks);
    let at_once = measure(tasks, host, cable, 0, &mut digest);
    let with_request = measure(tasks, host, cable, 1, &mut digest);
    let idle = {
        TICKS.count();
        run_target(tasks)
    };
    let arp = stranger(tasks, cable, host, &FOREIGN_ARP);
    let closed = stranger(tasks, cable, host, &CLOSED_PORT);

    let mut printer = Printer(Uart::start(Port::Link, 1_000_000));
    let _ = write!(
        printer,
        "{{\"requests\": {REQUESTS}, \"clock_hz\": {CLOCK_HZ}, \"digest\": \"{:016x}\", \"idle\": {idle}, \
         \"foreign_arp\": {arp}, \"closed_port\": {closed}",
        digest.value()
    );
    for (name, cost) in [("at_once", at_once), ("with_request", with_request)] {
        let _ = write!(
            printer,
            ", \"{name}\": {{\"total\": {}, \"most\": {}, \"answers\": {}, \"frames\": {:?}, \"line_bytes\": {:?}}}",
            cost.total, cost.most, cost.answers, cost.frames, cost.line_bytes
        );
    }
    let _ = writeln!(printer, "}}");
    loop {
        cortex_m::asm::wfi();
    }
}
