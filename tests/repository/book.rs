//! Every page of docs/ is in the book's table of contents, and every link of a page leads to a file or a heading.

use dashpot::document::{in_repository, read};
use xtask::book::read_sources;

/// Maximum lines of README.md: what a stranger reads before the first command.
const MAX_README_LINES: usize = 100;
/// Maximum bytes of a picture.
const MAX_PICTURE_BYTES: u64 = 150_000;

#[test]
fn every_page_is_in_the_book_and_every_link_resolves() {
    let sources = read_sources(&in_repository("")).expect("the sources of the book");
    assert!(sources.problems.is_empty(), "{:#?}", sources.problems);
    // A search that finds no pages or pictures must fail.
    assert!(sources.pages.len() > 40 && sources.files.len() > 5);
}

#[test]
fn the_readme_is_short_and_its_pictures_are_small() {
    let lines = read("README.md").lines().count();
    assert!(
        lines <= MAX_README_LINES,
        "README.md: {lines} lines, allowed: at most {MAX_README_LINES}; move facts to a page of docs/"
    );
    let pictures = std::fs::read_dir(in_repository("docs/pictures")).expect("the pictures");
    for picture in pictures {
        let picture = picture.expect("a picture");
        let bytes = picture.metadata().expect("its size").len();
        let path = picture.path();
        assert!(
            bytes <= MAX_PICTURE_BYTES,
            "{}: {bytes} bytes, allowed: at most {MAX_PICTURE_BYTES}",
            path.display()
        );
    }
}
