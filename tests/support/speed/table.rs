//! Text of the table of speeds.

use super::{Goal, Line, Measured, Source};

/// Returns the table: one line each with ours, the yardstick, their ratio, the goal, and whether it is reached.
pub fn table(lines: &[Line], measured: &Measured) -> String {
    let titles = ["", "ours", "yardstick", "", "ratio", "goal", ""].map(str::to_owned);
    let mut rows = vec![titles];
    rows.extend(lines.iter().map(|line| row(line, measured)));
    let width = |column: usize| {
        let lengths = rows.iter().map(|row| row[column].chars().count());
        lengths.max().unwrap_or(0)
    };
    let widths: [usize; 7] = std::array::from_fn(width);
    let mut text = String::new();
    for row in &rows {
        let cells: Vec<String> = row
            .iter()
            .zip(widths)
            .enumerate()
            .map(|(column, (cell, width))| match column {
                // Texts are flush left, numbers flush right.
                0 | 3 | 6 => format!("{cell:width$}"),
                _ => format!("{cell:>width$}"),
            })
            .collect();
        text += cells.join("  ").trim_end();
        text.push('\n');
    }
    text
}

fn row(line: &Line, measured: &Measured) -> [String; 7] {
    let ours = measured.figure(line.ours);
    let yardstick = measured.figure(line.yardstick.source);
    let ratio = ours.zip(yardstick).map(|(ours, other)| ours / other);
    let shown = |figure: Option<f64>, source| {
        figure.map_or_else(
            || "not measured".to_owned(),
            |value| quantity(value, source),
        )
    };
    let goal = match line.goal {
        Some(Goal::Ratio(goal)) => significant(goal),
        Some(Goal::Figure(goal)) => quantity(goal, line.ours),
        None => String::new(),
    };
    let verdict = line.goal.and_then(|goal| {
        let (found, goal) = match goal {
            Goal::Ratio(goal) => (ratio?, goal),
            Goal::Figure(goal) => (ours?, goal),
        };
        Some(verdict(found / goal))
    });
    [
        line.what.to_owned(),
        shown(ours, line.ours),
        shown(yardstick, line.yardstick.source),
        line.yardstick.name.to_owned(),
        ratio.map_or_else(|| "-".to_owned(), significant),
        goal,
        verdict.unwrap_or_default(),
    ]
}

/// What to say of a figure divided by its goal.
fn verdict(over_goal: f64) -> String {
    if over_goal <= 1.0 {
        "reached".into()
    } else if over_goal < 2.0 {
        format!("{:.0} % above", (100.0 * (over_goal - 1.0)).ceil())
    } else {
        format!("{over_goal:.1} times")
    }
}

/// A time in the unit that suits it, or a number of instructions.
fn quantity(value: f64, source: Source) -> String {
    if matches!(
        source,
        Source::Target { .. } | Source::Counted(_) | Source::Instructions(_)
    ) {
        return format!("{value:.0} instructions");
    }
    let (scale, unit) = match value {
        _ if value < 1e-6 => (1e9, "ns"),
        _ if value < 1e-3 => (1e6, "us"),
        _ if value < 1.0 => (1e3, "ms"),
        _ => (1.0, "s"),
    };
    format!("{} {unit}", significant(value * scale))
}

/// Three significant digits, without an exponent.
fn significant(value: f64) -> String {
    let digits_before_point = value.abs().log10().floor() as i32 + 1;
    let decimals = (3 - digits_before_point).max(0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::{Goal, Line, Measured, Source, quantity, significant, table, verdict};
    use crate::speed::Yardstick;

    #[test]
    fn numbers_have_three_digits_and_a_fitting_unit() {
        assert_eq!(significant(0.1534), "0.153");
        assert_eq!(significant(47.16), "47.2");
        assert_eq!(significant(21300.0), "21300");
        assert_eq!(quantity(47.16e-9, Source::Seconds(0.0)), "47.2 ns");
        assert_eq!(quantity(0.25e-3, Source::Seconds(0.0)), "250 us");
        assert_eq!(quantity(12.0, Source::Seconds(0.0)), "12.0 s");
        assert_eq!(quantity(149.0, Source::Counted("")), "149 instructions");
    }

    #[test]
    fn a_goal_is_reached_up_to_its_value() {
        assert_eq!(verdict(1.0), "reached");
        assert_eq!(verdict(1.001), "1 % above");
        assert_eq!(verdict(2.5), "2.5 times");
    }

    #[test]
    fn each_line_has_ours_yardstick_ratio_and_goal() {
        let of = |ours, goal| Line {
            what: "tick",
            ours,
            yardstick: Yardstick {
                name: "real time",
                source: Source::Seconds(1e-3),
            },
            goal: Some(goal),
        };
        let lines = [
            of(Source::Seconds(10e-6), Goal::Figure(5e-6)),
            of(Source::Seconds(10e-6), Goal::Ratio(0.02)),
            of(Source::Counted("missing"), Goal::Ratio(0.02)),
        ];
        let expected = "              \
                            ours  yardstick              ratio     goal\n\
            tick       10.0 us    1.00 ms  real time  0.0100  5.00 us  2.0 times\n\
            tick       10.0 us    1.00 ms  real time  0.0100   0.0200  reached\n\
            tick  not measured    1.00 ms  real time       -   0.0200\n";
        assert_eq!(table(&lines, &Measured::default()), expected);
    }
}
