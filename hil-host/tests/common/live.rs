//! Runs `dashpot live`, and watches it as a browser does.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, ExitStatus, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

use super::command;

/// How long a message may take on the slowest machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// A running `dashpot live`; killed when dropped.
pub struct Live {
    child: Child,
    /// HOST:PORT.
    pub address: String,
    /// Token of the address, or empty.
    pub token: String,
}

/// What came from the command at its end.
pub struct Ended {
    pub status: ExitStatus,
    pub report: Value,
}

impl Live {
    /// Starts the command with `options` in `folder`, on a free port of this machine.
    pub fn start(options: &[&str], folder: &Path) -> Self {
        let listen = ["live", "--listen", "127.0.0.1:0", "--format", "json"];
        Self::of(&[&listen, options].concat(), folder)
    }

    /// Starts the command with these arguments.
    pub fn of(arguments: &[&str], folder: &Path) -> Self {
        let mut child = command(arguments, folder)
            .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut errors = BufReader::new(child.stderr.take().unwrap()).lines();
        let mut told = String::new();
        while !told.contains("http://") {
            told = errors.next().expect("the address of the page").unwrap();
        }
        // Nobody reads what follows, but the pipe must not fill.
        std::thread::spawn(move || errors.for_each(drop));
        let url = told.split("http://").nth(1).unwrap();
        let (address, token) = url.split_once('/').unwrap();
        let token = token.strip_prefix("#token=").unwrap_or_default();
        Self {
            child,
            address: address.to_owned(),
            token: token.to_owned(),
        }
    }

    /// Sends the head of a request (without the blank line) and returns the whole answer.
    pub fn request(&self, head: &str) -> String {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream
            .write_all(format!("{head}\r\n\r\n").as_bytes())
            .unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        answer
    }

    /// Head of a request for the WebSocket, as the page of `origin` sends it to `host`.
    pub fn socket_head(host: &str, origin: &str, query: &str) -> String {
        format!(
            "GET /live{query} HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nConnection: Upgrade\r\n\
             Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ=="
        )
    }

    /// Connects as the page does, with what follows `/live` in the address.
    pub fn connect(&self, query: &str) -> Viewer {
        let stream = TcpStream::connect(&self.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let address = format!("ws://{}/live{query}", self.address);
        let mut request = address.into_client_request().unwrap();
        let origin = format!("http://{}", self.address).parse().unwrap();
        request.headers_mut().insert("Origin", origin);
        let (socket, _) = tungstenite::client(request, stream).unwrap();
        Viewer { socket, asked: 0 }
    }

    /// Sends a signal, such as `-TERM`.
    pub fn signal(&self, signal: &str) {
        let mut kill = std::process::Command::new("kill");
        let status = kill.args([signal, &self.child.id().to_string()]).status();
        assert!(status.unwrap().success());
    }

    /// Waits for the end; the report is null if the command printed none.
    pub fn end(mut self) -> Ended {
        let mut text = String::new();
        let mut out = self.child.stdout.take().unwrap();
        out.read_to_string(&mut text).unwrap();
        Ended {
            status: self.child.wait().unwrap(),
            report: serde_json::from_str(&text).unwrap_or_default(),
        }
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A page.
pub struct Viewer {
    socket: WebSocket<TcpStream>,
    asked: u64,
}

/// Numbers of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// 0, or 1 for the vehicle as new.
    pub run: u32,
    pub signals: usize,
    pub time_s: f64,
    pub distance_m: f64,
    pub ticks: f64,
    pub ticks_in_frame: u32,
    pub flags: u32,
    pub last: Vec<f32>,
    pub least: Vec<f32>,
    pub greatest: Vec<f32>,
}

impl Frame {
    fn of(bytes: &[u8]) -> Self {
        let u32_at = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let f64_at = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
        let signals = u32_at(4) as usize;
        assert_eq!(bytes.len(), 48 + 12 * signals);
        let values = |part: usize| {
            let numbers = (0..signals).map(|n| 48 + 4 * (part * signals + n));
            numbers.map(|at| f32::from_bits(u32_at(at))).collect()
        };
        Self {
            run: u32_at(0),
            signals,
            time_s: f64_at(8),
            distance_m: f64_at(16),
            ticks: f64_at(24),
            ticks_in_frame: u32_at(40),
            flags: u32_at(44),
            last: values(0),
            least: values(1),
            greatest: values(2),
        }
    }
}

impl Viewer {
    fn next(&mut self) -> Message {
        self.socket.read().unwrap()
    }

    /// Next text of this type; others and frames are passed over.
    pub fn text(&mut self, kind: &str) -> Value {
        loop {
            if let Message::Text(text) = self.next() {
                let text: Value = serde_json::from_str(&text).unwrap();
                if text["type"] == kind {
                    return text;
                }
            }
        }
    }

    /// The first status for which this is true.
    pub fn status(&mut self, is_wanted: impl Fn(&Value) -> bool) -> Value {
        loop {
            let status = self.text("status");
            if is_wanted(&status) {
                return status;
            }
        }
    }

    /// Next frame; texts are passed over.
    pub fn frame(&mut self) -> Frame {
        loop {
            if let Message::Binary(bytes) = self.next() {
                return Frame::of(&bytes);
            }
        }
    }

    /// Type of the next text, or `frame`.
    pub fn kind(&mut self) -> String {
        match self.next() {
            Message::Binary(_) => "frame".into(),
            Message::Text(text) => {
                let text: Value = serde_json::from_str(&text).unwrap();
                text["type"].as_str().unwrap().to_owned()
            }
            _ => self.kind(),
        }
    }

    /// Sends a message to which no answer comes.
    pub fn tell(&mut self, message: Value) {
        self.socket
            .send(Message::text(message.to_string()))
            .unwrap();
    }

    /// Sends a message and returns the error of its answer.
    pub fn ask(&mut self, message: Value) -> Option<String> {
        self.answer(message)["error"].as_str().map(str::to_owned)
    }

    /// Sends a message and returns its answer.
    pub fn answer(&mut self, mut message: Value) -> Value {
        self.asked += 1;
        message["id"] = json!(self.asked);
        self.tell(message);
        let answer = self.text("answer");
        assert_eq!(answer["id"], self.asked);
        answer
    }

    /// Reads all texts until the server closes the connection.
    pub fn rest(&mut self) -> Vec<Value> {
        let mut texts = Vec::new();
        while let Ok(message) = self.socket.read() {
            if let Message::Text(text) = message {
                texts.push(serde_json::from_str(&text).unwrap());
            }
        }
        texts
    }
}
