//! Checks that docs/contact.md shows the measured figures and table.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::climbing::{FRICTIONS, LAWS, YAWS_MRAD, climbing};
use crate::figures::figures;
use crate::shifts::{position_error_mm, shifts, steering};

const BEGIN: &str = "<!-- exact: begin -->";
const END: &str = "<!-- exact: end -->";

fn measured() -> String {
    let mut text = format!(
        "\nContact position at shifts of 0.5 to 6 mm: {:.2} mm RMS from exact theory.\n\n\
         | shift, mm | position, mm: exact | here | angle, mrad: exact | here | steering, kN: exact | here | lateral, \
         kN: exact | here |\n\
         |---|---|---|---|---|---|---|---|---|\n",
        position_error_mm()
    );
    let steering = steering();
    for shift in shifts() {
        let steering = steering
            .iter()
            .find(|(lateral_mm, _)| *lateral_mm == shift.lateral_mm);
        let half_millimetre = (2.0 * shift.lateral_mm).fract() == 0.0;
        let root = (4.5..=6.5).contains(&shift.lateral_mm);
        if shift.lateral_mm < 0.0 || !(half_millimetre || root) || shift.lateral_mm > 6.5 {
            continue;
        }
        let (exact, found) = (shift.exact, shift.found);
        let forces = steering.map_or_else(
            || "| | ".to_owned(),
            |(_, [exact, found])| format!("| {:.2} | {:.2} ", 1e-3 * exact, 1e-3 * found),
        );
        let _ = writeln!(
            text,
            "| {} | {:.2} | {:.2} | {:.0} | {:.0} {forces}| {:.2} | {:.2} |",
            shift.lateral_mm,
            exact.place_mm,
            found.place_mm,
            1e3 * exact.angle_rad,
            1e3 * found.angle_rad,
            1e-3 * exact.lateral_n,
            1e-3 * found.lateral_n
        );
    }
    text.push_str("\n| Y/Q on the flange: largest deviation from exact theory |");
    for friction in FRICTIONS {
        let _ = write!(text, " friction {friction} |");
    }
    text.push_str("\n|---|---|---|---|\n");
    for (law, name) in LAWS.iter().enumerate().skip(1) {
        let _ = write!(text, "| {name} |");
        for by_yaw in climbing() {
            let off = by_yaw.map(|quotients| quotients[law] / quotients[0] - 1.0);
            let largest = off
                .into_iter()
                .max_by(|a, b| a.abs().total_cmp(&b.abs()))
                .unwrap_or(0.0);
            let _ = write!(text, " {:+.1} % |", 100.0 * largest);
        }
        text.push('\n');
    }
    let _ = writeln!(
        text,
        "\nThe yaw is {} to {} mrad; the wheel runs on its flange under 100 kN. All laws use the same patches.",
        YAWS_MRAD[0],
        YAWS_MRAD[YAWS_MRAD.len() - 1]
    );
    text
}

#[test]
fn the_document_shows_the_measured_values() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let bless = std::env::var_os("DASHPOT_BLESS").is_some();
    for (name, drawn) in figures() {
        let path = docs.join("contact").join(name);
        if bless {
            fs::write(&path, &drawn).unwrap();
        }
        let kept = fs::read_to_string(&path).unwrap();
        assert_eq!(kept, drawn, "{name}: run with DASHPOT_BLESS=1 to redraw it");
    }
    let path = docs.join("contact.md");
    let document = fs::read_to_string(&path).unwrap();
    let begin = document.find(BEGIN).expect("the block begins") + BEGIN.len();
    let end = document.find(END).expect("the block ends");
    let block = measured();
    if bless {
        let text = format!("{}{block}{}", &document[..begin], &document[end..]);
        fs::write(&path, text).unwrap();
        return;
    }
    assert_eq!(
        &document[begin..end],
        block,
        "run with DASHPOT_BLESS=1 to update it"
    );
}
