//! Lines of a Fourier transform in a band of frequencies, with the same bits on every processor.
//!
//! Transforms of libraries choose their instructions by processor, and their last digits differ. This one adds in a
//! fixed order and takes its sines from `libm`.

use std::f64::consts::PI;
use std::ops::Range;

use realfft::num_complex::Complex;

/// Transform of windows of one length.
///
/// A window of `n` samples is split by the smallest prime factor of `n`, and so on (Cooley and Tukey 1965). The last
/// step computes only the lines of the band, so a prime length costs `n` products for each line.
#[derive(Debug, Clone)]
pub(super) struct Band {
    lines: Range<usize>,
    /// `exp(-2 pi i k/n)`.
    turns: Vec<Complex<f64>>,
    transformed: Vec<Complex<f64>>,
    parts: Vec<Complex<f64>>,
}

impl Band {
    /// Plans the transform of `samples` values into `lines`, which are below `samples`.
    pub fn new(samples: usize, lines: Range<usize>) -> Self {
        let turn = |k: usize| {
            let (sin, cos) = libm::sincos(2.0 * PI * k as f64 / samples as f64);
            Complex::new(cos, -sin)
        };
        Self {
            turns: (0..samples).map(turn).collect(),
            transformed: vec![Complex::ZERO; samples],
            parts: vec![Complex::ZERO; samples],
            lines,
        }
    }

    /// Number of samples of a window.
    pub fn samples(&self) -> usize {
        self.turns.len()
    }

    /// Returns the complex amplitudes of the lines of the band, for a window of [`samples`](Self::samples) values.
    pub fn lines(&mut self, window: &[f64]) -> &[Complex<f64>] {
        let Self {
            turns,
            transformed,
            parts,
            lines,
            ..
        } = self;
        let samples = Samples {
            window,
            first: 0,
            stride: 1,
        };
        samples.transform(turns, lines.clone(), transformed, parts);
        &transformed[..lines.len()]
    }
}

/// Every `stride`-th sample of a window.
#[derive(Clone, Copy)]
struct Samples<'a> {
    window: &'a [f64],
    first: usize,
    stride: usize,
}

impl Samples<'_> {
    /// Writes the `lines` of the transform to the start of `to`. `to` and `scratch` have the number of these samples.
    fn transform(
        self,
        turns: &[Complex<f64>],
        lines: Range<usize>,
        to: &mut [Complex<f64>],
        scratch: &mut [Complex<f64>],
    ) {
        let count = to.len();
        if count == 1 {
            to[0] = Complex::new(self.window[self.first], 0.0);
            return;
        }
        let parts = smallest_factor(count);
        let each = count / parts;
        let split = scratch
            .chunks_exact_mut(each)
            .zip(to.chunks_exact_mut(each));
        for (part, (transformed, scratch)) in split.enumerate() {
            let samples = Self {
                first: self.first + part * self.stride,
                stride: self.stride * parts,
                ..self
            };
            samples.transform(turns, 0..each, transformed, scratch);
        }
        for (line, to) in lines.zip(to) {
            // The turn of a sample from one part to the next.
            let turn = line * self.stride;
            let mut turned = 0;
            *to = Complex::ZERO;
            for part in scratch[line % each..].iter().step_by(each) {
                *to += turns[turned] * part;
                turned = (turned + turn) % turns.len();
            }
        }
    }
}

fn smallest_factor(number: usize) -> usize {
    let factors = (2..).take_while(|factor| factor * factor <= number);
    let mut divisors = factors.filter(|factor| number.is_multiple_of(*factor));
    divisors.next().unwrap_or(number)
}
