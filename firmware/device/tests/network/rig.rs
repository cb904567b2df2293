//! A target with a server on a TCP port, and a host, in virtual time.

use std::cell::{RefCell, RefMut};
use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::sync::{Mutex, MutexGuard, PoisonError};

use dashpot_core::Damper;
use dashpot_core::link::{
    Clock, Device, FrameReader, Header, Outputs, PROTOCOL, RESPONSE_BYTES, Request, Response,
    request_frame,
};
use dashpot_core::parameters::{DamperParameters, Mount};
use dashpot_device::{FewFrames, Progress, ProgressCheck, Server, Ticks};
use dashpot_experiment::network::{
    Cable, Card, Host, HostBuffers, PORT, TARGET, Woken, advance, now_us,
};
use embassy_net::tcp::{State, TcpSocket};
use embassy_net::{Config, Ipv4Cidr, StackResources, StaticConfigV4};

/// Time that passes at once (us).
const PART_US: u32 = 100;
/// Period of the tick (us).
const TICK_US: u32 = 1000;
/// Time between two looks at the progress (us).
const LOOK_US: u32 = 20_000;

/// Both stacks have the same time, which only one test at a time may advance.
static TIME: Mutex<()> = Mutex::new(());

/// Forces of the outputs (N).
type Forces = Rc<RefCell<[f32; 12]>>;

/// Keeps the last forces.
struct LastForces(Forces);

impl Outputs<12> for LastForces {
    fn drive(&mut self, forces_n: &[f32; 12]) {
        *self.0.borrow_mut() = *forces_n;
    }
}

type Task = (&'static Woken, Pin<Box<dyn Future<Output = ()>>>);

/// Target and host.
pub struct World {
    tasks: [Task; 2],
    pub host: Host<'static>,
    ticks: &'static Ticks,
    progress: &'static Progress,
    check: ProgressCheck,
    fed_us: u32,
    longest_us: u32,
}

/// A target and a host at a cable. Each test has its own, and leaks it.
pub struct Rig {
    world: RefCell<World>,
    pub cable: &'static Cable,
    forces_n: Forces,
    _time: MutexGuard<'static, ()>,
}

/// The damper of all places.
pub fn damper() -> Damper<f32> {
    let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
    parameters.build(1e-3).unwrap()
}

fn leaked<T>(value: T) -> &'static mut T {
    Box::leak(Box::new(value))
}

impl Rig {
    /// A target of twelve dampers.
    pub fn start() -> Self {
        let time = TIME.lock().unwrap_or_else(PoisonError::into_inner);
        let cable: &'static Cable = leaked(Cable::new());
        let device = leaked(Device::<12>::new());
        device.start(&[&damper(); 12], Clock::new(|| 0, 1)).unwrap();
        let (ticks, progress) = (&*leaked(Ticks::new()), &*leaked(Progress::new()));
        let forces_n = Forces::default();
        let mut server = Server {
            device,
            outputs: LastForces(forces_n.clone()),
            ticks,
            progress,
        };
        let address = Config::ipv4_static(StaticConfigV4 {
            address: Ipv4Cidr::new(TARGET, 24),
            gateway: None,
            dns_servers: Default::default(),
        });
        let resources = leaked(StackResources::<1>::new());
        let (stack, runner) = embassy_net::new(FewFrames::new(Card(cable)), address, resources, 1);
        let runner = leaked(runner);
        let network: Task = (
            leaked(Woken::new()),
            Box::pin(async {
                runner.run().await;
            }),
        );
        let [requests, answers] = leaked([[0; 2048]; 2]);
        let mut socket = TcpSocket::new(stack, requests, answers);
        let link: Task = (
            leaked(Woken::new()),
            Box::pin(async move {
                loop {
                    server.serve_tcp(&mut socket, PORT).await;
                }
            }),
        );
        let world = World {
            tasks: [network, link],
            host: Host::new(cable, leaked(HostBuffers::new())),
            ticks,
            progress,
            check: ProgressCheck::default(),
            fed_us: now_us(),
            longest_us: 0,
        };
        let rig = Self {
            world: RefCell::new(world),
            cable,
            forces_n,
            _time: time,
        };
        // The server listens before a host connects.
        rig.borrow().settle();
        rig
    }

    /// The target and the host.
    pub fn borrow(&self) -> RefMut<'_, World> {
        self.world.borrow_mut()
    }

    /// Lets time pass (us).
    pub fn pass(&self, us: u32) {
        let mut world = self.borrow();
        for _ in 0..us / PART_US {
            world.pass_part();
        }
    }

    /// Current time (us).
    pub fn now_us(&self) -> u32 {
        now_us()
    }

    /// Tries to connect a client for 10 s.
    pub fn connects(&self, client: usize) -> bool {
        self.borrow().host.connect(client);
        for _ in 0..100 {
            self.pass(100_000);
            match self.borrow().host.state(client) {
                State::Established => return true,
                State::Closed => return false,
                _ => (),
            }
        }
        false
    }

    /// Connects a client and says hello.
    pub fn greet(&self, client: usize, session: u16) -> Client<'_> {
        assert!(self.connects(client));
        let mut greeting = Client {
            rig: self,
            client,
            header: Header {
                session,
                sequence: 0,
            },
            reader: FrameReader::new(),
        };
        let hello = Request::Hello { protocol: PROTOCOL };
        let welcome = |response: Response<'_>| matches!(response, Response::Welcome(_));
        assert_eq!(greeting.request(&hello, welcome), Some(true));
        greeting
    }

    /// Forces of the outputs (N).
    pub fn outputs_n(&self) -> [f32; 12] {
        *self.forces_n.borrow()
    }

    /// Longest time that a watchdog was not fed (us).
    pub fn longest_without_food_us(&self) -> u32 {
        self.borrow().longest_us
    }
}

impl World {
    /// Lets both ends exchange frames until none is on its way.
    pub fn settle(&mut self) {
        loop {
            if self.host.poll() {
                self.tasks[0].0.wake();
            }
            let mut ran = false;
            for (woken, task) in &mut self.tasks {
                ran |= woken.run(task.as_mut());
            }
            if !ran {
                return;
            }
        }
    }

    /// Runs the network stack once.
    pub fn run_network_once(&mut self) {
        let (woken, task) = &mut self.tasks[0];
        woken.wake();
        woken.run(task.as_mut());
    }

    fn pass_part(&mut self) {
        if advance(PART_US) {
            self.tasks.iter().for_each(|(woken, _)| woken.wake());
        }
        if now_us().is_multiple_of(TICK_US) {
            self.ticks.count();
        }
        self.settle();
        if now_us().is_multiple_of(LOOK_US) && self.check.both_moved(self.progress) {
            self.longest_us = self.longest_us.max(now_us() - self.fed_us);
            self.fed_us = now_us();
        }
    }
}

/// A client that is connected.
pub struct Client<'a> {
    rig: &'a Rig,
    client: usize,
    pub header: Header,
    reader: FrameReader<RESPONSE_BYTES>,
}

impl Client<'_> {
    /// Sends a request and waits at most 20 s for its answer; `None` if there was none.
    pub fn request<R>(
        &mut self,
        request: &Request<'_>,
        read: impl FnOnce(Response<'_>) -> R,
    ) -> Option<R> {
        self.header.sequence += 1;
        let frame = request_frame(self.header, request);
        let mut rest = frame.bytes();
        for _ in 0..20_000_000 / PART_US {
            let mut world = self.rig.borrow();
            let sent = world.host.send(self.client, rest);
            rest = &rest[sent..];
            world.settle();
            let mut buffer = [0; RESPONSE_BYTES];
            let count = world.host.receive(self.client, &mut buffer);
            for byte in &buffer[..count] {
                if let Some(message) = self.reader.push(*byte) {
                    let answer: (Header, Response<'_>) =
                        postcard::from_bytes(message.unwrap().bytes).unwrap();
                    assert_eq!(answer.0, self.header);
                    return Some(read(answer.1));
                }
            }
            world.pass_part();
        }
        None
    }
}
