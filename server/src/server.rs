//! Listens for connections.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::ServerError;
use crate::access::Access;
use crate::connection::serve;
use crate::hub::Hub;
use crate::settings::Settings;
use crate::shared::Shared;
use crate::token::Token;
use crate::viewer::Handler;

/// Most connections at once.
const MAX_CONNECTIONS: usize = 100;

/// How long the end waits for viewers to take the last messages.
const END_PATIENCE: Duration = Duration::from_secs(2);

/// Stack of the thread of a connection, bytes.
const STACK: usize = 256 * 1024;

/// A server.
pub struct Server {
    hub: Hub,
    address: SocketAddr,
    token: Option<Token>,
    listening: Listening,
}

/// The thread that listens, without the type of its handler.
struct Listening {
    thread: JoinHandle<()>,
    end: Box<dyn Fn() + Send + Sync>,
    connections: Box<dyn Fn() -> usize + Send + Sync>,
}

impl Server {
    /// Listens, with the handler that `handler` makes for the hub.
    ///
    /// # Errors
    /// The address is taken or not this machine's, or the token cannot be used.
    pub fn start<H: Handler>(
        settings: Settings,
        handler: impl FnOnce(Hub) -> H,
    ) -> Result<Self, ServerError> {
        let Settings {
            listen,
            token,
            page,
        } = settings;
        let failed = |source| ServerError::Listen {
            address: listen,
            source,
        };
        let token = match token {
            Some(text) => Some(Token::new(text)?),
            None if listen.ip().is_loopback() => None,
            None => Some(Token::random()?),
        };
        let listener = TcpListener::bind(listen).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        let hub = Hub::default();
        let access = Access::new(address, token.clone());
        let shared = Shared::new(access, page, hub.clone(), handler(hub.clone()));
        let [of_thread, of_end, of_count] = [(); 3].map(|()| Arc::clone(&shared));
        let thread = std::thread::Builder::new().name("server".into());
        let thread = thread.spawn(move || listen_on(&listener, &of_thread));
        Ok(Self {
            hub,
            address,
            token,
            listening: Listening {
                thread: thread.map_err(failed)?,
                end: Box::new(move || of_end.end()),
                connections: Box::new(move || of_count.connections()),
            },
        })
    }

    /// Sends to the viewers.
    pub fn hub(&self) -> &Hub {
        &self.hub
    }

    /// Address of the page, with the token if there is one.
    pub fn url(&self) -> String {
        let token = self.token.as_ref();
        let token = token.map_or_else(String::new, |token| format!("#token={}", token.text()));
        let port = self.address.port();
        if self.address.ip().is_unspecified() {
            return format!("http://localhost:{port}/{token}");
        }
        format!("http://{}/{token}", self.address)
    }

    /// Ends all connections after their last messages.
    pub fn stop(self) {
        (self.listening.end)();
        self.hub.end();
        // The thread that listens wakes up with one more connection.
        let own = match self.address.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
            IpAddr::V6(ip) if ip.is_unspecified() => Ipv6Addr::LOCALHOST.into(),
            ip => ip,
        };
        let woken = TcpStream::connect_timeout(&(own, self.address.port()).into(), END_PATIENCE);
        if woken.is_ok() {
            let _ended = self.listening.thread.join();
        }
        let started = Instant::now();
        while (self.listening.connections)() > 0 && started.elapsed() < END_PATIENCE {
            std::thread::sleep(Duration::from_millis(2));
        }
    }
}

fn listen_on<H: Handler>(listener: &TcpListener, shared: &Arc<Shared<H>>) {
    for stream in listener.incoming() {
        if shared.is_ending() {
            return;
        }
        let Ok(stream) = stream else {
            // Too many open files: some of them close.
            std::thread::sleep(Duration::from_millis(20));
            continue;
        };
        let (counted, before) = shared.count();
        let is_full = before >= MAX_CONNECTIONS;
        let thread = std::thread::Builder::new().name("connection".into());
        // Without a thread the connection closes.
        let _spawned = thread.stack_size(STACK).spawn(move || {
            serve(stream, &counted, is_full);
        });
    }
}
