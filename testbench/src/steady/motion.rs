//! Cycles sorted into steady motions.

use std::ops::Range;

use super::cycles::{FittedCycle, Signals, at};
use super::{Found, MIN_CYCLES, SteadyMotion, Unused, UnusedCycles};
use crate::bench_test::Cycle;
use dashpot_files::harmonic::Harmonic;

/// Cycles belong to one motion if amplitude and period differ from the mean of those before by at most this share.
const SAME_MOTION: f64 = 0.02;

/// A displacement is steady if its rms difference from the reference is at most this share of the reference's rms.
const STEADY_DISPLACEMENT: f64 = 0.005;

/// The same for a force.
const STEADY_FORCE: f64 = 0.02;

/// A signal is also steady if it differs by at most this many times the difference that is usual among the cycles of
/// the reference.
const STEADY_IN_USUAL: f64 = 3.0;

/// Range of the samples of a mean loop.
const LOOP_SAMPLES: std::ops::RangeInclusive<f64> = 100.0..=2000.0;

/// Fits after the first; each reduces the error of the period by more than ten.
const REFITS: usize = 3;

/// Largest gap between the end of a cycle and the start of the next of the same motion, as a share of the period.
const ADJACENT_SHARE: f64 = 0.05;

/// Sorts cycles, in the order of time, into steady motions and others.
pub(super) fn sort(signals: &Signals, cycles: &[FittedCycle], found: &mut Found) {
    let mut rest = cycles;
    while let Some(first) = rest.first() {
        let problem = signals.problem(first);
        let count = match problem {
            Some(_) => rest
                .iter()
                .take_while(|cycle| signals.problem(cycle) == problem)
                .count(),
            None => same_motion(signals, rest),
        };
        let (group, later) = rest.split_at(count);
        rest = later;
        let reason = match problem {
            Some(reason) => reason,
            None => match steady(signals, group) {
                Some(motion) => {
                    found.motions.push(motion);
                    continue;
                }
                None => Unused::FewCycles,
            },
        };
        found.unused.push(unused(signals, group, reason));
    }
}

/// Returns how many cycles at the beginning have one motion.
fn same_motion(signals: &Signals, cycles: &[FittedCycle]) -> usize {
    let (mut amplitudes, mut periods) = (0.0, 0.0);
    for (count, cycle) in cycles.iter().enumerate() {
        let means = |sum: f64| sum / count as f64;
        let is_same = |value: f64, sum: f64| (value / means(sum) - 1.0).abs() <= SAME_MOTION;
        let is_adjacent = |before: &FittedCycle| {
            (before.start + before.period - cycle.start).abs() <= ADJACENT_SHARE * cycle.period
        };
        let continues = count == 0
            || signals.problem(cycle).is_none()
                && is_same(cycle.amplitude_m, amplitudes)
                && is_same(cycle.period, periods)
                && is_adjacent(&cycles[count - 1]);
        if !continues {
            return count;
        }
        amplitudes += cycle.amplitude_m;
        periods += cycle.period;
    }
    cycles.len()
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

fn unused(signals: &Signals, cycles: &[FittedCycle], reason: Unused) -> UnusedCycles {
    let of = |value: fn(&FittedCycle) -> f64| mean(cycles.iter().map(value));
    UnusedCycles {
        start_s: signals.start_s + cycles[0].start.max(0.0) * signals.tick_s,
        cycles: cycles.len(),
        amplitude_m: of(|cycle| cycle.amplitude_m),
        frequency_hz: 1.0 / (of(|cycle| cycle.period) * signals.tick_s),
        reason,
    }
}

/// Returns the steady motion of cycles with equal amplitude and frequency; `None` for too few with a steady force.
fn steady(signals: &Signals, cycles: &[FittedCycle]) -> Option<SteadyMotion> {
    let last = signals.force.values.len() as f64 - 1.0;
    let cycles = refitted(signals, cycles);
    let is_whole = |cycle: &FittedCycle| cycle.start >= 0.0 && cycle.start + cycle.period <= last;
    let cycles: Vec<FittedCycle> = cycles.into_iter().filter(is_whole).collect();
    if cycles.len() < MIN_CYCLES {
        return None;
    }
    let samples = cycles[0]
        .period
        .round()
        .clamp(*LOOP_SAMPLES.start(), *LOOP_SAMPLES.end());
    let loops: Vec<Cycle> = cycles
        .iter()
        .map(|cycle| sampled(signals, cycle, samples as usize))
        .collect();
    let kept = steady_cycles(&loops);
    if kept.len() < MIN_CYCLES {
        return None;
    }
    let unsteady_cycles = loops.len() - kept.len();
    let loops = loops[kept.clone()].to_vec();
    let cycles = &cycles[kept];
    let of = |value: fn(&FittedCycle) -> f64| mean(cycles.iter().map(value));
    let time_s = |position: f64| signals.start_s + position * signals.tick_s;
    let last = cycles[cycles.len() - 1];
    Some(SteadyMotion {
        start_s: time_s(cycles[0].start),
        end_s: time_s(last.start + last.period),
        mean: mean_of(&loops),
        offset_m: of(|cycle| cycle.offset_m),
        distortion: of(|cycle| cycle.distortion),
        unsteady_cycles,
        loops,
    })
}

/// Returns the cycles with their common period, the median between the starts of fitted sines. The rises through the
/// middle, from which the first fit has its periods, are early or late where the amplitude changes.
fn refitted(signals: &Signals, cycles: &[FittedCycle]) -> Vec<FittedCycle> {
    let mut cycles = cycles.to_vec();
    for _ in 0..REFITS {
        let periods = cycles.windows(2).map(|pair| pair[1].start - pair[0].start);
        let mut periods: Vec<f64> = periods.collect();
        periods.sort_by(f64::total_cmp);
        let Some(period) = periods.get(periods.len() / 2) else {
            break;
        };
        for cycle in &mut cycles {
            *cycle = signals.fit(cycle.start, *period);
        }
    }
    cycles
}

/// Returns a cycle at `samples` equal fractions of its period, about its middle.
fn sampled(signals: &Signals, cycle: &FittedCycle, samples: usize) -> Cycle {
    let of = |values: &[f64]| {
        let position = |sample: usize| cycle.start + cycle.period * sample as f64 / samples as f64;
        (1..=samples)
            .map(|sample| at(values, position(sample)))
            .collect::<Vec<f64>>()
    };
    let displacements = of(&signals.displacement.values);
    let period_s = cycle.period * signals.tick_s;
    Cycle {
        motion: Harmonic {
            amplitude_m: cycle.amplitude_m,
            frequency_hz: 1.0 / period_s,
        },
        displacements_m: displacements.iter().map(|x| x - cycle.offset_m).collect(),
        forces_n: of(&signals.force.values),
        step_s: period_s / samples as f64,
        cycles: 1,
    }
}

/// Returns the mean of loops with the same number of samples.
pub(super) fn mean_of(loops: &[Cycle]) -> Cycle {
    let samples = loops.first().map_or(0, |cycle| cycle.forces_n.len());
    let count = loops.len() as f64;
    let column = |of: fn(&Cycle) -> &[f64]| {
        let at = |sample| loops.iter().map(|cycle| of(cycle)[sample]).sum::<f64>() / count;
        (0..samples).map(at).collect()
    };
    let step_s = mean(loops.iter().map(|cycle| cycle.step_s));
    Cycle {
        motion: Harmonic {
            amplitude_m: mean(loops.iter().map(|cycle| cycle.motion.amplitude_m)),
            frequency_hz: 1.0 / (step_s * samples as f64),
        },
        displacements_m: column(|cycle| &cycle.displacements_m),
        forces_n: column(|cycle| &cycle.forces_n),
        step_s,
        cycles: loops.len(),
    }
}

/// Returns the cycles between those at both ends that differ from the mean of the second half.
fn steady_cycles(loops: &[Cycle]) -> Range<usize> {
    let reference = mean_of(&loops[loops.len() / 2..]);
    let is_displaced = is_steady(loops, &reference, STEADY_DISPLACEMENT, |cycle| {
        &cycle.displacements_m
    });
    let is_forced = is_steady(loops, &reference, STEADY_FORCE, |cycle| &cycle.forces_n);
    let is_steady = |(displaced, forced): (&bool, &bool)| *displaced && *forced;
    let steady: Vec<bool> = is_displaced.iter().zip(&is_forced).map(is_steady).collect();
    let start = steady.iter().position(|is| *is).unwrap_or(steady.len());
    let end = steady
        .iter()
        .rposition(|is| *is)
        .map_or(start, |last| last + 1);
    start..end
}

/// Returns for each cycle whether one of its signals is that of the reference.
fn is_steady(
    loops: &[Cycle],
    reference: &Cycle,
    share: f64,
    signal: fn(&Cycle) -> &[f64],
) -> Vec<bool> {
    let of_reference = signal(reference);
    let middle = mean(of_reference.iter().copied());
    let rms = mean(of_reference.iter().map(|value| (value - middle).powi(2))).sqrt();
    let difference = |cycle: &Cycle| {
        let pairs = signal(cycle).iter().zip(of_reference);
        mean(pairs.map(|(value, reference)| (value - reference).powi(2))).sqrt()
    };
    let differences: Vec<f64> = loops.iter().map(difference).collect();
    let mut usual = differences[loops.len() / 2..].to_vec();
    usual.sort_by(f64::total_cmp);
    let allowed = (share * rms).max(STEADY_IN_USUAL * usual[usual.len() / 2]);
    differences
        .iter()
        .map(|difference| *difference <= allowed)
        .collect()
}
