//! The numbers of README.md's list "What you get" are on the pages that it links.

use dashpot::document::read;

/// Words that stand for numbers.
const WORDS: [&str; 5] = ["two", "three", "four", "five", "six"];

/// Numbers in a text, in digits or in words, without those inside names such as `Cortex-M7` and `f32`.
fn numbers(text: &str) -> Vec<&str> {
    let ends_word = |letter: char| !(letter.is_alphanumeric() || ".-_".contains(letter));
    let words = text
        .split(ends_word)
        .map(|word| word.trim_matches(['.', '-']));
    words
        .filter(|word| word.parse::<f64>().is_ok() || WORDS.contains(word))
        .collect()
}

/// Items of the list, without their line breaks.
fn items(readme: &str) -> Vec<String> {
    let (_, list) = readme.split_once("## What you get\n").expect("the list");
    let list = list.split("\n## ").next().expect("the list");
    let items = list.split("\n- ").skip(1);
    items
        .map(|item| {
            item.split("\n\n")
                .next()
                .expect("an item")
                .replace('\n', " ")
        })
        .collect()
}

#[test]
fn numbers_of_the_readme_are_on_the_linked_pages() {
    let items = items(&read("README.md"));
    let mut checked = 0;
    for item in &items {
        let (text, link) = item
            .split_once("](")
            .unwrap_or_else(|| panic!("no link: {item}"));
        let page = link.split([')', '#']).next().expect("a target");
        let document = read(page);
        let known = numbers(&document);
        for number in numbers(text) {
            let is_known = known.iter().any(|known| {
                *known == number
                    || known.parse::<f64>().ok()
                        == number.parse().ok().filter(|_| !WORDS.contains(&number))
            });
            assert!(is_known, "README.md: {number} is not on {page}: {item}");
            checked += 1;
        }
    }
    // A search that finds no numbers must fail.
    assert!(
        items.len() >= 6 && checked >= 10,
        "{checked} numbers in {}",
        items.len()
    );
}

#[test]
fn numbers_are_told_from_names() {
    assert_eq!(
        numbers("150 of a Cortex-M7, 1e-3 at 5 %; `f32` 0.31. five"),
        ["150", "1e-3", "5", "0.31", "five"]
    );
}
