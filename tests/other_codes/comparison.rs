//! Runs of the coach GZ18 by Dashpot and by ORVD: differences within bounds, and the table of docs/other-codes.md.

use std::fmt::Write;
use std::sync::OnceLock;

use dashpot::document;

use crate::figure;
use crate::histories::Histories;

/// Speeds of the runs, km/h.
const SPEEDS_KM_H: [u32; 2] = [60, 120];
const PAGE: &str = "docs/other-codes.md";

/// Bounds of a quantity at both speeds.
struct Bounds {
    /// Largest root mean square of the difference.
    difference: [f64; 2],
    /// Smallest correlation.
    correlation: [f64; 2],
}

/// A compared quantity: its name with the unit, its digits, its histories, its bounds.
struct Quantity {
    name: &'static str,
    digits: usize,
    histories: fn(&Histories) -> Vec<&[f64]>,
    /// Only rows in which the first wheelset is no further from the middle of the rails are compared, mm.
    within_mm: f64,
    bounds: Bounds,
}

const QUANTITIES: [Quantity; 5] = [
    Quantity {
        name: "lateral displacement of a wheelset, mm",
        digits: 3,
        histories: |run| run.lateral_mm.iter().map(Vec::as_slice).collect(),
        within_mm: f64::INFINITY,
        bounds: Bounds {
            difference: [0.19, 0.32],
            correlation: [0.998, 0.996],
        },
    },
    Quantity {
        name: "yaw of a wheelset, mrad",
        digits: 3,
        histories: |run| run.yaw_mrad.iter().map(Vec::as_slice).collect(),
        within_mm: f64::INFINITY,
        bounds: Bounds {
            difference: [0.095, 0.13],
            correlation: [0.994, 0.992],
        },
    },
    Quantity {
        name: "lateral displacement of the body at the rails, mm",
        digits: 3,
        histories: |run| vec![&run.body_lateral_mm],
        within_mm: f64::INFINITY,
        bounds: Bounds {
            difference: [0.15, 0.18],
            correlation: [0.997, 0.997],
        },
    },
    Quantity {
        name: "load of the first right wheel, kN",
        digits: 2,
        histories: |run| vec![&run.load_kn],
        within_mm: f64::INFINITY,
        bounds: Bounds {
            difference: [1.02, 2.05],
            correlation: [0.80, 0.83],
        },
    },
    Quantity {
        name: "load of the first right wheel within 4.5 mm of the middle, kN",
        digits: 2,
        histories: |run| vec![&run.load_kn],
        within_mm: 4.5,
        bounds: Bounds {
            difference: [0.25, 0.45],
            correlation: [0.98, 0.98],
        },
    },
];

/// ORVD's and Dashpot's histories at both speeds.
fn runs() -> &'static [[Histories; 2]; 2] {
    static RUNS: OnceLock<[[Histories; 2]; 2]> = OnceLock::new();
    RUNS.get_or_init(|| {
        SPEEDS_KM_H.map(|speed_km_h| {
            [
                Histories::of_orvd(speed_km_h),
                Histories::of_dashpot(speed_km_h),
            ]
        })
    })
}

/// How two histories differ.
#[derive(Debug)]
struct Difference {
    /// Standard deviation of the first history.
    deviation: f64,
    /// Root mean square of the difference.
    rms: f64,
    /// Largest difference.
    max: f64,
    /// Coefficient of correlation.
    correlation: f64,
}

impl Difference {
    fn between(a: &[f64], b: &[f64]) -> Self {
        assert_eq!(a.len(), b.len());
        let count = a.len() as f64;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
        let (mean_a, mean_b) = (mean(a), mean(b));
        let pairs = || a.iter().zip(b);
        let sum = |value: &dyn Fn((&f64, &f64)) -> f64| pairs().map(value).sum::<f64>();
        let square_a = sum(&|(a, _)| (a - mean_a).powi(2));
        let square_b = sum(&|(_, b)| (b - mean_b).powi(2));
        let product = sum(&|(a, b)| (a - mean_a) * (b - mean_b));
        Self {
            deviation: (square_a / count).sqrt(),
            rms: (sum(&|(a, b)| (a - b).powi(2)) / count).sqrt(),
            max: pairs().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
            correlation: product / (square_a * square_b).sqrt(),
        }
    }
}

fn differences(quantity: &Quantity, [orvd, dashpot]: &[Histories; 2]) -> Vec<Difference> {
    let kept = |values: &[f64]| -> Vec<f64> {
        let rows = values.iter().zip(&dashpot.shift_mm);
        rows.filter(|(_, shift_mm)| shift_mm.abs() <= quantity.within_mm)
            .map(|(value, _)| *value)
            .collect()
    };
    let (orvd, dashpot) = ((quantity.histories)(orvd), (quantity.histories)(dashpot));
    let pairs = orvd.into_iter().zip(dashpot);
    pairs
        .map(|(a, b)| Difference::between(&kept(a), &kept(b)))
        .collect()
}

#[test]
fn a_difference_is_that_of_its_formula() {
    let found = Difference::between(&[0.0, 2.0, 0.0, 2.0], &[0.0, 2.0, 2.0, 4.0]);
    assert_eq!([found.deviation, found.max], [1.0, 2.0]);
    assert!((found.rms - 2.0_f64.sqrt()).abs() < 1e-15);
    assert!((found.correlation - 0.5_f64.sqrt()).abs() < 1e-15);
}

#[test]
fn both_codes_agree_within_the_bounds() {
    for (speed, pair) in runs().iter().enumerate() {
        let [orvd, dashpot] = pair;
        assert_eq!(orvd.time_s.len(), 1001);
        for (a, b) in orvd.time_s.iter().zip(&dashpot.time_s) {
            assert!((a - b).abs() < 1e-9, "{a} and {b} s");
        }
        for quantity in &QUANTITIES {
            for difference in differences(quantity, pair) {
                let context = || {
                    format!(
                        "{}, {} km/h: {difference:?}",
                        quantity.name, SPEEDS_KM_H[speed]
                    )
                };
                assert!(
                    difference.rms < quantity.bounds.difference[speed],
                    "{}",
                    context()
                );
                assert!(
                    difference.correlation > quantity.bounds.correlation[speed],
                    "{}",
                    context()
                );
            }
        }
    }
}

/// The smallest and the largest value, or one of them if both read the same.
fn range(values: impl Iterator<Item = f64> + Clone, digits: usize) -> String {
    let min = format!("{:.digits$}", values.clone().fold(f64::INFINITY, f64::min));
    let max = format!("{:.digits$}", values.fold(f64::NEG_INFINITY, f64::max));
    if min == max {
        min
    } else {
        format!("{min} to {max}")
    }
}

#[test]
fn the_page_has_the_differences() {
    let mut table = "\n| speed, km/h | | ORVD, standard deviation | difference, RMS | largest | correlation |\n\
                     |---|---|---|---|---|---|\n"
        .to_owned();
    for (speed_km_h, pair) in SPEEDS_KM_H.iter().zip(runs()) {
        for quantity in &QUANTITIES {
            let found = differences(quantity, pair);
            let of = |value: fn(&Difference) -> f64, digits| range(found.iter().map(value), digits);
            let _ = writeln!(
                table,
                "| {speed_km_h} | {} | {} | {} | {} | {} |",
                quantity.name,
                of(|found| found.deviation, quantity.digits),
                of(|found| found.rms, quantity.digits),
                of(|found| found.max, quantity.digits),
                of(|found| found.correlation, 4),
            );
        }
    }
    table.push('\n');
    document::compare_part(PAGE, "differences", &table);
}

#[test]
fn the_page_has_the_figure() {
    let [slow, fast] = runs();
    let drawn = figure::draw([("60 km/h", slow), ("120 km/h", fast)]);
    document::compare("docs/other-codes/gz18.svg", &drawn);
}
