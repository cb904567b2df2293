//! The live page in headless Chromium: how soon it is alive, how fast its vehicle runs, and how much script it has.
//!
//! `cargo bench -p dashpot-hil --bench page`. Script is counted in processor time of the page's thread, because time of
//! the clock also contains what other programs take from it.

#[path = "../tests/pages/browser.rs"]
#[allow(dead_code, reason = "tests use more of it")]
mod browser;

use std::process::Command;
use std::time::Duration;

use browser::Browser;
use serde_json::Value;

const CASE: [&str; 4] = ["--case", "straight-180", "--speed-km-h", "160"];

/// Wanted paces, and how long the page gets used to one, is watched, and hands over its events.
const PACES: [u32; 2] = [1, 100];
const WARMING: Duration = Duration::from_secs(3);
const WATCHED: Duration = Duration::from_secs(12);
const HANDING_OVER: Duration = Duration::from_secs(2);

/// Events whose processor times are printed.
const EVENTS: [(&str, &str); 2] = [
    ("frames of the screen", "FireAnimationFrame"),
    ("messages received between them", "HandlePostMessage"),
];

/// Simulated time and time of the clock, s.
const NOW: &str = "return [live.histories[0].newest.time_s, 1e-3 * performance.now()];";

fn times(browser: &Browser) -> [f64; 2] {
    serde_json::from_value(browser.find(NOW)).unwrap()
}

/// Processor times of the events of this name in the page's thread, sorted, ms.
fn spent_ms(messages: &[Value], name: &str) -> Vec<f64> {
    let events = messages.iter().map(|message| &message["params"]);
    let events = events.filter(|event| event["name"] == name);
    let mut spent: Vec<f64> = events
        .filter_map(|event| event["tdur"].as_f64())
        .map(|us| 1e-3 * us)
        .collect();
    spent.sort_by(f64::total_cmp);
    spent
}

/// Median, 99 % and greatest.
fn spread(sorted: &[f64]) -> String {
    let at = |share: f64| {
        let last = sorted.len().saturating_sub(1);
        sorted.get((share * last as f64) as usize).copied()
    };
    let [median, most_of_them, greatest] =
        [0.5, 0.99, 1.0].map(|share| at(share).unwrap_or(f64::NAN));
    format!("{median:.1} ms median, {most_of_them:.1} ms 99 %, {greatest:.1} ms greatest")
}

fn main() {
    // Only `cargo bench` passes this: tests must not wait for a minute.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html");
    let written = Command::new(env!("CARGO_BIN_EXE_dashpot"))
        .args(["live", "--page"])
        .arg(&page)
        .args(CASE)
        .status();
    assert!(written.unwrap().success());
    let bytes = std::fs::metadata(&page).unwrap().len();
    println!("page: {:.1} MB", 1e-6 * bytes as f64);

    for pace in PACES {
        watch(&format!("file://{}", page.display()), pace);
    }
}

/// Prints the figures of a page at a pace, from its start on.
fn watch(address: &str, pace: u32) {
    let category = "devtools.timeline";
    let Some(browser) = Browser::tracing("the figures of the live page", Some(category)) else {
        return;
    };
    browser.visit(address, 1280);
    browser.wait_for("live.histories?.[0]?.newest?.time_s > 0");
    let alive_s = browser.find("return 1e-3 * performance.now();");
    browser.find(&format!("live.controls.run({pace}); return null;"));
    std::thread::sleep(WARMING);
    let [from_s, begun_s] = times(&browser);
    std::thread::sleep(WATCHED);
    let [to_s, ended_s] = times(&browser);
    let reached = (to_s - from_s) / (ended_s - begun_s);
    println!("wanted pace {pace}:");
    println!("  alive after {:.1} s", alive_s.as_f64().unwrap());
    println!("  reached {reached:.1} times real time");
    // The browser hands events over some time after it is first asked for them.
    let mut messages = Vec::new();
    for _ in 0..3 {
        messages.extend(browser.messages());
        std::thread::sleep(HANDING_OVER);
    }
    for (what, event) in EVENTS {
        let spent = spent_ms(&messages, event);
        println!("  {} {what}: {}", spent.len(), spread(&spent));
    }
}
