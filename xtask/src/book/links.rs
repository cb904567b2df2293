//! Links of a page in Markdown, and the anchors of its headings.

use std::collections::BTreeMap;

/// A link or a picture of a page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// Number of the line, from 1.
    pub line: usize,
    /// What the link names: a path with an anchor, or an address.
    pub target: String,
}

impl Link {
    /// True if the link names no file: an address with a scheme.
    #[must_use]
    pub fn is_elsewhere(&self) -> bool {
        let scheme = self.target.split([':', '/', '#']).next().unwrap_or("");
        self.target[scheme.len()..].starts_with(':')
    }

    /// Path and anchor of the target; either may be empty.
    #[must_use]
    pub fn parts(&self) -> (&str, &str) {
        self.target.split_once('#').unwrap_or((&self.target, ""))
    }
}

/// Lines of the text of a page, with their numbers from 1: without fenced and indented code.
fn lines_of_text(page: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut is_code = false;
    page.lines().enumerate().filter_map(move |(at, line)| {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
            return None;
        }
        let is_text = !is_code && !line.starts_with("    ");
        is_text.then_some((at + 1, line))
    })
}

/// The line with spaces in place of the code between backquotes.
fn without_code(line: &str) -> String {
    let parts = line.split('`').enumerate();
    parts
        .map(|(at, part)| match at % 2 {
            0 => part.to_owned(),
            _ => "`".repeat(part.chars().count() + 2),
        })
        .collect()
}

/// Returns the links and pictures of a page: `[text](target)`, `[name]: target`, `src`, `srcset` and `href` of HTML.
#[must_use]
pub fn links(page: &str) -> Vec<Link> {
    let mut found = Vec::new();
    for (number, line) in lines_of_text(page) {
        let mut add = |target: &str| {
            found.push(Link {
                line: number,
                target: target.to_owned(),
            });
        };
        // A definition has the name of code, which is a link all the same.
        if let Some((_, target)) = line
            .strip_prefix('[')
            .and_then(|rest| rest.split_once("]: "))
        {
            add(target.trim());
            continue;
        }
        let line = without_code(line);
        for (start, end) in [
            ("](", ")"),
            ("src=\"", "\""),
            ("srcset=\"", "\""),
            ("href=\"", "\""),
        ] {
            for rest in line.split(start).skip(1) {
                add(rest.split(end).next().unwrap_or(""));
            }
        }
    }
    found
}

/// Returns the anchors of a page's headings, as the book and the hosts of repositories derive them.
#[must_use]
pub fn anchors(page: &str) -> Vec<String> {
    let mut counts = BTreeMap::new();
    let headings = lines_of_text(page).filter_map(|(_, line)| {
        let title = line.trim_start_matches('#');
        let level = line.len() - title.len();
        (1..=6).contains(&level).then(|| title.strip_prefix(' '))?
    });
    let mut found = Vec::new();
    for title in headings {
        let name = anchor(title);
        let count: &mut usize = counts.entry(name.clone()).or_default();
        found.push(match *count {
            0 => name,
            _ => format!("{name}-{count}"),
        });
        *count += 1;
    }
    found
}

fn anchor(title: &str) -> String {
    let letters = title.trim().chars().filter_map(|letter| match letter {
        ' ' => Some('-'),
        '-' | '_' => Some(letter),
        _ if letter.is_alphanumeric() => Some(letter),
        _ => None,
    });
    letters.flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::{anchors, links};

    fn targets(page: &str) -> Vec<String> {
        links(page).into_iter().map(|link| link.target).collect()
    }

    #[test]
    fn links_of_text_are_found_and_those_of_code_are_not() {
        let page = "[a](b.md#c) and `[d](e)` and [f `g`](h.svg)\n\n    [i](j)\n\n```\n[k](l)\n```\n[`m`]: n.rs\n\
                    <img src=\"o.png\" alt=\"p\"><source srcset=\"q.svg\">";
        assert_eq!(targets(page), ["b.md#c", "h.svg", "n.rs", "o.png", "q.svg"]);
        assert_eq!(links(page)[2].line, 8);
    }

    #[test]
    fn addresses_name_no_file() {
        let is_elsewhere = |target: &str| links(&format!("[a]({target})"))[0].is_elsewhere();
        assert!(is_elsewhere("https://example.org/a#b") && is_elsewhere("mailto:a@example.org"));
        assert!(!is_elsewhere("a/b.md#c:d") && !is_elsewhere("#a") && !is_elsewhere("../a.rs"));
    }

    #[test]
    fn anchors_are_those_of_the_headings() {
        let page =
            "# The damper, 2a\n## `--check` _it_\n```\n# none\n```\n## Twice\n## Twice\n#hash\n";
        assert_eq!(
            anchors(page),
            ["the-damper-2a", "--check-_it_", "twice", "twice-1"]
        );
    }
}
