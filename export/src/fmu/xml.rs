//! XML documents.

use std::fmt::Write;

use maud::Escaper;

/// XML document under construction.
pub(super) struct Xml {
    pub text: String,
    depth: usize,
}

impl Xml {
    pub fn new() -> Self {
        Self {
            text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".into(),
            depth: 0,
        }
    }

    pub fn line(&mut self, line: &str) {
        // Writing to a String does not fail.
        let _ = writeln!(self.text, "{:width$}{line}", "", width = 2 * self.depth);
    }

    pub fn open(&mut self, element: &str, attributes: &[(&str, &str)]) {
        self.line(&format!("<{element}{}>", with_values(attributes)));
        self.depth += 1;
    }

    pub fn empty(&mut self, element: &str, attributes: &[(&str, &str)]) {
        self.line(&format!("<{element}{}/>", with_values(attributes)));
    }

    pub fn close(&mut self, element: &str) {
        self.depth -= 1;
        self.line(&format!("</{element}>"));
    }
}

fn with_values(attributes: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (name, value) in attributes {
        let _ = write!(text, " {name}=\"");
        // File names may contain control characters, but XML must not.
        let value = value.replace(char::is_control, " ");
        let _ = Escaper::new(&mut text).write_str(&value);
        text.push('"');
    }
    text
}
