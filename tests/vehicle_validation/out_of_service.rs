//! The text of `docs/out-of-service.md`.

use dashpot_hil::files::study::{Sweep, Value};

use crate::rows::{Kept, percent};

/// How much worse than new the ride may be, %.
const WORSE_PERCENT: f64 = 5.0;

/// Amplitude of hunting at 200 km/h that is too much, m.
const HUNTING_M: f64 = 1e-3;

/// Numbers of the first axis.
fn abscissas(sweep: &Sweep) -> Vec<f64> {
    let number = |value: &Value| match value {
        Value::Number(number) => *number,
        Value::Word(word) => panic!("a number: {word}"),
    };
    sweep.axes[0].values.iter().map(number).collect()
}

/// Where a curve first reaches a level on the way from `start`, linear between its points; none where it does not.
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
    /// The point that is as new.
    new: usize,
}

impl<'a> Wear<'a> {
    fn of(kept: &'a Kept, sweep: &str, new: f64) -> Self {
        let sweep = kept.sweep(sweep);
        let new = kept.point(sweep, None, new) as usize;
        Self { kept, sweep, new }
    }

    fn change(&self, point: usize, index: &str) -> dashpot_hil::study::sweep::Estimate {
        let points = [self.new as u64, point as u64];
        self.kept.change(self.sweep, points, index)
    }

    /// Where an index is so much worse than new: by its mean, and by the ends of its confidence interval.
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

    /// Where wheelsets hunt by so much.
    fn hunting_limit(&self) -> Option<f64> {
        let x = abscissas(self.sweep);
        let y: Vec<f64> = (0..x.len())
            .map(|point| {
                self.kept
                    .mean(self.sweep, point as u64, "last_lateral_m")
                    .mean
            })
            .collect();
        crossing(&x, &y, self.new, HUNTING_M)
    }

    /// Greatest change of an index along the sweep.
    fn greatest(&self, index: &str) -> f64 {
        let points = 0..self.sweep.axes[0].values.len();
        let changes = points.map(|point| self.change(point, index).mean);
        changes.fold(0.0, f64::max)
    }
}

fn at(limit: Option<f64>, factor: f64, digits: usize, unit: &str) -> String {
    limit.map_or_else(
        || "not reached".into(),
        |limit| format!("{:.digits$} {unit}", limit * factor),
    )
}

/// A limit with those of the interval's ends in the order of their numbers.
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

/// The whole document.
pub fn text(kept: &Kept) -> String {
    let new = [0.5e-3, 8e6, 20.0];
    let wear = |sweep: &str| {
        let kind = match sweep {
            name if name.ends_with("clearance") => 0,
            name if name.ends_with("stiffness") => 1,
            _ => 2,
        };
        Wear::of(kept, sweep, new[kind])
    };
    let (vertical, lateral) = ("sperling_vertical", "sperling_lateral");
    let mm = |sweep: &str, index: &str| between(wear(sweep).limit(index), 1e3, 1, "mm");
    let mn = |sweep: &str, index: &str| between(wear(sweep).limit(index), 1e-6, 1, "MN/m");
    let hunting = [
        at(wear("hunting clearance").hunting_limit(), 1e3, 1, "mm"),
        at(wear("hunting stiffness").hunting_limit(), 1e-6, 1, "MN/m"),
    ];
    let cold = between(wear("temperature").limit(vertical), 1.0, 0, "°C");
    let one = wear("one clearance").greatest(vertical);
    let one_soft = wear("one stiffness").greatest(vertical);
    let safety = [
        "derailment_over_nadal",
        "lateral_force_over_limit",
        "unloading_greatest",
    ];
    let vertical_safety = safety.map(|index| wear("vertical clearance").greatest(index));
    let lateral_safety = safety.map(|index| wear("lateral clearance").greatest(index));
    let soft_safety = safety.map(|index| wear("lateral stiffness").greatest(index));
    let three = |[a, b, c]: [f64; 3]| format!("{a:.0}, {b:.0} and {c:.0} %");
    let tables: String = [
        ("vertical clearance", 1e3, "2a, mm"),
        ("vertical stiffness", 1e-6, "Ke, MN/m"),
        ("one clearance", 1e3, "2a, mm"),
        ("one stiffness", 1e-6, "Ke, MN/m"),
        ("lateral clearance", 1e3, "2a, mm"),
        ("lateral stiffness", 1e-6, "Ke, MN/m"),
        ("temperature", 1.0, "oil, °C"),
    ]
    .map(|(sweep, factor, label)| table(&wear(sweep), factor, label))
    .concat();
    format!(
        "# When should a damper be taken out of service?

Written by `cargo xtask vehicle-validation` from the rows in `data/studies/rows/out-of-service.csv`, 414 runs; the same with figures: `dashpot sweep
out-of-service`. Straight track of class 6 at 180 km/h, seeds 1 to 8; hunting at 200 km/h on ideal track after a push to the flange. The vehicle is the public
stand-in of [the validation](vehicle-validation.md), so the numbers are its; the order of things is not.

As new: clearance 2a of 0.5 mm, effective stiffness Ke of 8 MN/m, oil at 20 °C. Two criteria, chosen here: **ride** {WORSE_PERCENT} % worse than new (Sperling, greatest of
the points; in brackets where the ends of its confidence interval are), **hunting** of {} mm to each side at 200 km/h that does not die away. An operator who has others reads them off the tables.

| dampers | by | ride | hunting |
|---|---|---|---|
| all vertical | clearance above | {} | - |
| all vertical | effective stiffness below | {} | - |
| all vertical | oil colder than | {cold} | - |
| one vertical alone | clearance | {} | - |
| all lateral | clearance above | {} | {} |
| all lateral | effective stiffness below | {} | {} |

- **Vertical dampers wear into the ride.** Take them out at a clearance of {} or a stiffness of {}, whichever comes first. A soft damper (air in the oil, a perished
  rubber) is as much a reason as a loose seat.
- **One worn damper is not felt.** However loose or soft one of eight becomes, the ride changes by {one:.1} and {one_soft:.1} % at most. A ride measurement finds a bogie whose
  dampers are all worn, not the one that began it: single dampers are found by inspection or by their own force.
- **Lateral dampers wear into stability first.** Their clearance leaves the ride index where it was, and lets the wheelsets hunt: {} is where the amplitude is {} mm.
- **Cold is no wear.** Below {} the ride is as bad as with worn dampers, and better once the oil has warmed: measure warm.
- **Wheel forces**: over all clearances of the vertical dampers Y/Q, lateral force and unloading rise by {} at most, of the lateral ones by {}, at
  0.25 MN/m of the lateral ones by {}. On this track the locomotive without yaw dampers is over Prud'homme's limit even as new, so its share of the limit says less than its change.

## Ride and wheel forces

Change from new in percent with the confidence interval of 95 %; vertical and lateral ride index, Y/Q, lateral force (both greatest means over 2 m), unloading.

{tables}
## Hunting

{}",
        HUNTING_M * 1e3,
        mm("vertical clearance", vertical),
        mn("vertical stiffness", vertical),
        mm("one clearance", vertical),
        mm("lateral clearance", lateral),
        hunting[0],
        mn("lateral stiffness", lateral),
        hunting[1],
        at(wear("vertical clearance").limit(vertical)[0], 1e3, 1, "mm"),
        at(wear("vertical stiffness").limit(vertical)[0], 1e-6, 1, "MN/m"),
        hunting[0],
        HUNTING_M * 1e3,
        at(wear("temperature").limit(vertical)[0], 1.0, 0, "°C"),
        three(vertical_safety),
        three(lateral_safety),
        three(soft_safety),
        hunting_table(kept),
    )
}

fn table(wear: &Wear<'_>, factor: f64, label: &str) -> String {
    let indices = [
        "sperling_vertical",
        "sperling_lateral",
        "derailment_over_nadal",
        "lateral_force_over_limit",
        "unloading_greatest",
    ];
    let mut text = format!(
        "**{}**\n\n| {label} | vertical | lateral | Y/Q | lateral force | unloading |\n|---|---|---|---|---|---|\n",
        wear.sweep.title
    );
    for (point, x) in abscissas(wear.sweep).iter().enumerate() {
        let cells = indices.map(|index| match point == wear.new {
            true => format!(
                "{:.3}",
                wear.kept.mean(wear.sweep, point as u64, index).mean
            ),
            false => percent(&wear.change(point, index)),
        });
        let x = (1e6 * x * factor).round() / 1e6;
        text.push_str(&format!("| {x} | {} |\n", cells.join(" | ")));
    }
    text + "\n"
}

fn hunting_table(kept: &Kept) -> String {
    let mut text = String::from(
        "Greatest lateral displacement of a wheelset in the last 3 of 18 s at 200 km/h, mm, by clearance and by effective stiffness of the lateral dampers.\n\n",
    );
    for (name, factor, label) in [
        ("hunting clearance", 1e3, "2a, mm"),
        ("hunting stiffness", 1e-6, "Ke, MN/m"),
    ] {
        let sweep = kept.sweep(name);
        let x = abscissas(sweep);
        let cells =
            |of: &dyn Fn(usize) -> String| (0..x.len()).map(of).collect::<Vec<_>>().join(" | ");
        let values = cells(&|point| format!("{}", (1e6 * x[point] * factor).round() / 1e6));
        let amplitudes = cells(&|point| {
            let mean = kept.mean(sweep, point as u64, "last_lateral_m").mean;
            format!("{:.2}", mean * 1e3)
        });
        let rule = "---|".repeat(x.len());
        text.push_str(&format!(
            "| {label} | {values} |\n|---|{rule}\n| amplitude | {amplitudes} |\n\n"
        ));
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
