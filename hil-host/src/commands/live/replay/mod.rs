//! A recording of a vehicle, shown on the page as it ran.

mod player;
mod side;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use dashpot_live::{Built, Desk, Observer, Scene, SignalWords, Status, WheelOnRail};
use dashpot_recording::Signals;
use player::Player;
use serde::Serialize;
use serde_json::{Value, json};
use side::ReplaySide;

use super::conversation::Conversation;
use super::options::LiveArguments;
use super::serve::serve;
use super::stop::Stop;
use super::viewers::Viewers;
use crate::commands::failure::Outcome;
use crate::commands::{counted, interruption, print_report};

/// Report of a recording that was shown.
#[derive(Serialize)]
struct Report {
    recording: PathBuf,
    case: String,
    rows: usize,
    start_s: f64,
    end_s: f64,
    warnings: Vec<String>,
    viewers: Viewers,
}

/// Shows the recording until the command is interrupted.
///
/// # Errors
/// The case is invalid, the recording cannot be read or has none of the vehicle's signals, or the address cannot be
/// used.
pub(super) fn run(arguments: &LiveArguments, path: &Path) -> Outcome<()> {
    let case = arguments.case.case()?;
    let built = Built::new(case, |pair: &WheelOnRail| Ok(pair.tables()?))?;
    let run = built.run()?;
    let desk = Desk::new(built.case(), &run)?;
    let names = Observer::new(&desk, &run)?.names().to_vec();
    // The first name is that of the time, which a recording has in any case.
    let (signals, warnings) = read(path, &names[1..])?;
    let player = Player::new(signals, &names[1..]);
    let [start_s, end_s] = player.ends_s();
    let file = path.file_name().unwrap_or(path.as_os_str());
    let shown = json!({"name": file.to_string_lossy(), "start_s": start_s, "end_s": end_s});
    let scene = without_controls(json!(Scene::new(&desk, &run, &names)?), shown);
    let mut status = json!(Status::new(&desk, None));
    status["warnings"] = json!(warnings);
    for damper in entries(&mut status["dampers"]) {
        (damper["values"], damper["quantities"]) = (json!({}), json!([]));
    }
    let case = built.case();
    let served = serve(
        arguments,
        &case.name,
        &case.vehicle.name,
        &Arc::<Stop>::default(),
    )?;
    let _ends_gently = interruption::end_gently();
    served.announce();
    let rows = player.rows();
    let source = ReplaySide {
        player,
        hub: served.server.hub().clone(),
        scene,
        status,
        since: None,
    };
    let hub = served.server.hub().clone();
    let mut conversation = Conversation::new(hub.clone(), source);
    conversation.run(&served.to_hear, interruption::is_wanted);
    conversation.end("the recording is no longer shown".into());
    served.end();
    let report = Report {
        recording: path.to_owned(),
        case: case.name.clone(),
        rows,
        start_s,
        end_s,
        warnings,
        viewers: hub.count().into(),
    };
    print_report(arguments.format, &report, print)
}

/// Reads the signals of a vehicle, and says what is missing.
fn read(path: &Path, names: &[String]) -> Outcome<(Signals, Vec<String>)> {
    let words: Vec<SignalWords> = names.iter().map(|name| SignalWords::of(name)).collect();
    let names = names.iter().map(String::as_str);
    let wanted: Vec<(&str, &str)> = names.zip(words.iter().map(SignalWords::unit)).collect();
    let signals = Signals::read(path, &wanted)?;
    let has = wanted.iter().zip(signals.has());
    let missing: Vec<&str> = has
        .filter(|(_, has)| !has)
        .map(|((name, _), _)| *name)
        .collect();
    let warning = missing.first().map(|first| {
        format!(
            "the recording lacks {} of the vehicle's {} signals, such as {first}",
            missing.len(),
            wanted.len()
        )
    });
    Ok((signals, warning.into_iter().collect()))
}

/// The scene of a vehicle that nobody can change.
fn without_controls(mut scene: Value, recording: Value) -> Value {
    (scene["source"], scene["recording"]) = (json!("recording"), recording);
    (scene["faults"], scene["defects"]) = (json!([]), json!([]));
    for damper in entries(&mut scene["dampers"]) {
        (damper["quantities"], damper["presets"]) = (json!([]), json!([]));
    }
    scene
}

fn entries(list: &mut Value) -> impl Iterator<Item = &mut Value> {
    list.as_array_mut().into_iter().flatten()
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(
        out,
        "{}: {} from {} s to {} s, shown with {}",
        report.recording.display(),
        counted(report.rows as u64, "row"),
        report.start_s,
        report.end_s,
        report.case
    )?;
    for warning in &report.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    report.viewers.print(out)
}
