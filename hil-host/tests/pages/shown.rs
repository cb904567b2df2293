//! Pages examined by the tests; each is generated once.

use std::fs;
use std::sync::LazyLock;

use dashpot_report::page::{Parts, content_policy, parts};

use crate::common::dashpot;
use crate::pil_common::{desk, serve_tcp};

/// Page of the demonstration as it is written.
pub static WHOLE_DEMONSTRATION: LazyLock<String> =
    LazyLock::new(|| made(&["--output", "page.html"], "page.html"));

/// Page of the demonstration without the live page above it: histories and loops.
pub static DEMONSTRATION: LazyLock<String> = LazyLock::new(|| below_live(&WHOLE_DEMONSTRATION));

/// The report in a page that begins with the live page, which has its own tests (`live.rs`).
fn below_live(page: &str) -> String {
    let Parts {
        styles, scripts, ..
    } = parts(&maud::PreEscaped(String::new()));
    let (_, report) = page.split_once("<article class=\"report\">").unwrap();
    let (report, _) = report.split_once("</article>").unwrap();
    let policy = content_policy(scripts, styles);
    let in_tags = |tag: &str, texts: &[&str]| -> String {
        let texts = texts.iter();
        texts.map(|text| format!("<{tag}>{text}</{tag}>")).collect()
    };
    format!(
        "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>Demonstration</title>{}</head>\
         <body><main class=\"report\">{report}</main>{}</body></html>",
        in_tags("style", styles),
        in_tags("script", scripts)
    )
}

/// Page in which the locomotive runs by itself.
pub static LIVE: LazyLock<String> = LazyLock::new(|| {
    let case = ["live", "--case", "straight-180", "--speed-km-h", "160"];
    made(&[&case[..], &["--page", "page.html"]].concat(), "page.html")
});

/// Page of a locomotive: histories that share their cursor.
pub static VEHICLE: LazyLock<String> = LazyLock::new(|| {
    let arguments = ["vehicle", "--case", "straight-180", "--output", "run"];
    made(&arguments, "run/report.html")
});

/// Page and indices of a locomotive that enters a curve.
pub static CURVE: LazyLock<[String; 2]> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let case = ["vehicle", "--case", "curve-r300", "--duration-s", "5"];
    let line = [&case[..], &["--output", "run"]].concat();
    dashpot(&line, folder.path()).success();
    let files = ["run/report.html", "run/indices.json"];
    files.map(|file| fs::read_to_string(folder.path().join(file)).unwrap())
});

/// Page of a damper on a target simulated in this process: a histogram, a logarithmic scale, dashed lines.
pub static BANK: LazyLock<String> = LazyLock::new(|| {
    let link = format!("tcp:{}", serve_tcp(|| Box::new(desk())));
    let input = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../data/excitations/ride_made.csv"
    );
    let line = ["pil", "--link", &link, "--timeout-ms", "60000", "--paced"];
    let run = ["--ticks", "400", "--page", "page.html", "--input", input];
    made(&[&line[..], &run].concat(), "page.html")
});

/// Page of a study with a figure of each kind.
pub static STUDY: LazyLock<String> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(&path, include_str!("study.toml")).unwrap();
    let study = path.to_str().unwrap();
    made(&["sweep", study, "--output", "study"], "study/report.html")
});

/// Page of a calibration: profiles, loops with points and lines.
pub static CALIBRATION: LazyLock<String> = LazyLock::new(|| {
    let input = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/bench/bench_made.mf4");
    let line = ["calibrate", "--damper", "in-service", "--input", input];
    let found = [
        "--vary",
        "mount.clearance_m",
        "--output",
        "found.toml",
        "--page",
        "page.html",
    ];
    made(&[&line[..], &found].concat(), "page.html")
});

/// Page of a damper's health: bands and levels.
pub static HEALTH: LazyLock<String> = LazyLock::new(|| {
    let input = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/bench/worn_made.mf4");
    let line = ["replay", "--damper", "in-service", "--input", input];
    made(
        &[&line[..], &["--output", "f.csv", "--health", "page.html"]].concat(),
        "page.html",
    )
});

/// Page of a bench sheet: tables, loops, limits as bars, forces over temperature.
pub static SHEET: LazyLock<String> = LazyLock::new(|| {
    let line = ["rig", "--damper", "in-service", "--sheet", "example"];
    made(&[&line[..], &["--page", "page.html"]].concat(), "page.html")
});

/// Page of a frequency response: logarithmic scales on both axes, points over lines.
pub static RESPONSE: LazyLock<String> = LazyLock::new(|| {
    let line = ["response", "--damper", "in-service", "--swept"];
    made(&[&line[..], &["--page", "page.html"]].concat(), "page.html")
});

fn made(arguments: &[&str], page: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    dashpot(arguments, folder.path()).success();
    fs::read_to_string(folder.path().join(page)).unwrap()
}

/// All pages, with the number of their plots and the label of an axis.
pub fn all() -> [(&'static str, &'static str, usize, &'static str); 8] {
    [
        ("demonstration", &DEMONSTRATION, 13, "time, s"),
        ("vehicle", &VEHICLE, 73, "time, s"),
        ("bank", &BANK, 4, "time, s"),
        ("study", &STUDY, 10, "time, s"),
        ("sheet", &SHEET, 7, "peak velocity, m/s"),
        ("response", &RESPONSE, 3, "frequency, Hz"),
        // Three profiles, and two loops and the residual for each of four tests.
        ("calibration", &CALIBRATION, 15, "time, s"),
        // Flow, stiffness, clearance, lag, force offset, friction, force and contact.
        ("health", &HEALTH, 8, "time, s"),
    ]
}
