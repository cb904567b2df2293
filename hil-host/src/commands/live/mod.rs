//! `dashpot live`: a vehicle in real time, a recording, or a target, watched and changed from a page in a browser.

mod conversation;
mod inbox;
mod linked;
mod options;
mod pace;
pub mod page;
mod recorded;
mod recorder;
mod replay;
mod roles;
mod rows;
mod serve;
mod source;
mod stop;
mod target_options;
mod vehicle;
mod viewers;

use dashpot_files::output::write_bytes;

use super::failure::Outcome;
pub use options::LiveArguments;

/// Runs the command.
///
/// # Errors
/// An option, the case, the recording or the target is invalid, the page cannot be written, the address cannot be used,
/// or the run ends otherwise than asked.
pub fn run(arguments: &LiveArguments) -> Outcome<()> {
    arguments.check()?;
    match (
        &arguments.page,
        &arguments.recording,
        &arguments.target.link,
    ) {
        (Some(path), ..) => {
            let page = page::in_browser(&arguments.case.choice()?, None)?;
            Ok(write_bytes(path, page.as_bytes())?)
        }
        (_, Some(recording), _) => replay::run(arguments, recording),
        (_, _, Some(link)) => linked::run(arguments, link),
        _ => vehicle::run(arguments),
    }
}
