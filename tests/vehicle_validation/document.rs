//! Text of `docs/vehicle-validation.md`.

use crate::claim::{LIMITED_PERCENT, NONE_PERCENT, Verdict};
use crate::rows::{Kept, early_endings, percent};
use crate::trends::{Compared, compare, table};
use xtask::vehicle_validation::SEEDS;

/// The whole document.
pub fn text(paper: &Kept, wide: &Kept, stand_ins: &Kept) -> String {
    let compared = compare(paper);
    let (limited, others): (Vec<&Compared>, Vec<&Compared>) = compared
        .iter()
        .partition(|row| row.change.confidence.is_none());
    let count = |verdict: Verdict| others.iter().filter(|row| row.verdict == verdict).count();
    let [holds, not_shown, not] =
        [Verdict::Holds, Verdict::NotShown, Verdict::DoesNotHold].map(count);
    let early = early_endings(&[paper, wide, stand_ins]);
    let limited_hold = limited.iter().filter(|row| row.verdict == Verdict::Holds);
    format!(
        "# The paper's vehicle studies compared with ours

`cargo xtask vehicle-validation` writes this page from the rows in `data/studies/rows/`. `tests/vehicle_validation` compares the
page with the rows, and a sample of the rows with new runs, bit for bit. `dashpot sweep paper` draws the figures over 8 seeds.

The paper studies dampers in a model of the SS9 locomotive, whose parameters are not published. Ours is a public stand-in
(`data/vehicles/locomotive.toml`, which marks each assumed value). It can reproduce the direction and size of changes, not
absolute values.

- Runs: straight track at 180 km/h for 5 s, and a curve of 200 m with 0.12 m of cant at 100 km/h for 10 s. Track of class 6 with
  wavelengths of 3 to 80 m, seeds 1 to {SEEDS}. The paper states neither its wavelengths, nor its single realisation, nor the points
  at which it evaluates the ride.
- Wzz and Wzy are Sperling's vertical and lateral ride indices: 0.5 to 40 Hz, one window of 5 s, maximum of three points at the
  height of the body's centre of gravity (in the middle and over both bogies).
- RMS_Dc, RMS_Wn and RMS_Fy belong to the leading wheelset: the larger Y/Q of its wheels, its wear number and its lateral force.
  RMS_Ay is the lateral acceleration of the body. All are root mean squares of the whole run, with a contact damping of 5 s/m.
- A change is the difference between the two ends of a range on the same irregularity: the mean over the seeds with its
  95 % confidence interval (Student). {early}
- A rise or fall holds if the interval lies on that side of zero. **Rises** and **is influenced** do not hold if the change is
  within {NONE_PERCENT} %, unless the paper calls it slight. **Hardly changes** holds within {NONE_PERCENT} %. **Flat above** holds if the slope above,
  including its interval, is less than a quarter of the slope below. **Limited fluctuation** holds if the range of the means is
  within {LIMITED_PERCENT} % of their mean; it has no interval. *Not shown* means that the interval includes the bound.

Of {} claims tested with an interval, {holds} hold and {not} do not (not shown: {not_shown}). One claim in twenty fails by chance, and all
claims are tested on the same irregularities.
Of {} more claims of limited fluctuation, {} hold. This is an easy test for a vehicle whose lateral dampers have
little effect in a curve.

{}
{}
{}
{}
{}",
        others.len(),
        limited.len(),
        limited_hold.count(),
        table(&compared),
        levels(paper),
        why(&compared, paper, stand_ins),
        curve(paper, wide),
        coupling(paper),
    )
}

/// Our change for a published row.
fn of_row(compared: &[Compared], figure: &str, observed: &str) -> String {
    let found = compared
        .iter()
        .find(|row| row.trend.figure == figure && row.observed == observed);
    let row = found.unwrap_or_else(|| panic!("no row {figure} {observed}"));
    percent(&row.change)
}

/// Table of our values at the nominal parameters and of the ranges on the paper's axes.
fn levels(paper: &Kept) -> String {
    let mut text = String::from(
        "## Values at the nominal parameters

Means over the seeds with their intervals. The paper's figures have axes but no values; its curves lie within these axes.

| index | ours | the paper's axes | |
|---|---|---|---|
",
    );
    for (what, sweep, index, scale, axis) in [
        ("Wzz", "straight", "sperling_vertical", 1.0, [2.5, 2.6]),
        ("Wzy", "straight", "sperling_lateral", 1.0, [2.5, 2.6]),
        ("RMS_Dc", "curve", "derailment_rms", 1.0, [0.5, 1.1]),
        (
            "RMS_Wn, N",
            "curve",
            "wear_number_rms_n",
            1.0,
            [1000.0, 2200.0],
        ),
        (
            "RMS_Fy, kN",
            "curve",
            "lateral_force_rms_n",
            1e-3,
            [50.0, 110.0],
        ),
        (
            "RMS_Ay, m/s²",
            "curve",
            "body_lateral_rms_m_per_s2",
            1.0,
            [0.5, 1.1],
        ),
    ] {
        let estimate = paper.mean(paper.sweep(sweep), 0, index);
        let (mean, half) = (
            estimate.mean * scale,
            estimate.confidence.unwrap_or(0.0) * scale,
        );
        let digits = if mean > 500.0 {
            0
        } else if mean > 10.0 {
            1
        } else {
            3
        };
        let [low, high] = axis;
        let is_within = (low..=high).contains(&mean);
        text.push_str(&format!(
            "| {what} | {mean:.digits$} ± {half:.digits$} | {low} to {high} | {} |\n",
            if is_within { "within" } else { "outside" }
        ));
    }
    text.push_str(
        "
For the ride, the axes of Figs. 12 and 15 share the range from 2.5 to 2.6. Our lateral index is higher, because the stand-in has
no yaw dampers and its flanges strike the rails. Our lateral acceleration follows from mechanics: at 100 km/h on a curve of 200 m
with 0.12 m of cant, 3.07 m/s² remain, which an accelerometer on the body measures (here averaged with the straight and the
transition before the curve). A value near 1 is inconsistent with lateral forces of 60 kN and more. The vehicle is close to
overturning in this curve (inner wheels lift), so a curve of 600 m is compared below.
",
    );
    text
}

/// Change of an index in a sweep of the stand-ins.
fn varied(kept: &Kept, sweep: &str, first: Option<&str>, ends: [f64; 2], index: &str) -> String {
    let sweep = kept.sweep(sweep);
    let points = ends.map(|value| kept.point(sweep, first, value));
    percent(&kept.change(sweep, points, index))
}

/// Explanation of the differences.
fn why(compared: &[Compared], paper: &Kept, stand_ins: &Kept) -> String {
    let mut text = String::from(
        "## Sensitivity of the rows

Change of each row between the two ends of its range, in percent, with one stand-in value changed at a time.

| Fig., index | as above | 3 to 30 m | German low | friction 0.3 | 1 m to the side | to the side, 3 to 30 m |
|---|---|---|---|---|---|---|
",
    );
    let rows: [(&str, [f64; 2], &[&str]); 8] = [
        (
            "12a",
            [100e3, 140e3],
            &["sperling_vertical", "sperling_vertical_first"],
        ),
        (
            "12b",
            [0.01, 0.05],
            &["sperling_vertical", "sperling_vertical_first"],
        ),
        (
            "12c",
            [2e6, 10e6],
            &["sperling_vertical", "sperling_vertical_first"],
        ),
        (
            "12d",
            [0.5e-3, 2.5e-3],
            &["sperling_vertical", "sperling_lateral"],
        ),
        (
            "15a",
            [70e3, 110e3],
            &["sperling_lateral", "sperling_vertical"],
        ),
        (
            "15b",
            [0.01, 0.1],
            &["sperling_lateral", "sperling_vertical"],
        ),
        (
            "15c",
            [2e6, 8e6],
            &["sperling_lateral", "sperling_vertical"],
        ),
        (
            "15d",
            [0.5e-3, 3e-3],
            &["sperling_lateral", "sperling_vertical"],
        ),
    ];
    for (figure, ends, indices) in rows {
        for index in indices {
            let of = |kind: &str, first: Option<&str>| {
                varied(stand_ins, &format!("{figure} {kind}"), first, ends, index)
            };
            let cells = [
                varied(paper, figure, None, ends, index),
                of("track", Some("straight-short")),
                of("track", Some("straight-german")),
                of("friction", None),
                of("side", Some("straight")),
                of("side", Some("straight-short")),
            ];
            let index = match *index {
                "sperling_vertical" => "Wzz",
                "sperling_lateral" => "Wzy",
                _ => "Wzz, middle",
            };
            text.push_str(&format!("| {figure}, {index} | {} |\n", cells.join(" | ")));
        }
    }
    let of_17d = |sweep: &str, first: Option<&str>| {
        varied(stand_ins, sweep, first, [0.5e-3, 2e-3], "derailment_rms")
    };
    let greatest =
        [2e-3, 3e-3].map(|to| varied(paper, "17d", None, [0.5e-3, to], "derailment_greatest"));
    text.push_str(&format!(
        "
**12a, 12b: long waves.** More damping reduces the bounce of the body (1.4 to 1.8 Hz, waves of 28 to 36 m at this speed) and
transmits more vibration at higher frequencies. With waves up to 80 m the two effects nearly cancel for C, and a damper that
saturates early lets the body bounce. Without waves above 30 m the index rises with C, and in the middle of the body and at its
side also with Vr, as in the paper. With the German spectrum, which has less energy in long waves, it rises with C too.

**12c: the change in the middle of the body has the published size.** Over the bogies it is twice as large, because the dampers
also resist pitch.

**12d: above 2.5 mm** the index keeps rising, because our dampers move further than that on class 6. [Out of
service](out-of-service.md) continues to 12 mm, where a damper has hardly any effect.

**15a, 15b, vertical index: the measurement point is decisive.** Lateral dampers cause no vertical motion on the centre line of a symmetric
vehicle; the coupling that the paper reports is roll. At points 1 m to the side of the pivots, as in the rules for coaches, the
vertical index rises with C and Vr of the lateral dampers, for long and short waves.

**15b, lateral index:** it keeps rising above 0.05 m/s, because flange impacts move the stand-in's lateral dampers faster than
that.

**15d:** the paper reports a slight fall. Here it is a slight rise, and a slight fall on track with the German spectrum.

**17d is not reproduced:** {} % instead of +9.28 %. With friction 0.2 and 0.4 it is {} and {} %; at 80 and 90 km/h {} and {} %; with the stops 20 mm
further out {} %; in curves of 300 m and 600 m at 70 km/h {} and {} %. A lateral damper exerts at most C Vr, 6.3 kN.
The two of a bogie therefore exert at most 12.6 kN and, 1 m ahead of and behind its middle, a moment of at most 12.6 kN m; both have
a mean of zero. The curve requires about 100 kN, so steering determines Y/Q. A play of 1.5 mm changes the fluctuation of Y/Q, not its root mean square; flutter of the flange at 60 to
120 Hz decides the sign of such a small change. The maxima change in the published direction: the maximum over all wheels of Y/Q,
averaged over 2 m, changes by {} % at 2 mm and {} % at 3 mm. Fig. 18a shows the same: larger coefficients occur more often.
",
        of_row(compared, "17d", "RMS_Dc"),
        of_17d("17d friction", Some("0.2")),
        of_17d("17d friction", Some("0.4")),
        of_17d("17d speed", Some("80")),
        of_17d("17d speed", Some("90")),
        of_17d("17d stops", None),
        of_17d("17d radius", Some("curve-r300")),
        of_17d("17d radius", Some("curve-r600")),
        greatest[0],
        greatest[1],
    ));
    text
}

/// Comparison of the published curve with a curve of 600 m radius.
fn curve(paper: &Kept, wide: &Kept) -> String {
    let mut text = String::from(
        "## In a curve of 600 m

Range of the means of each sweep relative to their mean, in percent, at 100 km/h: in the curve of 200 m, then of 600 m.

| varied | Y/Q | wear number | lateral force | lateral acceleration |
|---|---|---|---|---|
",
    );
    let indices = [
        "derailment_rms",
        "wear_number_rms_n",
        "lateral_force_rms_n",
        "body_lateral_rms_m_per_s2",
    ];
    for (part, what) in [("a", "C"), ("b", "Vr"), ("c", "Ke"), ("d", "2a")] {
        let cells = indices.map(|index| {
            let ranges = [paper, wide].map(|kept| {
                let sweep = kept.sweep(&format!("17{part}"));
                format!("{:.2}", kept.range(sweep, index))
            });
            ranges.join(", ")
        });
        text.push_str(&format!("| {what} | {} |\n", cells.join(" | ")));
    }
    text
}

/// Correlation of the ride indices above the bogies and in the middle.
fn coupling(paper: &Kept) -> String {
    let [over, middle] = ["sperling_vertical", "sperling_vertical_first"]
        .map(|index| paper.mean(paper.sweep("straight"), 0, index).mean);
    format!(
        "## Other influences

- The vertical index is {over:.2} over the bogies and {middle:.2} in the middle, so a published value must state its measurement point.
- The normal damping of the contact is 5 s/m, and the locomotive has no yaw dampers. Its flanges strike the rails at 180 km/h on
  class 6 ([vehicle.md](vehicle.md)), which raises the lateral index.
"
    )
}
