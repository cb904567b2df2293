//! Builds the book from `docs/` with mdBook.

mod check;
mod links;
mod samples;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, cargo, repository, run};
use check::{PAGES, SUMMARY, read};
pub use check::{Sources, read_sources};
use samples::write_samples;

/// Version of mdBook that is installed if there is none on the path.
const VERSION: &str = "0.4.52";
/// What of mdBook is built: the search, not its server, which has most of its dependencies.
const FEATURES: [&str; 3] = ["--no-default-features", "--features", "search"];
/// Folder into which mdBook is installed.
const PROGRAM: &str = "target/mdbook";
/// Folder of the pages for mdBook. They are copies in the same folders as in the repository, so links between `docs/`
/// and other folders hold in the book too. `book.toml` names it.
const SOURCE: &str = "target/book/source";
/// Folder of the finished book, which `book.toml` names.
const BOOK: &str = "target/book/html";

/// Checks the sources, builds the book, and writes sample reports into it. Installs mdBook if it is missing.
///
/// # Errors
/// A link is broken, a page is missing in the summary, mdBook cannot be installed or fails, or a sample cannot be
/// written.
pub fn book() -> Outcome {
    let sources = read_sources(repository())?;
    if !sources.problems.is_empty() {
        return Err(sources.problems.join("\n"));
    }
    copy(&sources, &repository().join(SOURCE))?;
    let mut mdbook = Command::new(program()?);
    mdbook.arg("build").current_dir(repository());
    run(mdbook, "mdbook build")?;
    write_samples(&repository().join(BOOK))?;
    println!(
        "the book is in {}",
        repository().join(BOOK).join("index.html").display()
    );
    Ok(())
}

/// Copies pages and files into `folder`, which is emptied first, and writes the summary with paths from there.
fn copy(sources: &Sources, folder: &Path) -> Outcome {
    let failed =
        |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| failed(folder, &error))?;
    }
    for path in sources.pages.iter().chain(&sources.files) {
        let to = folder.join(path);
        let parent = to.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(|error| failed(parent, &error))?;
        fs::copy(repository().join(path), &to).map_err(|error| failed(&to, &error))?;
    }
    let summary = summary_from_above(&read(&repository().join(SUMMARY))?);
    let path = folder.join("SUMMARY.md");
    fs::write(&path, summary).map_err(|error| failed(&path, &error))
}

/// The summary with paths relative to the folder above that of the pages.
fn summary_from_above(summary: &str) -> String {
    let from_above = summary.replace("](", &format!("]({PAGES}/"));
    from_above.replace(&format!("]({PAGES}/../"), "](")
}

/// Returns mdBook: the one on the path or the one in `target/mdbook`, which is installed if there is neither.
fn program() -> Outcome<PathBuf> {
    let folder = repository().join(PROGRAM);
    let installed = folder.join("bin/mdbook");
    for program in [PathBuf::from("mdbook"), installed.clone()] {
        let version = Command::new(&program).arg("--version").output();
        if version.is_ok_and(|output| output.status.success()) {
            return Ok(program);
        }
    }
    let root = folder.display().to_string();
    let package = ["install", "--locked", "mdbook", "--version", VERSION];
    cargo(&[&package[..], &["--root", &root], &FEATURES].concat())?;
    Ok(installed)
}

#[cfg(test)]
mod tests {
    use super::summary_from_above;

    #[test]
    fn the_summary_leads_to_the_copies() {
        let summary = "[Dashpot](../README.md)\n- [Model](model.md)\n";
        let expected = "[Dashpot](README.md)\n- [Model](docs/model.md)\n";
        assert_eq!(summary_from_above(summary), expected);
    }
}
