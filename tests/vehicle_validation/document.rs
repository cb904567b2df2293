//! Text of `docs/vehicle-validation.md`.

use crate::claim::{LIMITED_PERCENT, NONE_PERCENT, Verdict};
use crate::rows::{Kept, percent};
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
    let limited_hold = limited.iter().filter(|row| row.verdict == Verdict::Holds);
    format!(
        "# The paper's vehicle studies beside ours

Written by `cargo xtask vehicle-validation` from the rows in `data/studies/rows/`; `tests/vehicle_validation` holds this text against the rows, and rows
drawn from all over them against new runs, bit for bit. The figures themselves, over 8 seeds: `dashpot sweep paper`.

The paper studies dampers in a model of the SS9 locomotive whose parameters are not published. Ours is a public stand-in
(`data/vehicles/locomotive.toml`, where each assumed value is marked), so what can be reproduced are directions and sizes of changes, not values.

- Straight track at 180 km/h for 5 s, curve of 200 m with 0.12 m of cant at 100 km/h for 10 s, class 6 with wavelengths of 3 to 80 m, seeds 1 to {SEEDS}. The
  paper does not give its wavelengths, its one realisation, or the points at which it takes the ride.
- Wzz, Wzy: Sperling's ride index up and down and to the side, 0.5 to 40 Hz, one window of 5 s, greatest of three points at the height of the body's centre of
  gravity: middle and over both bogies. Of the leading wheelset RMS_Dc, the greater of its wheels' Y/Q, RMS_Wn, its wear number, RMS_Fy, its lateral force;
  RMS_Ay: lateral acceleration of the body. Root mean squares of the whole run, contact damping 5 s/m.
- A change is that of one irregularity from one end of the range to the other, the mean over the seeds with its confidence interval of 95 % (Student).
- **Rises, falls, by so much** holds where the interval is on that side of zero; **rises** or **is influenced** does not where it is within {NONE_PERCENT} %, unless it is said to
  be slight. **Hardly changes** holds within {NONE_PERCENT} %. **Flat above** holds where the slope there, with its interval, is less than a quarter of the one below. **Limited
  fluctuation**: range of the means within {LIMITED_PERCENT} % of their mean; no interval belongs to it. *Not shown*: the interval reaches over the bound.

Of {} claims with an interval hold {holds}, do not hold {not}, are not shown {not_shown}; one in twenty misses by chance, and all share the same irregularities. Of {} more of limited
fluctuation hold {}: easily, for a vehicle whose lateral dampers do little in a curve.

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

/// Our change of a published row.
fn of_row(compared: &[Compared], figure: &str, observed: &str) -> String {
    let found = compared
        .iter()
        .find(|row| row.trend.figure == figure && row.observed == observed);
    let row = found.unwrap_or_else(|| panic!("no row {figure} {observed}"));
    percent(&row.change)
}

/// Table of values at the nominal parameters and of the ranges of the paper's axes.
fn levels(paper: &Kept) -> String {
    let mut text = String::from(
        "## Values at the nominal parameters

Mean over the seeds with its interval. The paper's figures have axes, not numbers; its curves lie somewhere within these.

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
Of the ride the axes of Figs. 12 and 15 have 2.5 to 2.6 in common. Our lateral index is above: the stand-in has no yaw dampers and its flanges strike. The lateral acceleration is that of
mechanics: 100 km/h on 200 m with 0.12 m of cant leave 3.07 m/s² on the circle (here with the straight and the transition before it), and an accelerometer on the body has them; a value
near 1 does not go with lateral forces of 60 kN and more. The vehicle is at the edge of overturning there (inner wheels lift), so a curve of 600 m stands beside it below.
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
        "## What the rows depend on

Each row once more at both ends of its range, with one stand-in value changed. In percent.

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
**12a, 12b: long waves.** More damping calms the bounce of the body (1.4 to 1.8 Hz, waves of 28 to 36 m at this speed) and passes on more of
what is faster. With waves up to 80 m the two nearly cancel for C, and a damper that saturates early lets the body bounce. Without waves over 30 m the index rises
with C, and in the middle of the body and to its side with Vr, as the paper has it; with the German spectrum, which has less of the long ones, it rises with C too.

**12c: the middle of the body has the published size**, the points over the bogies twice as much: pitch is there, which the dampers hold as well.

**12d, above 2.5 mm** the index goes on to rise: in class 6 our dampers move further than that. [Out of service](out-of-service.md) follows it to 12 mm, where a damper is hardly
better than none.

**15a, 15b, vertical index: the point decides.** On the middle line of a symmetrical vehicle lateral dampers do not move it up and down; the coupling that the paper
reports is roll. At points 1 m to the side of the pivots, as rules for coaches have them, the vertical index rises with C and Vr of the lateral dampers, with long waves and with short ones.

**15b, lateral index** goes on to rise above 0.05 m/s: where flanges strike, the stand-in's lateral dampers move faster than that.

**15d**: what the paper calls a slight fall is a slight rise here, and a slight fall on track of the German spectrum.

**17d is not reproduced**: {} % for +9.28 %. Friction 0.2 and 0.4: {} and {}; 80 and 90 km/h: {} and {}; stops 20 mm further: {};
curves of 300 m and 600 m at 70 km/h: {} and {}. The two lateral dampers of a bogie give it 12.6 kN and, a metre before and behind its middle, 12.6 kN m at most (C Vr is 6.3 kN), and nothing
on the mean, while the curve asks some 100 kN of it: steering sets Y/Q there. A millimetre and a half of play changes how Y/Q fluctuates, not its root mean square, and the sign of so small a change is set by
flutter of the flange at 60 to 120 Hz. The published direction is in the greatest values: greatest mean over 2 m of all wheels {} % at 2 mm and {} % at 3 mm, which is what Fig. 18a shows, larger
coefficients more often.
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

/// Comparison of the published curve with a curve of 600 m.
fn curve(paper: &Kept, wide: &Kept) -> String {
    let mut text = String::from(
        "## In a curve of 600 m

Range of the means of each sweep over their mean, in percent, at 100 km/h: 200 m, and 600 m.

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

/// Correlation of the ride indices over the bogies and in the middle.
fn coupling(paper: &Kept) -> String {
    let [over, middle] = ["sperling_vertical", "sperling_vertical_first"]
        .map(|index| paper.mean(paper.sweep("straight"), 0, index).mean);
    format!(
        "## What else decides

- The vertical index over the bogies is {over:.2}, in the middle {middle:.2}: a published value needs its point.
- Normal damping of the contact is 5 s/m and the locomotive has no yaw dampers; its flanges strike at 180 km/h on class 6
  ([vehicle.md](vehicle.md)), which the lateral index contains.
"
    )
}
