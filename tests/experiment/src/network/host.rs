//! The host: TCP clients over smoltcp.

use smoltcp::iface::{Config, Interface, SocketHandle, SocketSet, SocketStorage};
use smoltcp::phy::{Device, DeviceCapabilities, Medium, RxToken, TxToken};
use smoltcp::socket::tcp::{Socket, SocketBuffer, State};
use smoltcp::time::Instant;
use smoltcp::wire::{EthernetAddress, IpCidr};

use super::addresses::{HOST, HOST_CARD, PORT, TARGET};
use super::cable::{Cable, FRAME_BYTES};
use super::clock::now_us;

/// Bytes of each buffer of a client.
const BUFFER_BYTES: usize = 1024;

/// First local port; each connection takes the next one.
const FIRST_PORT: u16 = 50_000;

/// Memory of a host with two clients.
pub struct HostBuffers {
    sockets: [SocketStorage<'static>; 2],
    bytes: [[u8; BUFFER_BYTES]; 4],
}

impl HostBuffers {
    /// Empty.
    pub const fn new() -> Self {
        Self {
            sockets: [SocketStorage::EMPTY; 2],
            bytes: [[0; BUFFER_BYTES]; 4],
        }
    }
}

impl Default for HostBuffers {
    fn default() -> Self {
        Self::new()
    }
}

/// A host with two TCP clients. Client 0 acknowledges each segment at once, as `dashpot` on Linux does, client 1 with
/// its next request.
pub struct Host<'a> {
    end: End<'a>,
    interface: Interface,
    sockets: SocketSet<'static>,
    clients: [SocketHandle; 2],
    next_port: u16,
}

/// The host's end of the cable.
struct End<'a>(&'a Cable);

/// A frame that arrived.
struct Received<'a>(&'a Cable);

/// Room for a frame.
struct Room<'a>(&'a Cable);

impl RxToken for Received<'_> {
    fn consume<R, F: FnOnce(&[u8]) -> R>(self, read: F) -> R {
        let taken = self.0.to_host.take(|frame| read(frame));
        taken.expect("`receive` saw the frame")
    }
}

impl TxToken for Room<'_> {
    fn consume<R, F: FnOnce(&mut [u8]) -> R>(self, bytes: usize, write: F) -> R {
        self.0.send(&self.0.to_target, bytes, write)
    }
}

impl Device for End<'_> {
    type RxToken<'a>
        = Received<'a>
    where
        Self: 'a;
    type TxToken<'a>
        = Room<'a>
    where
        Self: 'a;

    fn receive(&mut self, _: Instant) -> Option<(Received<'_>, Room<'_>)> {
        (self.0.to_host.len() > 0).then_some((Received(self.0), Room(self.0)))
    }

    fn transmit(&mut self, _: Instant) -> Option<Room<'_>> {
        Some(Room(self.0))
    }

    fn capabilities(&self) -> DeviceCapabilities {
        let mut capabilities = DeviceCapabilities::default();
        capabilities.medium = Medium::Ethernet;
        capabilities.max_transmission_unit = FRAME_BYTES;
        capabilities
    }
}

fn now() -> Instant {
    Instant::from_micros(i64::from(now_us()))
}

impl<'a> Host<'a> {
    /// A host at a cable.
    pub fn new(cable: &'a Cable, buffers: &'static mut HostBuffers) -> Self {
        let mut end = End(cable);
        let mut interface = Interface::new(
            Config::new(EthernetAddress(HOST_CARD).into()),
            &mut end,
            now(),
        );
        interface.update_ip_addrs(|addresses| {
            // The list is empty.
            let _ = addresses.push(IpCidr::new(HOST.into(), 24));
        });
        let mut sockets = SocketSet::new(&mut buffers.sockets[..]);
        let [a, b, c, d] = &mut buffers.bytes;
        let clients = [(a, b, true), (c, d, false)].map(|(received, sent, at_once)| {
            let mut socket = Socket::new(
                SocketBuffer::new(&mut received[..]),
                SocketBuffer::new(&mut sent[..]),
            );
            socket.set_nagle_enabled(false);
            if at_once {
                socket.set_ack_delay(None);
            }
            sockets.add(socket)
        });
        Self {
            end,
            interface,
            sockets,
            clients,
            next_port: FIRST_PORT,
        }
    }

    fn client(&mut self, client: usize) -> &mut Socket<'static> {
        self.sockets.get_mut(self.clients[client])
    }

    /// Forgets a client's connection. The target gets a reset, if the cable is not pulled.
    pub fn forget(&mut self, client: usize) {
        self.client(client).abort();
        self.poll();
    }

    /// Starts to connect a client, whose old connection it forgets.
    ///
    /// # Panics
    /// The client is 2 or more.
    pub fn connect(&mut self, client: usize) {
        self.next_port += 1;
        let local = self.next_port;
        let socket = self.sockets.get_mut::<Socket>(self.clients[client]);
        socket.abort();
        let target = (TARGET, PORT);
        let started = socket.connect(self.interface.context(), target, local);
        started.expect("the addresses are valid");
    }

    /// State of a client's connection.
    pub fn state(&mut self, client: usize) -> State {
        self.client(client).state()
    }

    /// Ends a client's connection in order.
    pub fn close(&mut self, client: usize) {
        self.client(client).close();
    }

    /// Sends bytes, and returns how many there was room for.
    pub fn send(&mut self, client: usize, bytes: &[u8]) -> usize {
        self.client(client).send_slice(bytes).unwrap_or(0)
    }

    /// Takes bytes that a client received, and returns how many.
    pub fn receive(&mut self, client: usize, into: &mut [u8]) -> usize {
        self.client(client).recv_slice(into).unwrap_or(0)
    }

    /// Handles frames and timers. Returns true if frames are on their way to the target.
    pub fn poll(&mut self) -> bool {
        self.interface.poll(now(), &mut self.end, &mut self.sockets);
        self.end.0.to_target.len() > 0
    }
}
