//! The server: binds its sockets, then serves one master at a time on a thread of its own.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64};
use std::sync::mpsc::sync_channel;
use std::thread::{self, JoinHandle};

use super::serving::{Run, Serving};
use super::sockets::Sockets;
use super::{Feed, Image, Pacing, Parameters, Summary};

/// Ticks and packets that may wait for a server in real time: 8 s of ticks of 1 ms.
const REALTIME_INPUTS: usize = 8192;
/// The same in virtual time, where the model waits for the server.
const VIRTUAL_INPUTS: usize = 64;

/// Bound sockets.
pub struct Server {
    sockets: Sockets,
}

/// A server that runs.
pub struct Running {
    thread: JoinHandle<Summary>,
    sockets: [JoinHandle<()>; 2],
}

/// A thread of the server has failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a thread of the XCP server failed")]
pub struct ServerFailed;

impl Server {
    /// Binds UDP and TCP to an address. Port 0 is a free port.
    ///
    /// # Errors
    /// The system refuses the address.
    pub fn bind(address: SocketAddr) -> io::Result<Self> {
        let sockets = Sockets::bind(address)?;
        Ok(Self { sockets })
    }

    /// Address of both sockets.
    pub fn address(&self) -> SocketAddr {
        self.sockets.address
    }

    /// Starts to serve a model with ticks of `step_s` (s). The server ends when the [`Feed`] is dropped and the master
    /// has disconnected or sent nothing for 10 s, or at once if `is_unwanted` returns true.
    ///
    /// # Errors
    /// The system starts no thread.
    pub fn start<P: Parameters + 'static>(
        self,
        image: Image<P>,
        pacing: Pacing,
        step_s: f64,
        is_unwanted: fn() -> bool,
    ) -> io::Result<(Feed, Running)> {
        let is_realtime = matches!(pacing, Pacing::Realtime);
        let (sender, inputs) = sync_channel(match is_realtime {
            true => REALTIME_INPUTS,
            false => VIRTUAL_INPUTS,
        });
        let lost = Arc::new(AtomicU64::new(0));
        let run = Run {
            is_over: Arc::new(AtomicBool::new(false)),
            is_unwanted,
            step_s,
        };
        let feed = Feed::new(sender.clone(), Arc::clone(&lost), is_realtime);
        let (udp, sockets) = self.sockets.listen(sender, Arc::clone(&run.is_over))?;
        let serving = Serving::new(image, pacing, (inputs, lost), udp, run);
        let thread = thread::Builder::new()
            .name("xcp".into())
            .spawn(move || serving.run())?;
        Ok((feed, Running { thread, sockets }))
    }
}

impl Running {
    /// Waits until the server has ended. Drop the [`Feed`] before.
    ///
    /// # Errors
    /// One of its threads has failed.
    pub fn finish(self) -> Result<Summary, ServerFailed> {
        let summary = self.thread.join();
        for thread in self.sockets {
            thread.join().map_err(|_| ServerFailed)?;
        }
        summary.map_err(|_| ServerFailed)
    }
}
