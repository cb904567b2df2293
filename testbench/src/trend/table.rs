//! Fleet as a table in plain text.

use super::fleet::Fleet;

/// Dampers in the table; the page and the other tables have all.
const ROWS: usize = 20;

const HEAD: [&str; 7] = [
    "vehicle",
    "damper",
    "limit reached",
    "parameter",
    "at the last reading",
    "rate",
    "readings",
];

impl Fleet {
    /// Returns the most urgent dampers as lines with columns, and notes about them.
    pub fn text_table(&self) -> String {
        let axis = self.axis;
        let shown = self.dampers.iter().take(ROWS);
        let rows: Vec<[String; 7]> = shown
            .clone()
            .map(|damper| {
                let worst = damper.worst(axis);
                let [vehicle, position, serial_number] = damper.name();
                let position = match serial_number {
                    "" => position.to_owned(),
                    number => format!("{position}, no. {number}"),
                };
                [
                    vehicle.to_owned(),
                    position,
                    worst.when_in_words(axis),
                    worst.parameter.name().to_owned(),
                    worst.now_in_words(),
                    worst.rate_in_words(axis),
                    format!("{} of {}", damper.used(), damper.recorded.len()),
                ]
            })
            .collect();
        let mut lines = vec![HEAD.map(str::to_owned)];
        lines.extend(rows);
        let widths: [usize; 7] = std::array::from_fn(|column| {
            let widths = lines.iter().map(|line| line[column].chars().count());
            widths.max().unwrap_or(0)
        });
        let mut text = String::new();
        for line in &lines {
            let cells = line.iter().zip(widths);
            let cells: Vec<String> = cells
                .map(|(cell, width)| format!("{cell:width$}"))
                .collect();
            text += cells.join("  ").trim_end();
            text.push('\n');
        }
        for damper in shown {
            let [vehicle, position, _] = damper.name();
            for note in damper.notes(axis) {
                text += &format!("note: {vehicle}, {position}: {note}\n");
            }
        }
        match self.dampers.len().saturating_sub(ROWS) {
            0 => {}
            more => text += &format!("and {more} more dampers, less urgent\n"),
        }
        text
    }
}
