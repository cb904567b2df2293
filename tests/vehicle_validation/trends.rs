//! Compares each row of `vehicle_trends.csv` with ours.

use dashpot::document;
use dashpot_study::sweep::Estimate;
use serde::Deserialize;

use crate::claim::{Claim, Verdict, flat};
use crate::rows::{Kept, interval, percent};

/// A row of the published trends.
#[derive(Debug, Clone, Deserialize)]
pub struct Trend {
    pub figure: String,
    pub damper: String,
    pub swept: String,
    pub from: Option<f64>,
    pub to: Option<f64>,
    pub unit: String,
    pub observed: String,
    pub published_change: String,
}

/// A claim about a trend, compared with our result.
pub struct Compared {
    pub trend: Trend,
    /// Published name of the index.
    pub observed: String,
    /// The claim and its range.
    pub range: String,
    pub claim: Claim,
    pub change: Estimate,
    pub verdict: Verdict,
}

/// The published rows.
pub fn published() -> Vec<Trend> {
    let path = document::in_repository("data/published/vehicle_trends.csv");
    let mut reader = csv::Reader::from_path(path).expect("the published trends");
    reader
        .deserialize()
        .map(|row| row.expect("a trend"))
        .collect()
}

/// Our name for a published index.
pub fn index(published: &str) -> &'static str {
    match published {
        "Wzz" => "sperling_vertical",
        "Wzy" => "sperling_lateral",
        "RMS_Dc" => "derailment_rms",
        "RMS_Wn" => "wear_number_rms_n",
        "RMS_Fy" => "lateral_force_rms_n",
        "RMS_Ay" => "body_lateral_rms_m_per_s2",
        other => panic!("no index `{other}`"),
    }
}

fn in_si(value: f64, unit: &str) -> f64 {
    let factor = match unit {
        "kN s/m" => 1e3,
        "m/s" => 1.0,
        "MN/m" => 1e6,
        "mm" => 1e-3,
        other => panic!("no unit `{other}`"),
    };
    value * factor
}

/// Compares every claim of every row with our change over the same range.
pub fn compare(paper: &Kept) -> Vec<Compared> {
    let mut all = Vec::new();
    for trend in published() {
        for observed in trend.observed.split(' ') {
            // The row of 15b repeats the claims of 12a and 12b.
            let words = match trend.published_change.as_str() {
                "same trend as Fig. 12a" => "rises",
                "same trend as Fig. 12b" => "rises and is flat above 0.05 m/s",
                words => words,
            };
            let trend = Trend {
                published_change: words.to_owned(),
                ..trend.clone()
            };
            for claim in Claim::parse(words) {
                all.push(of_claim(paper, &trend, observed, claim));
            }
        }
    }
    all
}

fn of_claim(paper: &Kept, trend: &Trend, observed: &str, claim: Claim) -> Compared {
    let (Some(from), Some(to)) = (trend.from, trend.to) else {
        return of_all(paper, trend, observed, claim);
    };
    let index = index(observed);
    let sweep = paper.sweep(&trend.figure);
    // A claim with `... above X` splits the range at X.
    let above = trend.published_change.split(" above ").nth(1).map(|rest| {
        let number = rest
            .split(' ')
            .next()
            .and_then(|word| word.parse::<f64>().ok());
        number.expect("a number")
    });
    let last = sweep.axes[0].values.last().map(ToString::to_string);
    let last = last
        .and_then(|text| text.parse::<f64>().ok())
        .expect("numbers");
    let in_unit = |value: f64| in_si(value, &trend.unit);
    let [low, high] = match (claim, above) {
        (Claim::Flat, Some(above)) => [in_unit(above), last],
        (_, Some(above)) => [in_unit(from), in_unit(above.min(to))],
        (_, None) => [in_unit(from), in_unit(to)],
    };
    let points = [low, high].map(|value| paper.point(sweep, None, value));
    let change = match claim {
        Claim::Limited => Estimate {
            mean: paper.range(sweep, index),
            confidence: None,
            count: 0,
        },
        _ => paper.change(sweep, points, index),
    };
    let verdict = match (claim, above) {
        (Claim::Flat, Some(above)) => {
            let ends = [in_unit(from), in_unit(above)];
            let points = ends.map(|value| paper.point(sweep, None, value));
            let before = paper.change(sweep, points, index).mean / (ends[1] - ends[0]);
            let length = high - low;
            let half = change.confidence.unwrap_or(0.0) / length;
            flat(before, change.mean / length, half)
        }
        _ => claim.verdict(&change),
    };
    let scale = 1.0 / in_unit(1.0);
    let round = |value: f64| (1e6 * value * scale).round() / 1e6;
    Compared {
        trend: trend.clone(),
        observed: observed.to_owned(),
        range: format!("{} to {} {}", round(low), round(high), trend.unit),
        verdict,
        claim,
        change,
    }
}

/// Compares a claim about all parameters of a figure with the largest range among them.
fn of_all(paper: &Kept, trend: &Trend, observed: &str, claim: Claim) -> Compared {
    let index = index(observed);
    let sweeps = ["a", "b", "c", "d"].map(|part| format!("{}{part}", trend.figure));
    let ranges = sweeps.map(|name| paper.range(paper.sweep(&name), index));
    let change = Estimate {
        mean: ranges.into_iter().fold(0.0, f64::max),
        confidence: None,
        count: 0,
    };
    Compared {
        trend: trend.clone(),
        observed: observed.to_owned(),
        range: "C, Vr, Ke, 2a".into(),
        verdict: claim.verdict(&change),
        claim,
        change,
    }
}

/// The table of all rows.
pub fn table(compared: &[Compared]) -> String {
    let mut text = String::from(
        "| Fig. | dampers | varied | index | published | ours, % | |\n|---|---|---|---|---|---|---|\n",
    );
    for row in compared {
        let Trend {
            figure,
            damper,
            swept,
            published_change,
            ..
        } = &row.trend;
        let ours = match row.claim {
            Claim::Limited => format!("range {:.2}", row.change.mean),
            _ if row.change.confidence.is_none() => format!("range {:.2}", row.change.mean),
            _ => percent(&row.change),
        };
        let verdict = match (row.claim, row.verdict) {
            (Claim::By(published), Verdict::Holds) => {
                let [low, high] = interval(&row.change);
                let times = row.change.mean / published;
                if (low..=high).contains(&published) {
                    "holds, and its size".to_owned()
                } else {
                    format!("direction holds, {times:.1} times as much")
                }
            }
            (_, verdict) => verdict.words().to_owned(),
        };
        let claimed = published_change.split(" and ");
        let claimed = match (claimed.clone().nth(1), row.claim) {
            (Some(second), Claim::Flat) => second,
            _ => claimed.clone().next().unwrap_or_default(),
        };
        let index = &row.observed;
        let what = match row.trend.from {
            Some(_) => format!("{swept} {}", row.range),
            None => row.range.clone(),
        };
        text.push_str(&format!(
            "| {figure} | {damper} | {what} | {index} | {claimed} | {ours} | {} |\n",
            verdict
        ));
    }
    text
}
