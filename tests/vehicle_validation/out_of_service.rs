//! Text of `docs/out-of-service.md`.

use dashpot_files::study::{Sweep, Value};

use xtask::vehicle_validation::SEEDS;

use crate::rows::{Kept, early_endings, percent};

/// Maximum degradation of the ride index, relative to a new damper (%).
const WORSE_PERCENT: f64 = 5.0;

/// Values of the first axis.
fn abscissas(sweep: &Sweep) -> Vec<f64> {
    let number = |value: &Value| match value {
        Value::Number(number) => *number,
        Value::Word(word) => panic!("a number: {word}"),
    };
    sweep.axes[0].values.iter().map(number).collect()
}

/// Abscissa at which a piecewise linear curve, followed from `start`, first reaches a level; `None` if it does not.
fn crossing(x: &[f64], y: &[f64], start: usize, level: f64) -> Option<f64> {
    let upwards = (start..x.len()).collect::<Vec<_>>();
    let downwards = (0..=start).rev().collect::<Vec<_>>();
    [upwards, downwards].iter().find_map(|way| {
        way.windows(2).find_map(|pair| {
            let [a, b] = [pair[0], pair[1]];
            let crosses = y[a] < level && y[b] >= level;
            crosses.then(|| x[a] + (x[b] - x[a]) * (level - y[a]) / (y[b] - y[a]))
        })
    })
}

/// A sweep over a wearing parameter.
struct Wear<'a> {
    kept: &'a Kept,
    sweep: &'a Sweep,
    /// Index of the point of a new damper.
    new: usize,
}

impl<'a> Wear<'a> {
    fn of(kept: &'a Kept, sweep: &str, new: f64) -> Self {
        let sweep = kept.sweep(sweep);
        let new = kept.point(sweep, None, new) as usize;
        Self { kept, sweep, new }
    }

    fn change(&self, point: usize, index: &str) -> dashpot_study::sweep::Estimate {
        let points = [self.new as u64, point as u64];
        self.kept.change(self.sweep, points, index)
    }

    /// Parameter values at which an index has degraded by a given amount: for its mean and for the ends of its
    /// confidence interval.
    fn limit(&self, index: &str) -> [Option<f64>; 3] {
        let x = abscissas(self.sweep);
        [0.0, 1.0, -1.0].map(|side| {
            let at = |point: usize| {
                let change = self.change(point, index);
                change.mean + side * change.confidence.unwrap_or(0.0)
            };
            let y: Vec<f64> = (0..x.len()).map(at).collect();
            crossing(&x, &y, self.new, WORSE_PERCENT)
        })
    }
}

fn at(limit: Option<f64>, factor: f64, digits: usize, unit: &str) -> String {
    limit.map_or_else(
        || "not reached".into(),
        |limit| format!("{:.digits$} {unit}", limit * factor),
    )
}

/// Formats a limit with the limits for both ends of the confidence interval, in ascending order.
fn between([mean, high, low]: [Option<f64>; 3], factor: f64, digits: usize, unit: &str) -> String {
    let ends = match (high, low) {
        (Some(a), Some(b)) => {
            let (a, b) = (a.min(b) * factor, a.max(b) * factor);
            format!(" ({a:.digits$} to {b:.digits$})")
        }
        (Some(a), None) => format!(" ({:.digits$} or not at all)", a * factor),
        _ => String::new(),
    };
    at(mean, factor, digits, unit) + &ends
}

/// Share of the seeds whose index is above 1, as `x of y`.
fn above_limit(kept: &Kept, sweep: &str, value: f64, index: &str) -> String {
    let sweep = kept.sweep(sweep);
    let values = kept.values(sweep, kept.point(sweep, None, value), index);
    let values: Vec<f64> = values.into_iter().flatten().collect();
    let above = values.iter().filter(|value| **value > 1.0).count();
    format!("{above} of {}", values.len())
}

/// The whole document.
pub fn text(kept: &Kept) -> String {
    let wear = |sweep: &str, new: f64| Wear::of(kept, sweep, new);
    let clearance = |sweep: &str| wear(sweep, 0.5e-3);
    let change_at = |sweep: &str, new: f64, value: f64, index: &str| {
        let wear = wear(sweep, new);
        let point = kept.point(wear.sweep, None, value) as usize;
        percent(&wear.change(point, index))
    };
    let loose = |sweep: &str, mm: f64, index: &str| change_at(sweep, 0.5e-3, mm * 1e-3, index);
    let (vertical, lateral) = ("sperling_vertical", "sperling_lateral");
    let middle = "sperling_vertical_first";
    let mm = |sweep: &str, index: &str| between(clearance(sweep).limit(index), 1e3, 1, "mm");
    let mn = |sweep: &str, new: f64, index: &str| {
        between(wear(sweep, new).limit(index), 1e-6, 1, "MN/m")
    };
    let cold = between(wear("temperature", 20.0).limit(vertical), 1.0, 0, "°C");
    let both = {
        let sweep = kept.sweep("both");
        let first = sweep.points() / 2;
        let together = kept.point(sweep, Some("3000000"), 2e-3);
        let alone = [first, kept.point(sweep, Some("8000000"), 2e-3), together];
        alone.map(|point| percent(&kept.change(sweep, [0, point], vertical)))
    };
    let early = early_endings(&[kept]);
    let new_values = kept.values(kept.sweep("vertical clearance"), 0, vertical);
    let new_values: Vec<f64> = new_values.into_iter().flatten().collect();
    let mean = new_values.iter().sum::<f64>() / new_values.len() as f64;
    let square = |value: &f64| (value - mean).powi(2);
    let variance = new_values.iter().map(square).sum::<f64>() / (new_values.len() - 1) as f64;
    let scatter = 100.0 * variance.sqrt() / mean;
    // The means of two sets of n windows differ by chance by up to 1.96 sd sqrt(2/n) with 95 % probability; a true
    // change that exceeds this by 0.84 sd sqrt(2/n) is found in 80 % of cases.
    let windows = (2.0 * ((1.96 + 0.84) * scatter / WORSE_PERCENT).powi(2)).ceil();
    let tables: String = [
        ("vertical clearance", 0.5e-3, 1e3, "2a, mm"),
        ("vertical stiffness", 8e6, 1e-6, "Ke, MN/m"),
        ("front clearance", 0.5e-3, 1e3, "2a, mm"),
        ("rear clearance", 0.5e-3, 1e3, "2a, mm"),
        ("one clearance", 0.5e-3, 1e3, "2a, mm"),
        ("one stiffness", 8e6, 1e-6, "Ke, MN/m"),
        ("lateral clearance", 0.5e-3, 1e3, "2a, mm"),
        ("lateral stiffness", 7e6, 1e-6, "Ke, MN/m"),
        ("one lateral clearance", 0.5e-3, 1e3, "2a, mm"),
        ("yaw clearance", 0.0, 1e3, "2a, mm"),
        ("yaw stiffness", 12e6, 1e-6, "Ke, MN/m"),
        ("one yaw clearance", 0.0, 1e3, "2a, mm"),
        ("temperature", 20.0, 1.0, "oil, °C"),
    ]
    .map(|(sweep, new, factor, label)| table(&wear(sweep, new), factor, label))
    .concat();
    let prudhomme =
        |sweep: &str, value: f64| above_limit(kept, sweep, value, "lateral_force_over_limit");
    let yaw = |sweep: &str, value: f64, index: &str| {
        let new = if sweep.ends_with("clearance") {
            0.0
        } else {
            12e6
        };
        change_at(sweep, new, value, index)
    };
    let nadal = |sweep: &str, value: f64| above_limit(kept, sweep, value, "derailment_over_nadal");
    format!(
        "# When should a damper be taken out of service?

**Result.** A vertical damper is worn out for the ride when all of them have {} of play or are softer than {}; a single one is
not felt. Yaw dampers decide the safety: with 2 mm of play in all of them the lateral force exceeds its limit in {} runs, with
4 mm in {}, as new in {}, and at 220 km/h the locomotive hunts.

`cargo xtask vehicle-validation` writes this page from the {} runs in `data/studies/rows/out-of-service.csv`. `dashpot sweep
out-of-service` draws the figures over 8 seeds. The ride is computed on straight track of class 6 at 180 km/h for 5 s, with seeds
1 to {SEEDS}; hunting is computed on ideal track after a push to the flange. The vehicle is the public
stand-in of [the validation](vehicle-validation.md). Other vehicles have other limits, so run the study with yours (`vehicle = \"...\"`).
{early}

A damper as new has a clearance 2a of 0.5 mm (yaw dampers none), an effective stiffness Ke of 8 MN/m (lateral 7 MN/m, yaw 12 MN/m), and oil at 20 °C. Our criterion is a **ride**
{WORSE_PERCENT} % worse than new (Sperling's index, maximum of three points; {WORSE_PERCENT} % correspond to 18 % more acceleration). Brackets contain
the limits for the two ends of the index's confidence interval. Each limit is for a single fault.

| dampers | fault | ride {WORSE_PERCENT} % worse |
|---|---|---|
| all vertical | clearance above | {} |
| all vertical | effective stiffness below | {} |
| all vertical | oil colder than | {cold} |
| vertical of the rear bogie | clearance above | {} |
| vertical of the front bogie | clearance above | {} |
| one vertical | clearance above | {} |
| all lateral | clearance above | {} |
| all lateral | effective stiffness below | {} |

- **Wear of vertical dampers affects the ride.** A soft damper (air in the oil, perished rubber) matters as much as a loose mount,
  and the effects add up: 3 MN/m alone {} %, 2 mm alone {} %, together {} %. If both faults are present, the limits above
  are too wide.
- **A single worn vertical damper is not felt:** {} % at 12 mm, {} % at 0.25 MN/m. Only an inspection or its own force reveals it.
- **A bogie with all vertical dampers loose** changes the maximum of the index over the points by {} % (rear, 12 mm) or {} % (front), and the
  middle by {} and {} %. The rougher rear masks a worn front bogie in the maximum, so compare the point above each bogie.
- **The index scatters from track to track:** by {scatter:.1} % between windows of 5 s (standard deviation over the seeds). Detecting a change of {WORSE_PERCENT} %
  in eight of ten cases, with one false alarm in twenty, takes {windows:.0} windows before the change and the same number after it; a single record of 5 s is not sufficient. The intervals here are
  narrow only because both runs have the same irregularities.
- **Wear of lateral dampers affects the wheels, not the ride.** At 12 mm the lateral index changes by {} %, the leading
  wheelset's Y/Q (rms) by {} % and its lateral force (rms) by {} %; at 0.25 MN/m these change by {}, {} and {} %. The maximum of
  Y/Q exceeds Nadal's limit in {} runs as new, in {} at 12 mm, and in {} at 0.25 MN/m.
- **Yaw dampers keep the wheels within their limits.** With 2 mm of play in all of them the lateral force changes by {} % and Y/Q (both
  maxima) by {} %, with 4 mm by {} and {} %; with ends of 4 MN/m by {} and {} %. One dead yaw damper of eight (12 mm) changes
  the lateral force by {} %.
- **Play permits hunting** (tables below): with play in the yaw dampers the wheelsets move by more than half of it at 220 km/h and
  strike the flanges at higher speed, even if the vehicle as new is stable to 340 km/h. Play in the lateral dampers matters only at
  340 km/h. Choose the permitted play for the maximum speed, with a margin.
- **A single worn lateral damper** changes the lateral ride by {} % and Y/Q (rms) by {} % at 12 mm.
- **Cold oil is not wear.** Below {} the ride is {WORSE_PERCENT} % worse than at 20 °C, and it recovers as the oil warms: measure with warm oil.

## Ride and wheel forces

The row of the new condition gives values; the other rows give changes from it in percent, with 95 % confidence intervals. Columns:
vertical ride index (maximum of the points; middle) and lateral ride index (maximum); rms of Y/Q and of the lateral force of the
leading wheelset; maxima over all wheels of means over 2 m: Y/Q relative to Nadal's limit, lateral force relative to Prud'homme's
limit, filtered wheel load relative to the limit of EN 14363, unloading.

{tables}
## Hunting

{}",
        at(clearance("vertical clearance").limit(vertical)[0], 1e3, 1, "mm"),
        at(wear("vertical stiffness", 8e6).limit(vertical)[0], 1e-6, 1, "MN/m"),
        prudhomme("yaw clearance", 2e-3),
        prudhomme("yaw clearance", 4e-3),
        prudhomme("yaw clearance", 0.0),
        kept.study.cases(),
        mm("vertical clearance", vertical),
        mn("vertical stiffness", 8e6, vertical),
        mm("rear clearance", vertical),
        mm("front clearance", vertical),
        mm("one clearance", vertical),
        mm("lateral clearance", lateral),
        mn("lateral stiffness", 7e6, lateral),
        both[0],
        both[1],
        both[2],
        loose("one clearance", 12.0, vertical),
        change_at("one stiffness", 8e6, 0.25e6, vertical),
        loose("rear clearance", 12.0, vertical),
        loose("front clearance", 12.0, vertical),
        loose("rear clearance", 12.0, middle),
        loose("front clearance", 12.0, middle),
        loose("lateral clearance", 12.0, lateral),
        loose("lateral clearance", 12.0, "derailment_rms"),
        loose("lateral clearance", 12.0, "lateral_force_rms_n"),
        change_at("lateral stiffness", 7e6, 0.25e6, lateral),
        change_at("lateral stiffness", 7e6, 0.25e6, "derailment_rms"),
        change_at("lateral stiffness", 7e6, 0.25e6, "lateral_force_rms_n"),
        nadal("lateral clearance", 0.5e-3),
        nadal("lateral clearance", 12e-3),
        nadal("lateral stiffness", 0.25e6),
        yaw("yaw clearance", 2e-3, "lateral_force_over_limit"),
        yaw("yaw clearance", 2e-3, "derailment_over_nadal"),
        yaw("yaw clearance", 4e-3, "lateral_force_over_limit"),
        yaw("yaw clearance", 4e-3, "derailment_over_nadal"),
        yaw("yaw stiffness", 4e6, "lateral_force_over_limit"),
        yaw("yaw stiffness", 4e6, "derailment_over_nadal"),
        yaw("one yaw clearance", 12e-3, "lateral_force_over_limit"),
        loose("one lateral clearance", 12.0, lateral),
        loose("one lateral clearance", 12.0, "derailment_rms"),
        at(wear("temperature", 20.0).limit(vertical)[0], 1.0, 0, "°C"),
        hunting_table(kept),
    )
}

fn table(wear: &Wear<'_>, factor: f64, label: &str) -> String {
    let indices = [
        "sperling_vertical",
        "sperling_vertical_first",
        "sperling_lateral",
        "derailment_rms",
        "lateral_force_rms_n",
        "derailment_over_nadal",
        "lateral_force_over_limit",
        "wheel_load_over_limit",
        "unloading_greatest",
    ];
    let mut text = format!(
        "**{}**\n\n| {label} | vertical | middle | lateral | Y/Q, rms | lateral force, rms | Y/Q over Nadal | over \
         Prud'homme | Q over limit | unloading |\n|---|---|---|---|---|---|---|---|---|---|\n",
        wear.sweep.title
    );
    for (point, x) in abscissas(wear.sweep).iter().enumerate() {
        let cells = indices.map(|index| match point == wear.new {
            true => {
                let mean = wear.kept.mean(wear.sweep, point as u64, index).mean;
                if index.ends_with("_n") {
                    format!("{:.1} kN", 1e-3 * mean)
                } else {
                    format!("{mean:.3}")
                }
            }
            false => percent(&wear.change(point, index)),
        });
        let x = (1e6 * x * factor).round() / 1e6;
        text.push_str(&format!("| {x} | {} |\n", cells.join(" | ")));
    }
    text + "\n"
}

fn hunting_table(kept: &Kept) -> String {
    let mut text = String::from(
        "Maximum lateral displacement of a wheelset in the last 3 s of 18 s, mm, by speed and by clearance or \
         effective stiffness of the
lateral dampers, then of the yaw dampers.\n\n",
    );
    for (name, factor, label) in [
        ("hunting clearance", 1e3, "2a, mm"),
        ("hunting stiffness", 1e-6, "Ke, MN/m"),
        ("hunting yaw clearance", 1e3, "2a of yaw dampers, mm"),
        ("hunting yaw stiffness", 1e-6, "Ke of yaw dampers, MN/m"),
    ] {
        let sweep = kept.sweep(name);
        let x = abscissas(sweep);
        let speeds: Vec<String> = sweep.axes[1]
            .values
            .iter()
            .map(ToString::to_string)
            .collect();
        text.push_str(&format!(
            "| {label} | {} |\n|---|{}\n",
            speeds
                .iter()
                .map(|speed| format!("{speed} km/h"))
                .collect::<Vec<_>>()
                .join(" | "),
            "---|".repeat(speeds.len())
        ));
        for (row, x) in x.iter().enumerate() {
            let amplitude = |column: usize| {
                let point = (row * speeds.len() + column) as u64;
                format!(
                    "{:.2}",
                    1e3 * kept.mean(sweep, point, "last_lateral_m").mean
                )
            };
            let cells: Vec<String> = (0..speeds.len()).map(amplitude).collect();
            let x = (1e6 * x * factor).round() / 1e6;
            text.push_str(&format!("| {x} | {} |\n", cells.join(" | ")));
        }
        text.push('\n');
    }
    text.trim_end().to_owned() + "\n"
}

#[test]
fn a_crossing_is_found_on_either_side_of_new() {
    let x = [0.0, 1.0, 2.0, 3.0];
    assert_eq!(crossing(&x, &[0.0, 2.0, 6.0, 7.0], 0, 5.0), Some(1.75));
    assert_eq!(crossing(&x, &[9.0, 4.0, 1.0, 0.0], 3, 5.0), Some(0.8));
    assert_eq!(crossing(&x, &[0.0, 2.0, 3.0, 4.0], 0, 5.0), None);
}
