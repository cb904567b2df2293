//! Value of `--outside`: a damper and the source of its force.

use std::path::PathBuf;
use std::str::FromStr;

use dashpot_host_link::LinkChoice;

/// A damper of the vehicle and the source of its force, written `damper=link` or `damper=file`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Choice {
    pub(super) damper: String,
    /// Source as written on the command line.
    pub(super) name: String,
    pub(super) source: Source,
}

/// Source of a force.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Source {
    /// Target code running in this process.
    Desk,
    /// A target.
    Link(LinkChoice),
    /// A rig behind UDP, at HOST:PORT.
    Rig(String),
    /// A recorded force.
    File(PathBuf),
}

impl Source {
    /// True if the damper is outside this process.
    pub(super) fn is_real(&self) -> bool {
        matches!(self, Self::Link(_) | Self::Rig(_))
    }
}

/// Prefixes of links.
const LINKS: [&str; 3] = ["tcp:", "serial:", "qemu:"];

impl FromStr for Choice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words = text.split_once('=');
        let words = words.map(|(damper, source)| (damper.trim(), source.trim()));
        let Some((damper, name)) =
            words.filter(|(damper, name)| !damper.is_empty() && !name.is_empty())
        else {
            return Err(
                "allowed: DAMPER=LINK or DAMPER=FILE, such as \"front lateral damper 1=qemu\""
                    .into(),
            );
        };
        let is_link = name == "qemu" || LINKS.iter().any(|start| name.starts_with(start));
        let source = if name == "desk" {
            Source::Desk
        } else if let Some(address) = name.strip_prefix("udp:") {
            Source::Rig(address.to_owned())
        } else if is_link {
            let link = name.parse();
            Source::Link(link.map_err(|allowed: String| format!("{allowed}, desk, a file"))?)
        } else {
            Source::File(name.into())
        };
        Ok(Self {
            damper: damper.to_owned(),
            name: name.to_owned(),
            source,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Choice;

    #[test]
    fn links_and_rigs_are_real() {
        for (source, is_real) in [
            ("desk", false),
            ("force.csv", false),
            ("tcp:localhost:1", true),
            ("serial:/dev/ttyACM0", true),
            ("udp:localhost:1", true),
        ] {
            let choice: Choice = format!("damper={source}").parse().unwrap();
            assert_eq!(choice.source.is_real(), is_real, "{source}");
        }
    }
}
