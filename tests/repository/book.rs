//! Every page of docs/ is in the book's table of contents, and every link of a page leads to a file or a heading.

use dashpot::document::in_repository;
use xtask::book::read_sources;

#[test]
fn every_page_is_in_the_book_and_every_link_resolves() {
    let sources = read_sources(&in_repository("")).expect("the sources of the book");
    assert!(sources.problems.is_empty(), "{:#?}", sources.problems);
    // A search that finds no pages or pictures must fail.
    assert!(sources.pages.len() > 40 && sources.files.len() > 5);
}
