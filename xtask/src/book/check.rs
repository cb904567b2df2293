//! Checks the sources of the book: every page is in the summary, and every link leads to a file or a heading.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

use super::links::{anchors, links};
use super::samples::is_sample;

/// Folder with the pages of the book.
pub const PAGES: &str = "docs";
/// Table of contents.
pub const SUMMARY: &str = "docs/SUMMARY.md";

/// Sources of the book, relative to the repository.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sources {
    /// Pages of the summary, in its order.
    pub pages: Vec<PathBuf>,
    /// Files to which pages link, and that are not pages: pictures, programs, settings.
    pub files: BTreeSet<PathBuf>,
    /// What is wrong: file, line, target, and what is allowed.
    pub problems: Vec<String>,
}

/// Reads the sources of the book in `repository` and checks them.
///
/// # Errors
/// A file cannot be read.
pub fn read_sources(repository: &Path) -> Result<Sources, String> {
    let mut sources = Sources::default();
    let summary = read(&repository.join(SUMMARY))?;
    for link in links(&summary) {
        let path = resolved(Path::new(PAGES), link.parts().0);
        if !repository.join(&path).is_file() {
            sources.problems.push(format!(
                "{SUMMARY}:{}: {}: no such file",
                link.line, link.target
            ));
        } else if sources.pages.contains(&path) {
            sources.problems.push(format!(
                "{SUMMARY}:{}: {}: listed twice",
                link.line, link.target
            ));
        } else {
            sources.pages.push(path);
        }
    }
    for page in markdown(&repository.join(PAGES))? {
        let page = page.strip_prefix(repository).unwrap_or(&page).to_owned();
        if page != Path::new(SUMMARY) && !sources.pages.contains(&page) {
            sources.problems.push(format!(
                "{}: not in {SUMMARY}; add it where a reader would look for it",
                page.display()
            ));
        }
    }
    for page in sources.pages.clone() {
        check_links(repository, &page, &mut sources)?;
    }
    Ok(sources)
}

fn check_links(repository: &Path, page: &Path, sources: &mut Sources) -> Result<(), String> {
    let text = read(&repository.join(page))?;
    for link in links(&text) {
        // In the README of a crate, rustdoc resolves names of the crate.
        if link.is_elsewhere() || link.target.contains("::") {
            continue;
        }
        let (path, anchor) = link.parts();
        let target = match path {
            "" => page.to_owned(),
            _ => resolved(page.parent().unwrap_or(Path::new("")), path),
        };
        let mut complain = |what: &str| {
            let page = page.display();
            sources
                .problems
                .push(format!("{page}:{}: {}: {what}", link.line, link.target));
        };
        if is_sample(&target) {
            continue;
        }
        let file = repository.join(&target);
        if target.starts_with("..") || !file.is_file() {
            complain("no such file in the repository");
        } else if target.extension().is_some_and(|end| end == "md") {
            if !sources.pages.contains(&target) {
                complain("a page that docs/SUMMARY.md does not list");
            } else if !anchor.is_empty() {
                let known = anchors(&read(&file)?);
                if !known.iter().any(|known| known == anchor) {
                    complain(&format!("no such heading; allowed: {}", known.join(", ")));
                }
            }
        } else {
            sources.files.insert(target);
        }
    }
    Ok(())
}

/// The path of a link from a folder, both relative to the repository.
fn resolved(folder: &Path, path: &str) -> PathBuf {
    let mut found = PathBuf::new();
    for part in folder.join(path).components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if found.parent().is_some() && !found.ends_with("..") => {
                found.pop();
            }
            part => found.push(part),
        }
    }
    found
}

/// Files in Markdown of a folder and its subfolders, sorted.
fn markdown(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut found = Vec::new();
    for entry in entries {
        let path = entry.map_err(|error| error.to_string())?.path();
        if path.is_dir() {
            found.append(&mut markdown(&path)?);
        } else if path.extension().is_some_and(|end| end == "md") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

pub(super) fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::read_sources;

    #[test]
    fn problems_name_file_line_and_what_is_allowed() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, text).expect("a file");
        };
        write(
            "docs/SUMMARY.md",
            "# Summary\n\n[Name](../README.md)\n- [A](a.md)\n- [Gone](gone.md)\n- [A](a.md)\n",
        );
        write("README.md", "[a](docs/a.md#one) ![b](docs/b.svg)");
        write("other.md", "");
        write("docs/b.svg", "<svg/>");
        write(
            "docs/a.md",
            "# One\n\n[two](#two) [none](c/none.md)\n[other](../other.md) [outside](../../x.md)\n\
             [sample](samples/live.html) [no sample](samples/x.html)\n",
        );
        write("docs/c/lost.md", "# Lost\n");
        let sources = read_sources(folder.path()).expect("the sources");
        assert_eq!(
            sources.problems,
            [
                "docs/SUMMARY.md:5: gone.md: no such file",
                "docs/SUMMARY.md:6: a.md: listed twice",
                "docs/c/lost.md: not in docs/SUMMARY.md; add it where a reader would look for it",
                "docs/a.md:3: #two: no such heading; allowed: one",
                "docs/a.md:3: c/none.md: no such file in the repository",
                "docs/a.md:4: ../other.md: a page that docs/SUMMARY.md does not list",
                "docs/a.md:4: ../../x.md: no such file in the repository",
                "docs/a.md:5: samples/x.html: no such file in the repository",
            ]
        );
        let pages: Vec<_> = sources
            .pages
            .iter()
            .map(|page| page.display().to_string())
            .collect();
        assert_eq!(pages, ["README.md", "docs/a.md"]);
        assert_eq!(sources.files.len(), 1);
    }
}
