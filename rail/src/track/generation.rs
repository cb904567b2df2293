//! Generates irregularities from a spectrum as sums of cosines with random phases.

use std::f64::consts::TAU;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::error::{Place, TrackError, within};
use super::irregularity::{Irregularity, MAX_SAMPLES};
use super::spectrum::{Density, Spectrum};

/// Range of wavelengths of an irregularity.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
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
    /// Returns the wavelengths from `shortest_m` to `longest_m`.
    pub const fn new(shortest_m: f64, longest_m: f64) -> Self {
        Self {
            shortest_m,
            longest_m,
        }
    }

    /// Smallest and largest wave number, rad/m.
    fn wave_numbers(&self) -> [f64; 2] {
        [TAU / self.longest_m, TAU / self.shortest_m]
    }
}

/// Seeds of the random numbers of each channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Seeds {
    /// Seed of the vertical profile.
    pub vertical: u64,
    /// Seed of the alignment.
    pub lateral: u64,
    /// Seed of the cross level.
    pub cross_level: u64,
    /// Seed of the gauge.
    pub gauge: u64,
}

impl From<u64> for Seeds {
    /// Returns the first four numbers of PCG64 with this seed.
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

/// Parameters from which an irregularity is generated.
///
/// The band is divided into equal intervals `dW` of at most 1e-3 rad/m. Each interval contributes a cosine with a
/// random phase and a random wave number `W` within the interval; its amplitude is `sqrt(2 S(W) dW)` (Shinozuka and Jan
/// 1972). The sum is Gaussian, has the mean square that the spectrum has in the band, and is not periodic. The random
/// numbers come from PCG64, with one seed per channel.
///
/// The sum is a function of the distance. Therefore the same spectrum, band and seeds give the same track for every
/// length, up to the ramp at its end, with the same bits on every machine with IEEE 754 arithmetic. The spacing affects
/// only the interpolation between samples.
///
/// Deviations start and end at zero: over `ramp_m` at each end they are multiplied by `(1 - cos(pi t / ramp_m)) / 2`,
/// where `t` is the distance from that end. Beyond the ends they are zero.
///
/// ```
/// use dashpot_rail::track::{Generation, Seeds, Spectrum};
/// let generation = Generation::new(Spectrum::fra(6)?)
///     .with_seeds(Seeds::from(7))
///     .with_length_m(1000.0);
/// let irregularity = generation.irregularity()?;
/// let [left, right] = irregularity.at(500.0);
/// assert!(left.vertical_m.abs() < 0.010 && left != right);
/// # Ok::<(), dashpot_rail::track::TrackError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Generation {
    /// Densities of the four channels.
    pub spectrum: Spectrum,
    /// Wavelengths. State them with every result.
    pub band: Band,
    /// Seeds of the channels.
    pub seeds: Seeds,
    /// Length, starting at the distance 0, m.
    pub length_m: f64,
    /// Length of the ramp at each end, m.
    pub ramp_m: f64,
    /// Distance between samples, m. `None` selects 0.25 m or a twelfth of the shortest wavelength, whichever is
    /// smaller.
    pub spacing_m: Option<f64>,
}

/// Maximum interval of wave numbers, rad/m.
const MAX_INTERVAL: f64 = 1e-3;
/// Minimum number of intervals, for a narrow band.
const MIN_INTERVALS: f64 = 256.0;
/// Number of cosines evaluated together.
const LANES: usize = 4;
/// Number of samples per evaluation of the cosines; the others follow by recurrence.
const BLOCK: usize = 64;

impl Generation {
    /// Returns 1 km of track with wavelengths of 3 to 80 m, seed 1 and ramps of 50 m.
    pub fn new(spectrum: Spectrum) -> Self {
        Self {
            spectrum,
            band: Band::default(),
            seeds: Seeds::from(1),
            length_m: 1000.0,
            ramp_m: 50.0,
            spacing_m: None,
        }
    }

    /// Sets the range of wavelengths.
    #[must_use]
    pub const fn with_band(mut self, band: Band) -> Self {
        self.band = band;
        self
    }

    /// Sets the seeds.
    #[must_use]
    pub const fn with_seeds(mut self, seeds: Seeds) -> Self {
        self.seeds = seeds;
        self
    }

    /// Sets the length, m.
    #[must_use]
    pub const fn with_length_m(mut self, length_m: f64) -> Self {
        self.length_m = length_m;
        self
    }

    /// Sets the length of the ramp at each end, m.
    #[must_use]
    pub const fn with_ramp_m(mut self, ramp_m: f64) -> Self {
        self.ramp_m = ramp_m;
        self
    }

    /// Sets the distance between samples, m; `None` selects the default.
    #[must_use]
    pub const fn with_spacing_m(mut self, spacing_m: Option<f64>) -> Self {
        self.spacing_m = spacing_m;
        self
    }

    /// Generates the irregularity.
    ///
    /// A kilometre takes about 30 ms. The time is proportional to the length divided by the square of the shortest
    /// wavelength.
    ///
    /// # Errors
    /// - a wavelength outside 0.3 to 500 m, or a shortest wavelength above 0.9 times the longest;
    /// - a ramp shorter than 1 m or longer than half the length;
    /// - a spacing outside 1/100 to 1/6 of the shortest wavelength, or more than [`MAX_SAMPLES`] samples;
    /// - a density that is negative or not finite.
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
        let [min, max] = band.wave_numbers();
        let intervals = ((max - min) / MAX_INTERVAL).ceil().max(MIN_INTERVALS);
        let width = (max - min) / intervals;
        let count = intervals as usize;
        let mut generator = Pcg64::seed_from_u64(seed);
        let mut groups = vec![Group::default(); count.div_ceil(LANES)];
        for i in 0..count {
            let wave_number = min + (i as f64 + from_0_to_1(&mut generator)) * width;
            let (group, lane) = (&mut groups[i / LANES], i % LANES);
            group.wave_number[lane] = wave_number;
            group.phase[lane] = TAU * from_0_to_1(&mut generator);
            group.amplitude[lane] = (2.0 * density.at(wave_number) * width).sqrt();
        }
        Self { groups }
    }

    /// Adds the sum at the distances `0, spacing_m, ...` to a channel of the samples.
    ///
    /// Within a block each cosine follows from the two before it: `c(n + 1) = 2 cos(W spacing) c(n) - c(n - 1)`. The
    /// recurrence restarts with each block, so its error stays below 1e-12 of the amplitude.
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
    /// Evaluates the cosines with the crate `libm`, because system libraries may differ in the last bit.
    fn at(&self, distance_m: f64) -> [f64; LANES] {
        std::array::from_fn(|k| {
            self.amplitude[k] * libm::cos(self.wave_number[k] * distance_m + self.phase[k])
        })
    }
}

/// Returns a uniform random number in [0, 1) from the upper 53 bits.
fn from_0_to_1(generator: &mut Pcg64) -> f64 {
    (generator.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}
