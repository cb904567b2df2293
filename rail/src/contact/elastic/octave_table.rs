//! A smooth function of a positive number, tabulated at 32 points per octave.

/// Points per octave, as a power of two.
const BITS: u32 = 5;
/// Mantissa bits of an `f64` that lie below the index.
const BELOW: u32 = 52 - BITS;

/// Values of a function between two powers of two; the argument's exponent and leading digits are the index, so reading
/// needs no logarithm.
#[derive(Debug, Clone)]
pub(super) struct OctaveTable {
    first: u64,
    range: [f64; 2],
    values: Vec<f64>,
}

impl OctaveTable {
    /// Tabulates `function` from `2^range[0]` to `2^range[1]`.
    pub fn new(range: [i32; 2], function: impl Fn(f64) -> f64) -> Self {
        let [low, high] = range.map(|exponent| libm::exp2(f64::from(exponent)));
        let (first, last) = (low.to_bits() >> BELOW, high.to_bits() >> BELOW);
        let value = |index: u64| function(f64::from_bits(index << BELOW));
        Self {
            first,
            range: [low, high],
            values: (first..=last + 1).map(value).collect(),
        }
    }

    /// Interpolates linearly at `x`; outside the range, returns the value at the nearest end.
    #[inline]
    pub fn at(&self, x: f64) -> f64 {
        let bits = x.clamp(self.range[0], self.range[1]).to_bits();
        let index = ((bits >> BELOW) - self.first) as usize;
        let fraction = (bits & ((1 << BELOW) - 1)) as f64 / (1_u64 << BELOW) as f64;
        let (before, after) = (self.values[index], self.values[index + 1]);
        before + fraction * (after - before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logarithm_is_read_within_a_ten_thousandth() {
        let table = OctaveTable::new([-3, 4], f64::ln);
        for k in 0..1000 {
            let x = 0.125 * 1.0048_f64.powi(k);
            assert!((table.at(x) - x.ln()).abs() < 1.3e-4, "{x}");
        }
        assert_eq!(table.at(1.0), 0.0);
        assert_eq!(table.at(16.0), 16.0_f64.ln());
    }

    #[test]
    fn beyond_the_range_the_value_stays() {
        let table = OctaveTable::new([0, 1], |x| x);
        assert_eq!([table.at(0.5), table.at(3.0)], [1.0, 2.0]);
    }
}
