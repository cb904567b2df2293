//! Contents of a page: links to its headings, in the order of the page and of the keyboard.

use crate::browser::Browser;
use crate::shown::{VEHICLE, all};

#[test]
fn the_links_of_every_page_lead_to_its_headings() {
    for (name, page, ..) in all() {
        let headings = page.matches("<h2 id=\"").count();
        let Some((_, list)) = page.split_once("<nav class=\"contents\"") else {
            assert!(headings < 4, "{name}: {headings}");
            continue;
        };
        let (list, _) = list.split_once("</nav>").unwrap();
        let links: Vec<&str> = list
            .split("href=\"#")
            .skip(1)
            .map(|link| link.split_once('"').unwrap().0)
            .collect();
        assert!(
            headings >= 4 && links.len() == headings,
            "{name}: {links:?}"
        );
        for id in links {
            assert_eq!(
                page.matches(&format!("<h2 id=\"{id}\">")).count(),
                1,
                "{name}: {id}"
            );
        }
    }
}

#[test]
fn the_keyboard_reaches_contents_legends_and_plots_in_the_order_of_the_page() {
    let Some(browser) = Browser::start("the order of the keyboard") else {
        return;
    };
    browser.open(&VEHICLE, 390);
    let order = browser.find(
        "const all = [...document.querySelectorAll('a[href], button, [tabindex]')];
         return all.map(element => [element.tabIndex, element.className || element.tagName]);",
    );
    let order = order.as_array().unwrap();
    assert!(order.iter().all(|element| element[0] == 0), "{order:?}");
    let place = |kind: &str| order.iter().position(|element| element[1] == kind);
    assert_eq!(place("A"), Some(0));
    assert!(place("data") < place("plot"), "{order:?}");
    // Nothing of the list is cut off on a phone.
    let cut = browser.find(
        "return [...document.querySelectorAll('.contents a')]
             .filter(link => link.getBoundingClientRect().right > 390).length;",
    );
    assert_eq!(cut, 0);
    browser.click(".contents li:last-child a");
    browser.wait_for("location.hash === '#figures'");
}
