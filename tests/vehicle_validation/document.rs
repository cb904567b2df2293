//! Text of `docs/vehicle-validation.md`.

use dashpot_files::study::Value;
use dashpot_testbench::response::at_amplitude;

use crate::claim::{Claim, LIMITED_PERCENT, NONE_PERCENT, Verdict};
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

{}

**Result.** Of {} claims of the paper that are tested with an interval, {holds} hold and {not} do not (not shown: {not_shown}); of {} claims
of limited fluctuation, {} hold, an easy test for a vehicle whose lateral dampers have little effect in a curve. One
claim in twenty fails by chance, and all claims are tested on the same irregularities. The effect of clearance on
derailment in the curve (Fig. 17d) is not reproduced.

`cargo xtask vehicle-validation` writes this page from the rows in `data/studies/rows/`. `tests/vehicle_validation` compares the
page with the rows, and a sample of the rows with new runs, bit for bit. `dashpot sweep paper` draws the figures over 8 seeds.

The paper studies dampers in a model of the SS9 locomotive, whose parameters are not published. Ours is a public stand-in
(`data/vehicles/locomotive.toml`, which marks each assumed value). It can reproduce the direction and size of changes, not
absolute values.

- Runs: straight track at 180 km/h for 5 s, and a curve of 200 m with 0.12 m of cant at 100 km/h for 10 s. Track of class 6,
  seeds 1 to {SEEDS}, with wavelengths of 3 to 30 m on straight track and of 3 to 80 m in the curve. The paper states neither its wavelengths, nor its single
  realisation, nor the points at which it evaluates the ride; [the sensitivity](#sensitivity-of-the-rows) shows what they decide.
- Rails give way, and the normal damping of the contact is 0.3 s/m ([vehicle.md](vehicle.md#rails-and-damping)).
- Wzz and Wzy are Sperling's vertical and lateral ride indices: 0.5 to 40 Hz, one window of 5 s, maximum of three points on the
  floor, 1.3 m above the rails: in the middle, and over both bogies 1 m to the side.
- RMS_Dc, RMS_Wn and RMS_Fy belong to the leading wheelset: the larger Y/Q of its wheels, its wear number and its lateral force.
  RMS_Ay is the lateral acceleration of the body. All are root mean squares of the whole run.
- A change is the difference between the two ends of a range on the same irregularity: the mean over the seeds with its
  95 % confidence interval (Student). {early}
- A rise or fall holds if the interval lies on that side of zero. **Rises** and **is influenced** do not hold if the change is
  within {NONE_PERCENT} %, unless the paper calls it slight. **Hardly changes** holds within {NONE_PERCENT} %. **Flat above** holds if the slope above,
  including its interval, is less than a quarter of the slope below. **An amount** holds if the direction does and the interval
  reaches a quarter of the amount. **Limited fluctuation** holds if the range of the means is
  within {LIMITED_PERCENT} % of their mean; it has no interval. *Not shown* means that the interval includes the bound.

{}
{}
{}
{}
{}",
        health(paper),
        others.len(),
        limited.len(),
        limited_hold.count(),
        table(&compared),
        words(paper),
        levels(paper),
        why(&compared, paper, stand_ins),
        curve(paper, wide),
    )
}

/// Describes the vehicle and its health.
fn health(paper: &Kept) -> String {
    let sweep = paper.sweep("straight");
    let of = |index: &str| -> Vec<f64> {
        paper
            .values(sweep, 0, index)
            .into_iter()
            .flatten()
            .collect()
    };
    let mean = |index: &str| 100.0 * of(index).iter().sum::<f64>() / of(index).len() as f64;
    let most = |index: &str| 100.0 * of(index).into_iter().fold(0.0, f64::max);
    let above = |index: &str| of(index).iter().filter(|value| **value > 1.0).count();
    let lateral = "lateral_force_over_limit";
    let load = "wheel_load_over_limit";
    let nadal = "derailment_over_nadal";
    let lift_ms = most("wheel_lift_longest_s") * 10.0;
    format!(
        "**Vehicle.** A six-axle locomotive of 124 t with four yaw dampers per bogie, on rails that give way, at
180 km/h. As new it is healthy: over {} seeds the lateral force of its worst wheelset is {:.0} % of Prud'homme's limit on average and {:.0} % at most (above the
limit for {}), the filtered load of its worst wheel {:.0} % of the limit of EN 14363 (at most {:.0} %), Y/Q {:.0} % of Nadal's limit (at most {:.0} %),
and {}.",
        of(lateral).len(),
        mean(lateral),
        most(lateral),
        match above(lateral) {
            0 => "no seed".to_owned(),
            1 => "one seed".to_owned(),
            count => format!("{count} seeds"),
        },
        mean(load),
        most(load),
        mean(nadal),
        most(nadal),
        if lift_ms == 0.0 {
            "no wheel leaves the rail".to_owned()
        } else {
            format!("a wheel leaves the rail for at most {lift_ms:.0} ms")
        }
    )
}

/// Force over displacement, in kN/mm, of a damper at these frequencies.
fn stiffness(paper: &Kept, sweep: &str, value: f64, damper: &str, amplitude_m: f64) -> [f64; 3] {
    let sweep = paper.sweep(sweep);
    let case = paper
        .study
        .case_with(sweep, Some(&Value::Number(value)), None)
        .expect("a case");
    let checked = case
        .damper(damper)
        .expect("the damper")
        .clone()
        .check()
        .expect("valid");
    let responses = at_amplitude(&checked, amplitude_m, &[1.0, 3.4, 7.0]).expect("periodic");
    let [a, b, c] = &responses[..] else {
        panic!("three responses")
    };
    [a, b, c].map(|response| 1e-6 * response.stiffness_n_per_m())
}

/// The claims that the paper makes in words about its Figs. 13, 14 and 18.
fn words(paper: &Kept) -> String {
    let estimate = |sweep: &str, [from, to]: [f64; 2], index: &str| {
        let sweep = paper.sweep(sweep);
        let points = [from, to].map(|value| paper.point(sweep, None, value));
        paper.change(sweep, points, index)
    };
    let acceleration = "body_vertical_rms_m_per_s2";
    let stiffer = estimate("12c", [2e6, 10e6], acceleration);
    let looser = estimate("12d", [0.5e-3, 2.5e-3], acceleration);
    let climbing = [2e-3, 3e-3].map(|to| estimate("17d", [0.5e-3, to], "derailment_greatest"));
    // True if a characteristic rises from the first to the last value at each of these frequencies.
    let rises = |responses: &[[f64; 3]; 3], frequencies: &[usize]| {
        frequencies
            .iter()
            .all(|f| responses[2][*f] > responses[0][*f])
    };
    let agrees = |agrees: bool| if agrees { "holds" } else { "**contradicts**" };
    let vertical = [2e6, 6e6, 10e6]
        .map(|value| stiffness(paper, "12c", value, "front vertical damper 1", 2e-3));
    let lateral = [0.5e-3, 1e-3, 2e-3]
        .map(|value| stiffness(paper, "17d", value, "front lateral damper 1", 5e-3));
    let at = |responses: &[[f64; 3]; 3], frequency: usize| {
        let numbers = responses
            .iter()
            .map(|response| format!("{:.2}", response[frequency]));
        numbers.collect::<Vec<_>>().join(", ")
    };
    format!(
        "## What the paper says about Figs. 13, 14 and 18

| Fig. | the paper's words | ours | |
|---|---|---|---|
| 13a | vertical vibration of the body is apparently reduced with increasing Ke | acceleration of the body (rms) {} % from 2 to 10 MN/m | {} |
| 13b | with increasing Ke, the transfer characteristics of the dampers decrease significantly from 0.8 to 3.4 Hz | force over displacement at 2 mm for Ke of 2, 6, 10 MN/m: {} kN/mm at 1 Hz, {} at 3.4 Hz | {} |
| 13b | they transfer vibrations more easily up to 7 Hz | {} kN/mm at 7 Hz | {} |
| 14 | the vertical acceleration of the body increases significantly with 2a | acceleration of the body (rms) {} % from 0.5 to 2.5 mm | {} |
| 18a | larger derailment coefficients occur more frequently with larger 2a | greatest Y/Q of all wheels, mean over 2 m: {} % at 2 mm, {} % at 3 mm | {} |
| 18b | below 1 Hz, the transfer characteristics of lateral dampers with larger 2a increase obviously | force over displacement at 5 mm for 2a of 0.5, 1, 2 mm: {} kN/mm at 1 Hz | {} |

The paper does not say what its characteristics relate to each other. Force over displacement of a damper in series with a
stiffness can only rise with that stiffness and fall with a clearance, at every frequency, so Figs. 13b and 18b must show another
ratio, or the transfer through the whole suspension.
",
        percent(&stiffer),
        Claim::FallsSlightly.verdict(&stiffer).words(),
        at(&vertical, 0),
        at(&vertical, 1),
        agrees(!rises(&vertical, &[0, 1])),
        at(&vertical, 2),
        agrees(rises(&vertical, &[2])),
        percent(&looser),
        Claim::Rises.verdict(&looser).words(),
        percent(&climbing[0]),
        percent(&climbing[1]),
        Claim::RisesSlightly.verdict(&climbing[1]).words(),
        at(&lateral, 0),
        agrees(rises(&lateral, &[0])),
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
For the ride, the axes of Figs. 12 and 15 share the range from 2.5 to 2.6. Our lateral acceleration follows from mechanics: at
100 km/h on a curve of 200 m with 0.12 m of cant, 3.07 m/s² remain in the plane of the track (here averaged with the straight and
the transition before the curve). A value near 1 is inconsistent with lateral forces of 60 kN and more.
The vehicle is close to overturning in this curve (inner wheels lift), so a curve of 600 m is compared below.
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

| Fig., index | as above | 3 to 80 m | German low | friction 0.3 | without yaw dampers | points on the middle line |
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
            &[
                "sperling_lateral",
                "sperling_lateral_first",
                "sperling_vertical",
            ],
        ),
    ];
    for (figure, ends, indices) in rows {
        for index in indices {
            let of = |kind: &str, first: Option<&str>| {
                varied(stand_ins, &format!("{figure} {kind}"), first, ends, index)
            };
            let cells = [
                varied(paper, figure, None, ends, index),
                of("track", Some("straight")),
                of("track", Some("straight-german")),
                of("friction", None),
                of("bare", None),
                of("centre", None),
            ];
            let index = match *index {
                "sperling_vertical" => "Wzz",
                "sperling_lateral" => "Wzy",
                "sperling_lateral_first" => "Wzy, middle",
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
saturates early lets the body bounce. Without waves above 30 m the index rises with C, and with Vr in the middle of the body.

**12c: the change in the middle of the body has the published size.** Over the bogies it is larger, because the dampers also
resist pitch.

**12d: above 2.5 mm** the index over the bogies keeps rising, because our dampers move further than that on class 6. [Out of
service](out-of-service.md) continues to 12 mm, where a damper has hardly any effect.

**15a, 15b, vertical index: the measurement point is decisive.** Lateral dampers cause no vertical motion on the centre line of a symmetric
vehicle; the coupling that the paper reports is roll. At points 1 m to the side of the pivots, as in the rules for coaches, the
vertical index rises with C and Vr of the lateral dampers; on the middle line it does not.

**15b, lateral index:** it keeps rising above 0.05 m/s, because the stand-in's lateral dampers move faster than that.

**15d:** the paper reports a slight fall. In the middle of the body it falls, over the bogies it does not.

**17d is not reproduced:** {} % instead of +9.28 %. With friction 0.2 and 0.4 it is {} and {} %; at 80 and 90 km/h {} and {} %; with the stops 20 mm
further out {} %; in curves of 300 m and 600 m at 70 km/h {} and {} %; with a normal damping of 0.1, 1 and 5 s/m {}, {} and {} %; on rigid
rails with 1 and 5 s/m {} and {} %; without yaw dampers {} %. A lateral damper exerts at most C Vr, 6.3 kN.
The two of a bogie therefore exert at most 12.6 kN and, 1 m ahead of and behind its middle, a moment of at most 12.6 kN m; both have
a mean of zero. The curve requires about 100 kN, so steering determines Y/Q. A play of 1.5 mm changes the fluctuation of Y/Q, not its root mean square.
The maxima change in the published direction: the maximum over all wheels of Y/Q,
averaged over 2 m, changes by {} % at 2 mm and {} % at 3 mm.
",
        of_row(compared, "17d", "RMS_Dc"),
        of_17d("17d friction", Some("0.2")),
        of_17d("17d friction", Some("0.4")),
        of_17d("17d speed", Some("80")),
        of_17d("17d speed", Some("90")),
        of_17d("17d stops", None),
        of_17d("17d radius", Some("curve-r300")),
        of_17d("17d radius", Some("curve-r600")),
        of_17d("17d damping", Some("0.1")),
        of_17d("17d damping", Some("1")),
        of_17d("17d damping", Some("5")),
        of_17d("17d rigid", Some("1")),
        of_17d("17d rigid", Some("5")),
        of_17d("17d bare", None),
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
