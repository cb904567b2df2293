//! Roots of several monotone functions at the same time.

/// Finds the roots of `N` monotone functions in `[0, high]`, bit for bit like [`bracketed_root`] one by one.
///
/// The processor works on one function while it waits for the divisions and roots of another. If `is_enough` is true
/// for a bracket, the search in this lane ends and returns an end of the bracket.
///
/// [`bracketed_root`]: super::root::bracketed_root
#[inline(always)]
pub(crate) fn bracketed_roots<const N: usize>(
    high: [f64; N],
    function: impl Fn([f64; N]) -> [f64; N],
    is_enough: impl Fn(usize, f64, f64) -> bool,
) -> [f64; N] {
    let mut brackets = Brackets {
        a: [0.0; N],
        b: high,
        fa: function([0.0; N]),
        fb: function(high),
    };
    let mut found: [Option<f64>; N] = core::array::from_fn(|lane| brackets.end_if_no_root(lane));
    for iteration in 0..200 {
        for (lane, found) in found.iter_mut().enumerate() {
            let (a, b) = (brackets.a[lane], brackets.b[lane]);
            let is_narrow = b - a <= 2.0 * f64::EPSILON * b.abs();
            if (is_narrow || is_enough(lane, a, b)) && found.is_none() {
                *found = Some(0.5 * (a + b));
            }
        }
        if found.iter().all(Option::is_some) {
            break;
        }
        let middles = brackets.middles(iteration % 4 == 3);
        let values = function(middles);
        for (lane, value) in values.into_iter().enumerate() {
            if value == 0.0 {
                found[lane].get_or_insert(middles[lane]);
            }
        }
        brackets.narrow(middles, values);
    }
    core::array::from_fn(|lane| found[lane].unwrap_or(0.5 * (brackets.a[lane] + brackets.b[lane])))
}

/// Ends of brackets and the values there, which the Illinois method halves.
struct Brackets<const N: usize> {
    a: [f64; N],
    b: [f64; N],
    fa: [f64; N],
    fb: [f64; N],
}

impl<const N: usize> Brackets<N> {
    /// Returns the end with the smaller value if the function does not change sign or is 0 at the lower end.
    fn end_if_no_root(&self, lane: usize) -> Option<f64> {
        let (fa, fb) = (self.fa[lane], self.fb[lane]);
        let has_root = fa != 0.0 && fa.is_sign_positive() != fb.is_sign_positive();
        let end = if fa.abs() <= fb.abs() { self.a } else { self.b };
        (!has_root).then_some(end[lane])
    }

    /// Returns the next points to try.
    #[inline(always)]
    fn middles(&self, is_bisection: bool) -> [f64; N] {
        let halves = core::array::from_fn(|lane| 0.5 * (self.a[lane] + self.b[lane]));
        if is_bisection {
            return halves;
        }
        core::array::from_fn(|lane| {
            let (a, b, fa, fb) = (self.a[lane], self.b[lane], self.fa[lane], self.fb[lane]);
            let secant = b - fb * (b - a) / (fb - fa);
            let is_inside = (secant > a) & (secant < b);
            if is_inside { secant } else { halves[lane] }
        })
    }

    /// Moves one end of each bracket to `middles`, without branches: a processor would predict many of them wrongly.
    #[inline(always)]
    fn narrow(&mut self, middles: [f64; N], values: [f64; N]) {
        for lane in 0..N {
            let differs = self.fb[lane].to_bits() ^ values[lane].to_bits();
            let differs = ((differs as i64) >> 63) as u64;
            let select = |if_differs: f64, otherwise: f64| {
                f64::from_bits(if_differs.to_bits() & differs | otherwise.to_bits() & !differs)
            };
            self.a[lane] = select(middles[lane], self.a[lane]);
            self.b[lane] = select(self.b[lane], middles[lane]);
            self.fa[lane] = select(values[lane], 0.5 * self.fa[lane]);
            self.fb[lane] = select(0.5 * self.fb[lane], values[lane]);
        }
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::super::root::bracketed_root;
    use super::bracketed_roots;

    /// Functions with a root in the bracket, at its ends, outside it, and a root that is met exactly.
    const FUNCTIONS: [fn(f64) -> f64; 8] = [
        |x| x * x - 2.0,
        |x| 3.0 - libm::sqrt(x),
        |x| x + 1.0,
        |x| x - 9.0,
        |x| x - 3.0,
        |x| x,
        |x| 1e302 * (x - 3.0),
        |x| libm::pow(x, 1.5) - 1e-9,
    ];

    #[test]
    fn roots_together_have_the_bits_of_roots_alone() {
        let high = [4.0, 1e9, 1.0, 8.0, 8.0, 2.0, 1e6, 7.0];
        let values = |x: [f64; 8]| core::array::from_fn(|lane| FUNCTIONS[lane](x[lane]));
        let found = bracketed_roots(high, values, |_, _, _| false);
        for lane in 0..FUNCTIONS.len() {
            let alone = bracketed_root(0.0, high[lane], FUNCTIONS[lane]);
            assert_eq!(found[lane].to_bits(), alone.to_bits(), "function {lane}");
        }
    }

    #[test]
    fn a_search_ends_as_soon_as_its_bracket_is_enough() {
        let points = Cell::new(0);
        let function = |[x]: [f64; 1]| {
            points.set(points.get() + 1);
            [x * x - 2.0]
        };
        let [found] = bracketed_roots([4.0], function, |_, a, _| a > 1.0);
        assert!(found > 1.0 && found < 4.0);
        assert!(points.get() < 10, "{} points", points.get());
    }
}
