//! Spectra against a table of RMS values, and generated track against spectra and table.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::LazyLock;

use dashpot_rail::track::{Band, Channels, Density, Generation, Seeds, Spectrum};

/// A row of `rail/data/track_rms.csv`.
struct Row {
    name: String,
    spectrum: Spectrum,
    band: Band,
    rms_mm: [f64; 4],
}

fn table() -> Vec<Row> {
    let text = include_str!("../../data/track_rms.csv");
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let spectrum = match cells[0] {
                "fra" => Spectrum::fra(cells[1].parse().unwrap()).unwrap(),
                "german_low" => Spectrum::german_low(),
                "german_high" => Spectrum::german_high(),
                other => panic!("{other}"),
            };
            let number = |k: usize| cells[k].parse::<f64>().unwrap();
            Row {
                name: cells[..4].join(" "),
                spectrum,
                band: Band::new(1.0 / number(3), 1.0 / number(2)),
                rms_mm: [4, 5, 6, 7].map(number),
            }
        })
        .collect()
}

fn densities(spectrum: &Spectrum) -> [Density; 4] {
    [
        spectrum.vertical,
        spectrum.lateral,
        spectrum.cross_level,
        spectrum.gauge,
    ]
}

fn in_order(channels: &Channels) -> [f64; 4] {
    [
        channels.vertical,
        channels.lateral,
        channels.cross_level,
        channels.gauge,
    ]
}

#[test]
fn the_densities_have_the_rms_of_the_table() {
    let rows = table();
    assert_eq!(rows.len(), 16);
    for row in rows {
        let (from, to) = (TAU / row.band.longest_m, TAU / row.band.shortest_m);
        let steps = 20_000;
        let width = (to - from) / f64::from(steps);
        for (density, rms_mm) in densities(&row.spectrum).iter().zip(row.rms_mm) {
            let square: f64 = (0..steps)
                .map(|i| density.at(from + width * (f64::from(i) + 0.5)) * width)
                .sum();
            let found_mm = square.sqrt() * 1e3;
            assert!(
                (found_mm - rms_mm).abs() < 1.5e-4 + 2e-5 * rms_mm,
                "{}: {found_mm} {rms_mm}",
                row.name
            );
        }
    }
}

/// Generated track for one row of the table: deviations every half metre between the ramps, for several seeds.
struct Realisations {
    row: Row,
    deviations_m: Vec<Vec<[f64; 4]>>,
}

const SPACING_M: f64 = 0.5;

/// Two classes with different corners and both German tracks, from 3 to 42 m.
static REALISATIONS: LazyLock<Vec<Realisations>> = LazyLock::new(|| {
    let names = ["fra 4", "fra 6", "german_low", "german_high"];
    let rows = table().into_iter().filter(|row| {
        row.name.ends_with("0.024 0.333") && names.iter().any(|name| row.name.starts_with(name))
    });
    rows.map(|row| {
        let deviations_m = [1, 2].map(|seed| {
            let generation = Generation::new(row.spectrum)
                .with_band(row.band)
                .with_seeds(Seeds::from(seed))
                .with_length_m(10_000.0);
            let irregularity = generation.irregularity().unwrap();
            let between_ramps = (100..19_900).map(|i| SPACING_M * f64::from(i));
            between_ramps
                .map(|distance_m| in_order(&irregularity.channels(distance_m)[0]))
                .collect()
        });
        Realisations {
            row,
            deviations_m: deviations_m.into(),
        }
    })
    .collect()
});

#[test]
fn generated_track_has_the_rms_of_the_table() {
    assert_eq!(REALISATIONS.len(), 4);
    for Realisations { row, deviations_m } in &*REALISATIONS {
        for channel in 0..4 {
            let values = || deviations_m.iter().flatten().map(|values| values[channel]);
            let square: f64 = values().map(|value| value * value).sum();
            let found_mm = (square / values().count() as f64).sqrt() * 1e3;
            let expected_mm = row.rms_mm[channel];
            assert!(
                (found_mm / expected_mm - 1.0).abs() < 0.025,
                "{}: {found_mm} {expected_mm}",
                row.name
            );
        }
    }
}

/// Welch's method: periodograms with Hann windows of 512 m that overlap by half, at whole numbers of waves per window.
fn welch(values: &[f64], waves: Range<usize>) -> Vec<f64> {
    let samples = (512.0 / SPACING_M) as usize;
    let window: Vec<f64> = (0..samples)
        .map(|i| 0.5 - 0.5 * (TAU * i as f64 / samples as f64).cos())
        .collect();
    let power: f64 = window.iter().map(|weight| weight * weight).sum();
    let starts: Vec<usize> = (0..=values.len() - samples).step_by(samples / 2).collect();
    waves
        .map(|wave| {
            let turns: Vec<(f64, f64)> = (0..samples)
                .map(|i| (TAU * ((wave * i) % samples) as f64 / samples as f64).sin_cos())
                .collect();
            let sum: f64 = starts
                .iter()
                .map(|start| {
                    let (mut re, mut im) = (0.0, 0.0);
                    for i in 0..samples {
                        let value = window[i] * values[start + i];
                        re += value * turns[i].1;
                        im += value * turns[i].0;
                    }
                    re * re + im * im
                })
                .sum();
            // One-sided density per rad/m.
            sum / starts.len() as f64 * SPACING_M / (TAU * power) * 2.0
        })
        .collect()
}

#[test]
fn generated_track_has_the_spectrum_of_the_formula() {
    // Edges of six bands, in waves per 512 m: wavelengths from 39 m to 3.01 m.
    let edges = [13, 19, 28, 44, 70, 110, 170];
    let last = edges.len() - 1;
    for Realisations { row, deviations_m } in &*REALISATIONS {
        for (channel, density) in densities(&row.spectrum).iter().enumerate() {
            let mean_of_seeds = |waves: Range<usize>| {
                let mut mean = vec![0.0; waves.len()];
                for deviations_m in deviations_m {
                    let values: Vec<f64> = deviations_m.iter().map(|row| row[channel]).collect();
                    let found = welch(&values, waves.clone());
                    for (mean, found) in mean.iter_mut().zip(found) {
                        *mean += found / 2.0;
                    }
                }
                mean
            };
            let found = mean_of_seeds(edges[0]..edges[last]);
            for part in edges.windows(2) {
                let ratio: f64 = (part[0]..part[1])
                    .map(|wave| found[wave - edges[0]] / density.at(TAU * wave as f64 / 512.0))
                    .sum();
                let ratio = ratio / (part[1] - part[0]) as f64;
                // Means over 6 to 60 waves and the windows of two seeds; the ratios found are 0.945 to 1.023.
                assert!(
                    (ratio - 1.0).abs() < 0.08,
                    "{}, channel {channel}, {part:?}: {ratio}",
                    row.name
                );
            }
            // Outside the band, wavelengths above 64 m and below 2.5 m have less than 1 % of the density at its ends.
            for (outside, end) in [(5..8, found[0]), (205..209, found[found.len() - 1])] {
                for value in mean_of_seeds(outside) {
                    assert!(value < 0.01 * end, "{}: {value} {end}", row.name);
                }
            }
        }
    }
}

#[test]
fn channels_are_uncorrelated() {
    for Realisations { row, deviations_m } in &*REALISATIONS {
        let product = |a: usize, b: usize| -> f64 {
            let values = deviations_m.iter().flatten();
            values.map(|values| values[a] * values[b]).sum()
        };
        for a in 0..4 {
            for b in 0..a {
                let correlation = product(a, b) / (product(a, a) * product(b, b)).sqrt();
                assert!(
                    correlation.abs() < 0.15,
                    "{} {a} {b}: {correlation}",
                    row.name
                );
            }
        }
    }
}

#[test]
fn other_classes_are_rejected() {
    for class in [0, 7, 255] {
        let error = Spectrum::fra(class).unwrap_err().to_string();
        assert_eq!(error, format!("FRA class {class}, allowed: 1 to 6"));
    }
}
