//! Documentation page inside an FMU.

use maud::{DOCTYPE, html};

use super::Fmu;

impl Fmu {
    /// Text of `documentation/index.html`.
    pub(super) fn page(&self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head { meta charset="utf-8"; title { (self.identifier) } }
                body {
                    h1 { (self.title) }
                    (self.about)
                }
            }
        };
        page.into_string()
    }
}
