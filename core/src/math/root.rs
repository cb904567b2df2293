//! Root of a monotone function in a bracket.

/// Finds the root of the monotone `function` in `[low, high]`. If the function does not change sign, returns the end at
/// which its magnitude is smaller.
///
/// Uses the Illinois method with regular bisections; the number of iterations is bounded.
pub(crate) fn bracketed_root(low: f64, high: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (function(a), function(b));
    if fa == 0.0 || fa.is_sign_positive() == fb.is_sign_positive() {
        return if fa.abs() <= fb.abs() { a } else { b };
    }
    for iteration in 0..200 {
        let width = b - a;
        if width <= 2.0 * f64::EPSILON * b.abs() {
            break;
        }
        let secant = b - fb * width / (fb - fa);
        let middle = if iteration % 4 == 3 || !(secant > a && secant < b) {
            0.5 * (a + b)
        } else {
            secant
        };
        let value = function(middle);
        if value == 0.0 {
            return middle;
        }
        if value.is_sign_positive() == fb.is_sign_positive() {
            (b, fb) = (middle, value);
            fa *= 0.5;
        } else {
            (a, fa) = (middle, value);
            fb *= 0.5;
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use core::cell::{Cell, RefCell};

    use heapless::Vec;

    use super::bracketed_root;

    #[test]
    fn finds_roots_and_ends() {
        assert!(
            (bracketed_root(0.0, 4.0, |x| x * x - 2.0) - core::f64::consts::SQRT_2).abs() < 1e-14
        );
        assert!((bracketed_root(0.0, 1e9, |x| 3.0 - libm::sqrt(x)) - 9.0).abs() < 1e-12);
        assert_eq!(bracketed_root(0.0, 1.0, |x| x + 1.0), 0.0);
        assert_eq!(bracketed_root(0.0, 1.0, |x| x - 2.0), 1.0);
    }

    /// Finds a root and checks that each point is within the bracket and that no point is tried twice.
    fn root_without_wasted_points(low: f64, high: f64, function: impl Fn(f64) -> f64) -> f64 {
        let points = RefCell::new(Vec::<f64, 256>::new());
        let root = bracketed_root(low, high, |x| {
            let mut points = points.borrow_mut();
            assert!((low..=high).contains(&x), "{x} is outside {low} to {high}");
            assert!(!points.contains(&x), "{x} came twice in {points:?}");
            points.push(x).expect("few points");
            function(x)
        });
        assert!((low..=high).contains(&root));
        root
    }

    #[test]
    fn every_point_is_new_even_if_the_secant_hits_an_end() {
        // In double precision, the secant through both ends meets the axis at the lower end.
        assert!(root_without_wasted_points(0.0, 1.0, |x| x - 1e-300) < 1e-15);
        // Here it meets the axis at the upper end.
        let root = root_without_wasted_points(0.0, 1.0, |x| (x - 1.0) + 1e-17);
        assert!((root - 1.0).abs() < 1e-15);
    }

    /// Number of points at which the function is evaluated.
    fn points(low: f64, high: f64, function: impl Fn(f64) -> f64) -> usize {
        let count = Cell::new(0);
        bracketed_root(low, high, |x| {
            count.set(count.get() + 1);
            function(x)
        });
        count.get()
    }

    #[test]
    fn secants_and_bisections_together_need_few_points() {
        // The secant through both ends of a line meets the axis at the root.
        assert_eq!(points(0.0, 8.0, |x| x - 3.0), 3);
        // Bisection alone takes 80 points here; secants without regular bisections take 57.
        let count = points(0.0, 1e9, |x| 3.0 - libm::sqrt(x));
        assert!(count <= 52, "{count} points");
    }

    #[test]
    fn a_secant_that_overflows_does_not_leave_the_bracket() {
        // The value at the upper end times the width exceeds the largest number.
        let root = root_without_wasted_points(0.0, 1e6, |x| 1e302 * (x - 3.0));
        assert!((root - 3.0).abs() < 1e-14);
    }
}
