//! Work and lateness of the ticks of `dashpot live` with viewers: the table in docs/live.md.
//!
//! `cargo bench -p dashpot-hil --bench viewers -- --seconds 20 --fifo 80`. The viewers run on the same machine and read
//! all frames, so they take some of its time too.

use std::io::{BufRead, BufReader, Read};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::thread::JoinHandle;

use serde_json::Value;
use tungstenite::Message;
use tungstenite::client::IntoClientRequest;

/// Numbers of viewers.
const VIEWERS: [usize; 3] = [0, 1, 20];

/// Reads frames until the server ends; returns their number and their bytes.
fn watch(address: &str) -> JoinHandle<(u64, u64)> {
    let stream = TcpStream::connect(address).unwrap();
    let mut request = format!("ws://{address}/live")
        .into_client_request()
        .unwrap();
    let origin = format!("http://{address}").parse().unwrap();
    request.headers_mut().insert("Origin", origin);
    let (mut socket, _) = tungstenite::client(request, stream).unwrap();
    std::thread::spawn(move || {
        let (mut frames, mut bytes) = (0, 0);
        while let Ok(message) = socket.read() {
            if let Message::Binary(frame) = message {
                frames += 1;
                bytes += frame.len() as u64;
            }
        }
        (frames, bytes)
    })
}

/// Figures of one kind of time, us.
fn figures(report: &Value, name: &str) -> [f64; 4] {
    let spreads = report["realtime"]["spreads"].as_array().unwrap();
    let spread = spreads.iter().find(|spread| spread["name"] == name);
    let figures = &spread.unwrap()["figures"];
    ["p50_ns", "p99_ns", "p99_9_ns", "worst_ns"]
        .map(|key| 1e-3 * figures[key].as_f64().unwrap_or(f64::NAN))
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    // Only `cargo bench` passes this: tests must not wait for a minute.
    if !arguments.iter().any(|argument| argument == "--bench") {
        return;
    }
    let value = |option: &str| {
        let at = arguments.iter().position(|argument| argument == option)?;
        arguments.get(at + 1).map(String::as_str)
    };
    let seconds = value("--seconds").unwrap_or("20");
    let fifo = value("--fifo").map(|priority| ["--fifo", priority]);
    println!(
        "| viewers | work p50 | p99 | p99.9 | most | late p50 | p99 | p99.9 | most | missed | frames lost \
         | kB/s a viewer |"
    );
    println!("|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|");
    for viewers in VIEWERS {
        let mut live = Command::new(env!("CARGO_BIN_EXE_dashpot"))
            .args(["live", "--case", "straight-180", "--listen", "127.0.0.1:0"])
            .args(["--duration-s", seconds, "--format", "json"])
            .args(fifo.iter().flatten())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut told = String::new();
        let mut errors = BufReader::new(live.stderr.take().unwrap());
        while !told.contains("http://") {
            told.clear();
            assert_ne!(errors.read_line(&mut told).unwrap(), 0, "no address");
        }
        let address = told.split("http://").nth(1).unwrap();
        let address = address.split('/').next().unwrap();
        let watching: Vec<_> = (0..viewers).map(|_| watch(address)).collect();
        let mut report = String::new();
        let mut out = live.stdout.take().unwrap();
        out.read_to_string(&mut report).unwrap();
        live.wait().unwrap();
        let report: Value = serde_json::from_str(&report).unwrap();
        let seen = watching
            .into_iter()
            .map(|watching| watching.join().unwrap());
        let bytes = seen.map(|(_, bytes)| bytes).sum::<u64>() as f64;
        let rate = bytes / viewers.max(1) as f64 / seconds.parse::<f64>().unwrap() * 1e-3;
        let cells = [figures(&report, "work"), figures(&report, "lateness")].concat();
        let cells: Vec<String> = cells.iter().map(|us| format!("{us:.0}")).collect();
        println!(
            "| {viewers} | {} | {} of {} | {} | {rate:.0} |",
            cells.join(" | "),
            report["realtime"]["missed_deadlines"],
            report["realtime"]["ticks"],
            report["viewers"]["lost_frames"],
        );
    }
}
