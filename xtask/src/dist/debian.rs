//! A Debian package of the command.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::tree::{Tree, failed};
use crate::run::{Outcome, repository, run};

/// Whom the package is from, as the manifests of the crates say.
const AUTHORS: &str = env!("CARGO_PKG_AUTHORS");

/// Folders of the archive and where Debian has them.
const FOLDERS: [(&str, &str); 9] = [
    ("bin", "usr/bin"),
    ("capi", "usr/share/dashpot/capi"),
    ("cluster", "usr/share/dashpot/cluster"),
    ("data", "usr/share/dashpot/data"),
    ("docs", "usr/share/dashpot/docs"),
    ("rail", "usr/share/dashpot/rail"),
    ("share/bash-completion", "usr/share/bash-completion"),
    ("share/doc/dashpot", "usr/share/doc/dashpot"),
    ("share/man", "usr/share/man"),
];

/// Files of the archive and where Debian has them.
const FILES: [(&str, &str); 9] = [
    ("README.md", "usr/share/dashpot/README.md"),
    ("CITATION.cff", "usr/share/dashpot/CITATION.cff"),
    ("CONTRIBUTING.md", "usr/share/dashpot/CONTRIBUTING.md"),
    ("SECURITY.md", "usr/share/dashpot/SECURITY.md"),
    ("CHANGELOG.md", "usr/share/dashpot/CHANGELOG.md"),
    ("LICENSE-MIT", "usr/share/doc/dashpot/LICENSE-MIT"),
    ("LICENSE-APACHE", "usr/share/doc/dashpot/LICENSE-APACHE"),
    (
        "share/zsh/site-functions/_dashpot",
        "usr/share/zsh/vendor-completions/_dashpot",
    ),
    (
        "share/fish/vendor_completions.d/dashpot.fish",
        "usr/share/fish/vendor_completions.d/dashpot.fish",
    ),
];

/// Packs the tree of an archive into `package` for the processor `architecture`, with files of the time `time`.
///
/// # Errors
/// A file cannot be copied, or dpkg-deb fails.
pub fn debian(
    archive: &Path,
    work: &Tree,
    architecture: &str,
    package: &Path,
    time: &str,
) -> Outcome {
    for (folder, to) in FOLDERS {
        work.copy_folder(&archive.join(folder), to)?;
    }
    for (from, to) in FILES {
        work.copy(&archive.join(from), to)?;
    }
    work.write("usr/share/doc/dashpot/copyright", copyright()?)?;
    compress(work)?;
    work.write("DEBIAN/control", control(architecture))?;
    // The modes of files must not depend on this machine.
    let mut modes = Command::new("chmod");
    modes
        .args(["--recursive", "u=rwX,go=rX"])
        .arg(work.folder());
    run(modes, &format!("chmod {}", work.folder().display()))?;
    let mut build = Command::new("dpkg-deb");
    build
        .args(["--build", "--root-owner-group", "-Zxz"])
        .arg(work.folder())
        .arg(package)
        .env("SOURCE_DATE_EPOCH", time);
    run(build, &format!("dpkg-deb {}", package.display()))
}

/// Compresses the manual pages, as Debian's policy wants it.
fn compress(work: &Tree) -> Outcome {
    let pages = work.folder().join("usr/share/man/man1");
    let entries = fs::read_dir(&pages).map_err(|error| failed(&pages, error))?;
    let mut gzip = Command::new("gzip");
    gzip.args(["--no-name", "--best"]);
    gzip.args(entries.flatten().map(|entry| entry.path()));
    run(gzip, "gzip of manual pages")
}

fn control(architecture: &str) -> String {
    format!(
        "Package: dashpot\n\
         Version: {}\n\
         Architecture: {architecture}\n\
         Maintainer: {AUTHORS}\n\
         Section: science\n\
         Priority: optional\n\
         Description: real-time model of a rail vehicle's hydraulic damper\n \
         Replays recordings, tests and calibrates dampers, watches their health,\n \
         and runs them under a locomotive in real time, with a page in the\n \
         browser. Writes constants for firmware, portable C and FMUs.\n",
        env!("CARGO_PKG_VERSION"),
    )
}

fn copyright() -> Outcome<String> {
    let path = repository().join("LICENSE-MIT");
    let text = fs::read_to_string(&path).map_err(|error| failed(&path, error))?;
    let notice = text.lines().find(|line| line.starts_with("Copyright"));
    Ok(format!(
        "{}\n\nLicense: MIT or Apache-2.0; the texts are LICENSE-MIT and LICENSE-APACHE in this folder, and Apache-2.0 \
         is also in /usr/share/common-licenses/Apache-2.0.\nLICENCES-OF-DEPENDENCIES.txt has those of the packages \
         that the command contains.\n",
        notice.unwrap_or(AUTHORS),
    ))
}
