//! Verdicts in reports: green if passed, red if failed, yellow for warnings, on a terminal that shows colours.

use std::cell::Cell;
use std::fmt;
use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

/// Verdict that a text states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// A limit or a check is met.
    Passed,
    /// It is not met.
    Failed,
    /// The result needs a second look.
    Warning,
}

thread_local! {
    /// True while this thread prints a report with colours.
    static HAS_COLOURS: Cell<bool> = const { Cell::new(false) };
}

/// Prefixes that colour a whole line's beginning.
const PREFIXES: [(&str, Verdict); 3] = [
    ("warning:", Verdict::Warning),
    ("note:", Verdict::Warning),
    ("error:", Verdict::Failed),
];

impl Verdict {
    /// Returns `Passed` if `passed` is true, else `Failed`.
    pub fn of(passed: bool) -> Self {
        match passed {
            true => Self::Passed,
            false => Self::Failed,
        }
    }

    /// Marks a text of a report with its verdict. Width and alignment of the format apply to the text.
    pub fn mark<T: AsRef<str>>(self, text: T) -> Marked<T> {
        Marked {
            verdict: self,
            text,
        }
    }

    fn style(self) -> Style {
        let colour = match self {
            Self::Passed => AnsiColor::Green,
            Self::Failed => AnsiColor::Red,
            Self::Warning => AnsiColor::Yellow,
        };
        colour.on_default()
    }
}

/// Text with its verdict, coloured within [`print()`].
#[derive(Debug, Clone, Copy)]
pub struct Marked<T> {
    verdict: Verdict,
    text: T,
}

impl<T: AsRef<str>> fmt::Display for Marked<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !HAS_COLOURS.get() {
            return f.pad(self.text.as_ref());
        }
        let style = self.verdict.style();
        write!(f, "{style}")?;
        f.pad(self.text.as_ref())?;
        write!(f, "{style:#}")
    }
}

/// Calls `text` to print a report to `out`, with `colours` or without. With them, `warning:`, `note:` and `error:` at
/// the beginning of a line have theirs; without them, every byte is that of the text.
///
/// # Errors
/// The output cannot be written.
pub fn print<W: Write>(
    out: W,
    colours: bool,
    text: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let before = HAS_COLOURS.replace(colours);
    let mut lines = Lines {
        line: Vec::new(),
        colours,
        out,
    };
    let printed = text(&mut lines).and_then(|()| lines.flush());
    HAS_COLOURS.set(before);
    printed
}

/// Colours prefixes of lines, each when it is complete.
struct Lines<W> {
    line: Vec<u8>,
    colours: bool,
    out: W,
}

impl<W: Write> Lines<W> {
    fn end_line(&mut self) -> io::Result<()> {
        let line = std::mem::take(&mut self.line);
        let is_prefix = |(prefix, _): &&(&str, Verdict)| line.starts_with(prefix.as_bytes());
        match PREFIXES.iter().find(is_prefix) {
            Some((prefix, verdict)) => {
                let style = verdict.style();
                write!(self.out, "{style}{prefix}{style:#}")?;
                self.out.write_all(&line[prefix.len()..])
            }
            None => self.out.write_all(&line),
        }
    }
}

impl<W: Write> Write for Lines<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if !self.colours {
            return self.out.write(bytes);
        }
        for part in bytes.split_inclusive(|byte| *byte == b'\n') {
            self.line.extend_from_slice(part);
            if part.ends_with(b"\n") {
                self.end_line()?;
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.end_line()?;
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::{Verdict, print};

    fn printed(colours: bool) -> String {
        let mut out = Vec::new();
        print(&mut out, colours, |out| {
            write!(out, "warn")?;
            writeln!(out, "ing: a gap, no warning: here")?;
            let [met, violated] = [true, false].map(Verdict::of);
            writeln!(
                out,
                "{:<8}|{:>9}",
                met.mark("within"),
                violated.mark("outside")
            )?;
            write!(out, "note: no line end")
        })
        .unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn without_colours_every_byte_is_that_of_the_text() {
        let text = "warning: a gap, no warning: here\nwithin  |  outside\nnote: no line end";
        assert_eq!(printed(false), text);
    }

    #[test]
    fn verdicts_have_the_colours_of_traffic_lights() {
        let text = "\x1b[33mwarning:\x1b[0m a gap, no warning: here\n\
                    \x1b[32mwithin  \x1b[0m|\x1b[31m  outside\x1b[0m\n\
                    \x1b[33mnote:\x1b[0m no line end";
        assert_eq!(printed(true), text);
    }
}
