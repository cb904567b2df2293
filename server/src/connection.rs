//! One connection: the page, or a viewer with a thread that reads and one that writes.

use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::time::{Duration, Instant};

use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Message, WebSocket};

use crate::outbox::{Next, Outbox};
use crate::request::Request;
use crate::response::{self, Refusal};
use crate::shared::Shared;
use crate::viewer::{Handler, WantedRole};
use crate::wire;

/// How long a viewer may take none of the bytes that are sent to it.
const WRITE_PATIENCE: Duration = Duration::from_secs(10);

/// How often a viewer is asked whether it is still there.
const PING_INTERVAL: Duration = Duration::from_secs(5);

/// How long nothing may come from a viewer, which answers each ping.
const READ_PATIENCE: Duration = Duration::from_secs(15);

/// Largest message of a viewer, bytes.
const MAX_MESSAGE: usize = 1 << 20;

/// Bytes that the system buffers for a viewer: more would show a slow one a past that grows older and older.
#[cfg(unix)]
const SEND_BUFFER: usize = 128 * 1024;

/// Stack of the thread that writes, bytes.
const STACK: usize = 128 * 1024;

/// Answers a client until it leaves.
pub(crate) fn serve<H: Handler>(mut stream: TcpStream, shared: &Shared<H>, is_full: bool) {
    let prepared = stream
        .set_nodelay(true)
        .and_then(|()| stream.set_write_timeout(Some(WRITE_PATIENCE)));
    if prepared.is_err() {
        return;
    }
    let answered = Request::read(&mut stream).and_then(|request| {
        if is_full {
            return Err(Refusal::FULL);
        }
        answer(&mut stream, request, shared)
    });
    if let Err(refusal) = answered {
        end(&mut stream, &refusal.answer());
    }
}

/// Sends the last bytes, and waits shortly for the client to take them.
fn end(stream: &mut TcpStream, bytes: &[u8]) {
    // Whoever has left needs no answer.
    let _sent = stream
        .write_all(bytes)
        .and_then(|()| stream.shutdown(Shutdown::Write));
}

fn answer<H: Handler>(
    stream: &mut TcpStream,
    request: Request,
    shared: &Shared<H>,
) -> Result<(), Refusal> {
    shared.access.check_host(&request)?;
    let is_head = request.method == "HEAD";
    if !is_head && request.method != "GET" {
        return Err(Refusal::METHOD);
    }
    match &*request.path {
        "/" => end(stream, &response::page(&shared.page, is_head)),
        "/live" => {
            let key = request.socket_key.as_deref().ok_or(Refusal::UPGRADE)?;
            shared.access.check_socket(&request)?;
            let accepted = stream.write_all(&response::accept(key));
            if accepted.is_ok() {
                let role = WantedRole::of(request.query("role"));
                // A viewer that cannot be served any more has left.
                let _left = view(stream, request.rest, role, shared);
            }
        }
        _ => return Err(Refusal::PATH),
    }
    Ok(())
}

/// The reading end. What the protocol itself answers, such as pongs, goes through the thread that writes.
struct Inbound {
    stream: TcpStream,
    outbox: Arc<Outbox>,
}

impl Read for Inbound {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.stream.read(buffer)
    }
}

impl Write for Inbound {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.outbox.reply(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Serves a viewer until it leaves.
fn view<H: Handler>(
    stream: &TcpStream,
    rest: Vec<u8>,
    role: WantedRole,
    shared: &Shared<H>,
) -> io::Result<()> {
    #[cfg(unix)]
    rustix::net::sockopt::set_socket_send_buffer_size(stream, SEND_BUFFER)?;
    stream.set_read_timeout(Some(READ_PATIENCE))?;
    let outgoing = stream.try_clone()?;
    let (viewer, outbox) = shared.hub.join();
    let inbound = Inbound {
        stream: stream.try_clone()?,
        outbox: Arc::clone(&outbox),
    };
    let writing = {
        let outbox = Arc::clone(&outbox);
        let writer = std::thread::Builder::new();
        let writer = writer.name("viewer".into()).stack_size(STACK);
        writer.spawn(move || write(outgoing, &outbox))
    };
    if writing.is_ok() {
        shared.handler.joined(viewer, role);
        read(inbound, rest, |text| shared.handler.message(viewer, text));
        shared.handler.left(viewer);
    }
    outbox.give_up();
    shared.hub.leave(viewer);
    // Wakes the thread that writes, should the viewer read nothing.
    let _closed = stream.shutdown(Shutdown::Both);
    if let Ok(writing) = writing {
        let _ended = writing.join();
    }
    Ok(())
}

/// Passes texts on until the viewer leaves.
fn read(inbound: Inbound, rest: Vec<u8>, text: impl Fn(&str)) {
    let settings = WebSocketConfig::default()
        .read_buffer_size(4096)
        .write_buffer_size(0)
        .max_message_size(Some(MAX_MESSAGE))
        .max_frame_size(Some(MAX_MESSAGE));
    let mut socket = WebSocket::from_partially_read(inbound, rest, Role::Server, Some(settings));
    while let Ok(message) = socket.read() {
        if let Message::Text(message) = message {
            text(message.as_str());
        }
    }
}

/// Sends what is in the outbox until the connection ends.
fn write(mut stream: TcpStream, outbox: &Outbox) {
    let mut pinged = Instant::now();
    loop {
        let sent = match outbox.next(PING_INTERVAL) {
            Next::Send(parts) => parts.iter().try_for_each(|part| stream.write_all(part)),
            Next::Nothing => Ok(()),
            Next::End => break,
        };
        let sent = sent.and_then(|()| {
            if pinged.elapsed() < PING_INTERVAL {
                return Ok(());
            }
            pinged = Instant::now();
            stream.write_all(&wire::ping())
        });
        if sent.is_err() {
            break;
        }
    }
    end(&mut stream, &wire::close());
    // Ends the thread that reads, should the viewer send nothing.
    let _closed = stream.shutdown(Shutdown::Read);
}
