//! Contents of a page: links to its headings.

use maud::{PreEscaped, html};

/// Number of headings from which a page has contents.
const MIN_HEADINGS: usize = 4;
const START: &str = "<h2>";
const END: &str = "</h2>";

/// Returns the body of a page with an id on each second-level heading and, if there are enough of them, with links to
/// them below the title.
///
/// The body is the program's own HTML, in which every text is escaped, so a heading is found by its tags.
pub(super) fn with_contents(body: &str) -> String {
    let mut headings: Vec<(String, String)> = Vec::new();
    let mut parts = body.split(START);
    let title = parts.next().unwrap_or_default();
    let mut rest = String::new();
    for part in parts {
        let (heading, after) = part.split_once(END).unwrap_or((part, ""));
        let text = without_tags(heading);
        let id = unique(&slug(&text), &headings);
        rest += &format!("<h2 id=\"{id}\">{heading}{END}{after}");
        headings.push((id, text));
    }
    if headings.len() < MIN_HEADINGS {
        return title.to_owned() + &rest;
    }
    let links = html! {
        nav.contents aria-label="Contents" {
            ul { @for (id, text) in &headings { li { a href=(format!("#{id}")) { (PreEscaped(text)) } } } }
        }
    };
    let (before, after) = title.split_at(end_of_title(title));
    format!("{before}{}{after}{rest}", links.into_string())
}

/// Position after the title and, if it follows, the lead.
fn end_of_title(body: &str) -> usize {
    let after = |at: usize, end: &str| {
        let found = body[at..].find(end);
        found.map_or(at, |place| at + place + end.len())
    };
    let title = after(0, "</h1>");
    if body[title..].starts_with("<p class=\"lead\">") {
        after(title, "</p>")
    } else {
        title
    }
}

/// Text of a heading without tags; entities stay.
fn without_tags(heading: &str) -> String {
    let mut parts = heading.split('<');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| {
        text + part.split_once('>').map_or("", |(_, after)| after)
    })
}

/// Lower-case letters and digits of a text, joined by hyphens.
fn slug(text: &str) -> String {
    let words = text.split(|c: char| !c.is_alphanumeric());
    let words: Vec<String> = words
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
        .collect();
    match words.join("-") {
        empty if empty.is_empty() => "part".into(),
        slug => slug,
    }
}

/// Adds a number to an id that another heading has.
fn unique(slug: &str, headings: &[(String, String)]) -> String {
    let is_free = |id: &str| headings.iter().all(|(other, _)| other != id);
    let numbered = (2_usize..).map(|number| format!("{slug}-{number}"));
    std::iter::once(slug.to_owned())
        .chain(numbered)
        .find(|id| is_free(id))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHORT: &str = "<h1>A run</h1><p class=\"lead\">Fast.</p><h2>Wheel loads</h2><p>1</p>";

    #[test]
    fn headings_of_a_short_page_have_ids_but_no_list() {
        let page = with_contents(SHORT);
        assert_eq!(page, SHORT.replace("<h2>", "<h2 id=\"wheel-loads\">"));
    }

    #[test]
    fn a_long_page_lists_its_headings_below_the_lead() {
        let long =
            format!("{SHORT}<h2>A <b>B</b> &amp; c</h2><h2>Wheel loads</h2><h2>§</h2><p>2</p>");
        let page = with_contents(&long);
        let list = "<p class=\"lead\">Fast.</p><nav class=\"contents\" aria-label=\"Contents\"><ul>\
                    <li><a href=\"#wheel-loads\">Wheel loads</a></li>\
                    <li><a href=\"#a-b-amp-c\">A B &amp; c</a></li>\
                    <li><a href=\"#wheel-loads-2\">Wheel loads</a></li>\
                    <li><a href=\"#part\">§</a></li></ul></nav><h2 id=\"wheel-loads\">";
        assert!(page.contains(list), "{page}");
        assert!(page.ends_with("<h2 id=\"part\">§</h2><p>2</p>"), "{page}");
        assert!(page.contains("<h2 id=\"a-b-amp-c\">A <b>B</b> &amp; c</h2>"));
    }
}
