//! Comparison with the baseline, and which bogie or damper is worn.

use serde::Serialize;

use super::baseline::Baseline;
use super::factors::Factors;
use super::layout::Layout;
use super::limits::MAX_UNEXPLAINED;

/// Loss of a bogie's damping from which on it is worn.
pub const WORN_LOSS: f64 = 0.15;
/// Deviations by which a worn bogie differs from 1.
const WORN_DEVIATIONS: f64 = 5.0;
/// Deviations by which a bogie as new is above the limit.
const NEW_DEVIATIONS: f64 = 2.0;
/// Deviations by which a damper differs from the others of its bogie to be named.
const NAMED_DEVIATIONS: f64 = 3.0;
/// Deviation of a bogie's and of a damper's ratio from drift of sensors and change of operation.
const DRIFT: [f64; 2] = [0.02, 0.06];

/// Condition of the lateral dampers of a bogie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// Certainly above the limit.
    AsNew,
    /// Neither certainly worn nor certainly as new.
    Undecided,
    /// More than 15 % of the damping are lost, by at least five deviations.
    Worn,
}

/// Lateral damping of a bogie, relative to the baseline.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BogieReading {
    /// Name of the bogie.
    pub bogie: String,
    /// Mean ratio of its dampers (1).
    pub ratio: f64,
    /// Standard deviation of the ratio (1).
    pub deviation: f64,
    /// Condition.
    pub condition: Condition,
    /// The damper that is worn, if one can be named.
    pub damper: Option<String>,
}

/// Force of a damper, relative to the baseline.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DamperReading {
    /// Name of the damper.
    pub damper: String,
    /// Name of its bogie.
    pub bogie: String,
    /// Ratio (1).
    pub ratio: f64,
    /// Standard deviation of the ratio (1).
    pub deviation: f64,
}

/// Factor of springs or yaw dampers, relative to the baseline.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FactorRatio {
    /// Name of the factor.
    pub name: String,
    /// Ratio (1).
    pub ratio: f64,
}

/// Condition of a vehicle's lateral dampers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Assessment {
    /// Front and rear bogie.
    pub bogies: Vec<BogieReading>,
    /// Lateral dampers.
    pub dampers: Vec<DamperReading>,
    /// Springs and yaw dampers.
    pub others: Vec<FactorRatio>,
    /// Median ratio of springs and yaw dampers, by which all others are divided. Below 1, the body is heavier than in
    /// the baseline.
    pub scale: f64,
    /// Seconds of ride used.
    pub seconds: usize,
    /// Seconds left out because the body reached a lateral stop.
    pub seconds_at_stop: usize,
    /// Unexplained share.
    pub unexplained: f64,
    /// True if the balance does not explain the ride: no condition is trustworthy, and each is undecided.
    pub in_doubt: bool,
}

impl Assessment {
    /// Compares the factors of a ride with the baseline, which belongs to the same vehicle and sensors
    /// ([`Baseline::check_for`]).
    pub fn new(layout: &Layout, factors: &Factors, baseline: &Baseline) -> Self {
        let (first, dampers) = (2, layout.dampers.len());
        let ratios = factors
            .values
            .iter()
            .zip(&baseline.factors)
            .map(|(now, base)| now / base);
        let ratios: Vec<f64> = ratios.collect();
        let is_damper = |factor: usize| (first..first + dampers).contains(&factor);
        let others: Vec<usize> = (0..ratios.len())
            .filter(|factor| !is_damper(*factor))
            .collect();
        let scale = median(others.iter().map(|factor| ratios[*factor]).collect());
        let is_explained = (..=MAX_UNEXPLAINED).contains(&factors.unexplained) && scale > 0.0;
        let in_doubt = !is_explained;
        // Ratio of a mean of dampers, and its deviation.
        let mean = |of: &[usize], drift: f64| {
            let of: Vec<usize> = of.iter().map(|damper| first + damper).collect();
            let sum = |values: &[f64]| of.iter().map(|factor| values[*factor]).sum::<f64>();
            let variance = |covariance: &[Vec<f64>]| {
                let pairs = of
                    .iter()
                    .flat_map(|row| of.iter().map(move |column| (row, column)));
                pairs
                    .map(|(row, column)| covariance[*row][*column])
                    .sum::<f64>()
            };
            let reference = sum(&baseline.factors);
            let ratio = sum(&factors.values) / reference / scale;
            let own = variance(&factors.covariance) / (scale * scale);
            let base = ratio * ratio * variance(&baseline.covariance);
            (
                ratio,
                ((own + base) / (reference * reference) + drift * drift).sqrt(),
            )
        };
        let name = |bogie: usize| layout.bodies[1 + bogie].name.clone();
        let each = layout.dampers.iter().enumerate().map(|(number, damper)| {
            let (ratio, deviation) = mean(&[number], DRIFT[1]);
            DamperReading {
                damper: damper.name.clone(),
                bogie: name(damper.bogie),
                ratio,
                deviation,
            }
        });
        let each: Vec<DamperReading> = each.collect();
        let bogies = [0, 1].map(|bogie| {
            let of = (0..dampers).filter(|damper| layout.dampers[*damper].bogie == bogie);
            let of: Vec<usize> = of.collect();
            let (ratio, deviation) = mean(&of, DRIFT[0]);
            let condition = match in_doubt {
                true => Condition::Undecided,
                false => condition(ratio, deviation),
            };
            let worst = match condition {
                Condition::Worn => worst(&each, &of),
                _ => None,
            };
            BogieReading {
                bogie: name(bogie),
                ratio,
                deviation,
                condition,
                damper: worst.map(|worst| each[worst].damper.clone()),
            }
        });
        Self {
            bogies: bogies.into(),
            dampers: each,
            others: others
                .iter()
                .map(|factor| FactorRatio {
                    name: factors.names[*factor].clone(),
                    ratio: ratios[*factor] / scale,
                })
                .collect(),
            scale,
            seconds: factors.seconds,
            seconds_at_stop: factors.seconds_at_stop,
            unexplained: factors.unexplained,
            in_doubt,
        }
    }
}

fn condition(ratio: f64, deviation: f64) -> Condition {
    let limit = 1.0 - WORN_LOSS;
    if ratio < 1.0 - WORN_LOSS.max(WORN_DEVIATIONS * deviation) {
        Condition::Worn
    } else if ratio - NEW_DEVIATIONS * deviation >= limit {
        Condition::AsNew
    } else {
        Condition::Undecided
    }
}

/// Returns the damper that has less force than each other of its bogie by three deviations of both.
fn worst(each: &[DamperReading], of: &[usize]) -> Option<usize> {
    let worst = *of
        .iter()
        .min_by(|one, other| each[**one].ratio.total_cmp(&each[**other].ratio))?;
    let is_apart = |other: &usize| {
        let deviation = each[worst].deviation.hypot(each[*other].deviation);
        *other == worst || each[*other].ratio - each[worst].ratio > NAMED_DEVIATIONS * deviation
    };
    (of.len() > 1 && of.iter().all(is_apart)).then_some(worst)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() % 2 {
        _ if values.is_empty() => 1.0,
        0 => 0.5 * (values[middle - 1] + values[middle]),
        _ => values[middle],
    }
}
