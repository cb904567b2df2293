//! Verdicts on a page: a sign and a word besides the colour, for readers who do not see the colour and for grey prints.

use maud::{Markup, html};

/// Returns "within" or "above" with its sign.
pub fn verdict(is_within: bool) -> Markup {
    html! {
        @if is_within { span.within { "✓ within" } } @else { span.above { "✗ above" } }
    }
}

/// Returns a text with the sign of its verdict, for a text that states the verdict in words.
pub fn judged(is_good: bool, text: &str) -> Markup {
    html! {
        @if is_good { span.within { "✓ " (text) } } @else { span.above { "✗ " (text) } }
    }
}

/// Returns a cell of a table with a share of a limit in percent, as text, marked if it is above the limit.
pub fn share_cell(share: Option<f64>, text: &str) -> Markup {
    html! {
        @match share {
            Some(share) if share > 1.0 => td.above { (text) " ✗" },
            _ => td { (text) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_is_more_than_a_colour() {
        let [kept, broken] = [true, false].map(|kept| verdict(kept).into_string());
        assert_eq!(kept, "<span class=\"within\">✓ within</span>");
        assert_eq!(broken, "<span class=\"above\">✗ above</span>");
        assert_eq!(
            judged(false, "3 differ").into_string(),
            "<span class=\"above\">✗ 3 differ</span>"
        );
        let cells = [Some(1.2), Some(1.0), None].map(|share| share_cell(share, "x").into_string());
        assert_eq!(
            cells,
            ["<td class=\"above\">x ✗</td>", "<td>x</td>", "<td>x</td>"]
        );
    }
}
