//! Irregularities from a spectrum: sums of cosines with random phases.

use std::f64::consts::TAU;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::error::{Place, TrackError, within};
use super::irregularity::Irregularity;
use super::spectrum::{Density, Spectrum};

/// Wavelengths that an irregularity has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Shortest wavelength, m.
    pub shortest_m: f64,
    /// Longest wavelength, m.
    pub longest_m: f64,
}

impl Default for Band {
    /// 3 to 80 m.
    fn default() -> Self {
        Self {
            shortest_m: 3.0,
            longest_m: 80.0,
        }
    }
}

impl Band {
    /// Wave numbers from the least to the greatest, rad/m.
    fn wave_numbers(&self) -> [f64; 2] {
        [TAU / self.longest_m, TAU / self.shortest_m]
    }
}

/// The seed of each channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seeds {
    /// Of the vertical profile.
    pub vertical: u64,
    /// Of the alignment.
    pub lateral: u64,
    /// Of the cross level.
    pub cross_level: u64,
    /// Of the gauge.
    pub gauge: u64,
}

impl From<u64> for Seeds {
    /// The first four numbers of PCG64 with this seed.
    fn from(seed: u64) -> Self {
        let mut generator = Pcg64::seed_from_u64(seed);
        Self {
            vertical: generator.next_u64(),
            lateral: generator.next_u64(),
            cross_level: generator.next_u64(),
            gauge: generator.next_u64(),
        }
    }
}

/// What an irregularity is generated from.
///
/// The band is divided into equal intervals `dW` of at most 1e-3 rad/m. Each has a cosine with a phase from 0 to `2 pi` and a
/// wave number `W` anywhere in the interval, both random, and with the amplitude `sqrt(2 S(W) dW)`
/// (Shinozuka and Jan 1972): the sum is Gaussian, has the mean square of the band and does not repeat itself. The random
/// numbers are those of PCG64, one seed a channel.
///
/// The sum is a function of the distance. With the same spectrum, band and seeds the track is therefore the same for every length
/// (up to the ramp at its end), and the same bits on every machine with IEEE 754 numbers; the spacing changes what lies between the samples only.
///
/// Deviations begin and end with zero: over `ramp_m` at the start and at the end they are multiplied by `(1 - cos(pi t / ramp_m)) / 2`, `t` being
/// the distance to the end. Beyond the ends they are zero.
///
/// ```
/// use dashpot_rail::track::{Generation, Seeds, Spectrum};
/// let generation = Generation {
///     seeds: Seeds::from(7),
///     length_m: 1000.0,
///     ..Generation::of(Spectrum::fra(6)?)
/// };
/// let irregularity = generation.irregularity()?;
/// let [left, right] = irregularity.at(500.0);
/// assert!(left.vertical_m.abs() < 0.010 && left != right);
/// # Ok::<(), dashpot_rail::track::TrackError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generation {
    /// Densities of the four channels.
    pub spectrum: Spectrum,
    /// Wavelengths; no result is complete without it.
    pub band: Band,
    /// Seed of each channel.
    pub seeds: Seeds,
    /// Length, from the distance 0 on, m.
    pub length_m: f64,
    /// Length of the smooth start, and of the smooth end, m.
    pub ramp_m: f64,
    /// Distance of the samples, m; `None`: 0.25 m, or a twelfth of the shortest wavelength where that is less.
    pub spacing_m: Option<f64>,
}

/// Most samples of an irregularity: almost 1000 km of them each 0.25 m, 256 MB.
pub const MAX_SAMPLES: usize = 4_000_000;
/// Greatest interval of the wave numbers, rad/m.
const INTERVAL: f64 = 1e-3;
/// Least number of intervals, for a narrow band.
const MIN_INTERVALS: f64 = 256.0;
/// Cosines evaluated side by side.
const LANES: usize = 4;
/// Samples from one evaluation of the cosines to the next; those between follow by recurrence.
const BLOCK: usize = 64;

impl Generation {
    /// 1 km of a track with `spectrum`, 3 to 80 m, seed 1, ramps of 50 m.
    pub fn of(spectrum: Spectrum) -> Self {
        Self {
            spectrum,
            band: Band::default(),
            seeds: Seeds::from(1),
            length_m: 1000.0,
            ramp_m: 50.0,
            spacing_m: None,
        }
    }

    /// Generates the irregularity. A kilometre takes some 30 ms; the time goes as the length over the square of the shortest wavelength.
    ///
    /// # Errors
    /// A wavelength not within 0.3 to 500 m, a shortest one that is not shorter by a tenth than the longest, a ramp shorter than 1 m or
    /// longer than half the length, a spacing not within a hundredth to a sixth of the shortest wavelength, more than [`MAX_SAMPLES`]
    /// samples, a density that is not a number from 0 on.
    pub fn irregularity(&self) -> Result<Irregularity, TrackError> {
        let place = Place::Irregularity;
        let Band {
            shortest_m,
            longest_m,
        } = self.band;
        within(place, "band.longest_m", longest_m, [0.3 / 0.9, 500.0])?;
        within(place, "band.shortest_m", shortest_m, [0.3, 0.9 * longest_m])?;
        within(place, "length_m", self.length_m, [2.0, 1e6])?;
        within(place, "ramp_m", self.ramp_m, [1.0, 0.5 * self.length_m])?;
        let spacing_m = self.spacing_m.unwrap_or((shortest_m / 12.0).min(0.25));
        let spacings_m = [0.01 * shortest_m, shortest_m / 6.0];
        within(place, "spacing_m", spacing_m, spacings_m)?;
        for density in self.spectrum.densities() {
            for wave_number in self.band.wave_numbers() {
                let value = density.at(wave_number);
                within(place, "density in m^2/(rad/m)", value, [0.0, 1.0])?;
            }
        }
        let intervals = (self.length_m / spacing_m).round();
        if intervals >= MAX_SAMPLES as f64 {
            return Err(TrackError::TooManySamples {
                place,
                samples: intervals + 1.0,
            });
        }
        let mut samples = vec![[0.0; 4]; intervals as usize + 1];
        let Seeds {
            vertical,
            lateral,
            cross_level,
            gauge,
        } = self.seeds;
        let seeds = [vertical, lateral, cross_level, gauge];
        let channels = self.spectrum.densities().into_iter().zip(seeds).enumerate();
        for (channel, (density, seed)) in channels {
            let waves = Waves::new(density, self.band, seed);
            waves.add_to(spacing_m, &mut samples, channel);
        }
        Ok(Irregularity::through(0.0, spacing_m, self.ramp_m, &samples))
    }
}

/// Cosines `amplitude cos(wave_number s + phase)` of one channel, in lanes.
struct Waves {
    groups: Vec<Group>,
}

#[derive(Default, Clone, Copy)]
struct Group {
    wave_number: [f64; LANES],
    phase: [f64; LANES],
    amplitude: [f64; LANES],
}

impl Waves {
    fn new(density: &Density, band: Band, seed: u64) -> Self {
        let [least, greatest] = band.wave_numbers();
        let intervals = ((greatest - least) / INTERVAL).ceil().max(MIN_INTERVALS);
        let width = (greatest - least) / intervals;
        let count = intervals as usize;
        let mut generator = Pcg64::seed_from_u64(seed);
        let mut groups = vec![Group::default(); count.div_ceil(LANES)];
        for i in 0..count {
            let wave_number = least + (i as f64 + from_0_to_1(&mut generator)) * width;
            let (group, lane) = (&mut groups[i / LANES], i % LANES);
            group.wave_number[lane] = wave_number;
            group.phase[lane] = TAU * from_0_to_1(&mut generator);
            group.amplitude[lane] = (2.0 * density.at(wave_number) * width).sqrt();
        }
        Self { groups }
    }

    /// Adds the sum at the distances `0, spacing_m, ...` to a channel of the samples.
    ///
    /// Within a block each cosine follows from the two before it, `c(n + 1) = 2 cos(W spacing) c(n) - c(n - 1)`; begun anew with each
    /// block, its error stays below 1e-12 of the amplitude.
    fn add_to(&self, spacing_m: f64, samples: &mut [[f64; 4]], channel: usize) {
        let twice_cos: Vec<[f64; LANES]> = self
            .groups
            .iter()
            .map(|group| group.wave_number.map(|w| 2.0 * libm::cos(w * spacing_m)))
            .collect();
        for (number, block) in samples.chunks_mut(BLOCK).enumerate() {
            let start_m = spacing_m * (number * BLOCK) as f64;
            let mut sums = [[0.0; LANES]; BLOCK];
            for (group, factor) in self.groups.iter().zip(&twice_cos) {
                let mut before = group.at(start_m - spacing_m);
                let mut here = group.at(start_m);
                for sum in &mut sums {
                    for k in 0..LANES {
                        sum[k] += here[k];
                        let next = factor[k] * here[k] - before[k];
                        (before[k], here[k]) = (here[k], next);
                    }
                }
            }
            for (sample, sum) in block.iter_mut().zip(&sums) {
                sample[channel] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
            }
        }
    }
}

impl Group {
    /// The cosines by the crate `libm`: those of a system may differ in the last bit.
    fn at(&self, distance_m: f64) -> [f64; LANES] {
        std::array::from_fn(|k| {
            self.amplitude[k] * libm::cos(self.wave_number[k] * distance_m + self.phase[k])
        })
    }
}

/// Uniform from 0 to less than 1, from the upper 53 bits.
fn from_0_to_1(generator: &mut Pcg64) -> f64 {
    (generator.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}
