//! Progress bar, shown only on a terminal, and not by a quiet command.

use super::print::is_quiet;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Creates a progress bar over `length` units of `what` on standard error, if that is a terminal and the
/// command is not quiet.
///
/// A `length` of 0 means unknown.
pub fn bar(length: u64, what: &'static str) -> ProgressBar {
    let target = match is_quiet() {
        true => ProgressDrawTarget::hidden(),
        false => ProgressDrawTarget::stderr_with_hz(10),
    };
    let bar = ProgressBar::with_draw_target(Some(length), target);
    let template = if length > 0 {
        "[{bar:40}] {percent:>3} % {eta:>4}  {msg}"
    } else {
        "{elapsed:>4}  {msg}"
    };
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(what);
    bar
}
