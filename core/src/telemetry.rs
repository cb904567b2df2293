//! A ring of the last samples of a damper, which a link reads between ticks.

use heapless::Deque;

use crate::math::approximate;
use crate::status::Status;

/// One tick of one damper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
#[repr(C)]
pub struct Sample {
    /// Tick count.
    pub tick: u32,
    /// Displacement used (m), positive in extension.
    pub displacement_m: f32,
    /// Force returned (N), positive when it resists extension.
    pub force_n: f32,
    /// Latched status bits.
    pub status: Status,
}

impl Sample {
    /// A sample of a tick: displacement used (m), force returned (N) and latched status bits.
    pub const fn new(tick: u32, displacement_m: f32, force_n: f32, status: Status) -> Self {
        Self {
            tick,
            displacement_m,
            force_n,
            status,
        }
    }
}

/// The last `N` samples, oldest first. Recording allocates nothing and has a constant cost.
///
/// ```
/// use dashpot_core::Status;
/// use dashpot_core::telemetry::{Sample, Telemetry};
///
/// let mut telemetry = Telemetry::<2>::new();
/// for tick in 1..=3 {
///     telemetry.record(Sample::new(tick, 1e-3, 500.0, Status::empty()));
/// }
/// assert_eq!(telemetry.take().map(|sample| sample.tick), Some(2));
/// assert_eq!(telemetry.overwritten(), 1);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Telemetry<const N: usize> {
    samples: Deque<Sample, N>,
    overwritten: u32,
}

impl<const N: usize> Telemetry<N> {
    /// An empty ring.
    pub const fn new() -> Self {
        Self {
            samples: Deque::new(),
            overwritten: 0,
        }
    }

    /// Adds a sample. A full ring drops its oldest sample and counts it.
    pub fn record(&mut self, sample: Sample) {
        if self.samples.is_full() {
            let _ = self.samples.pop_front();
            self.overwritten = self.overwritten.saturating_add(1);
        }
        // There is room unless N is 0, in which case no sample is kept.
        let _ = self.samples.push_back(sample);
    }

    /// Removes and returns the oldest sample.
    pub fn take(&mut self) -> Option<Sample> {
        self.samples.pop_front()
    }

    /// Iterates over the samples, oldest first, without removing them.
    pub fn iter(&self) -> impl Iterator<Item = &Sample> {
        self.samples.iter()
    }

    /// Number of samples that were overwritten before they were taken.
    pub fn overwritten(&self) -> u32 {
        self.overwritten
    }

    /// Approximate root mean square of the force over the samples (N); 0 without samples.
    ///
    /// For displays only: the square root has an error of up to 6 %. The step never uses it.
    ///
    /// ```
    /// use dashpot_core::Status;
    /// use dashpot_core::telemetry::{Sample, Telemetry};
    ///
    /// let mut telemetry = Telemetry::<4>::new();
    /// for force_n in [300.0, -400.0] {
    ///     telemetry.record(Sample::new(0, 0.0, force_n, Status::empty()));
    /// }
    /// let exact = 353.553; // sqrt((300^2 + 400^2)/2)
    /// assert!((telemetry.approximate_rms_force_n() / exact - 1.0).abs() < 0.062);
    /// ```
    pub fn approximate_rms_force_n(&self) -> f32 {
        let mut sum = 0.0;
        let mut count = 0.0;
        for sample in self.samples.iter() {
            sum += sample.force_n * sample.force_n;
            count += 1.0;
        }
        if count > 0.0 {
            approximate::sqrt(sum / count)
        } else {
            0.0
        }
    }
}
