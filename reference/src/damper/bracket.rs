//! Root of an increasing function between two bounds.

/// Returns the point of `[low, high]` at which the increasing `function` crosses zero, accurate to rounding, or the
/// nearer bound if it does not cross zero.
///
/// The method is regula falsi (Illinois variant), with a bisection after three trials that have not halved the bracket.
pub(super) fn increasing_root(low: f64, high: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (function(a), function(b));
    if fa >= 0.0 {
        return a;
    }
    if fb <= 0.0 {
        return b;
    }
    let mut width = b - a;
    let mut retained = 0i32;
    for trial in 0..200 {
        let bisect = trial % 3 == 2 && {
            let slow = b - a > 0.5 * width;
            width = b - a;
            slow
        };
        let mut middle = if bisect {
            0.5 * (a + b)
        } else {
            (a * fb - b * fa) / (fb - fa)
        };
        if !(middle > a && middle < b) {
            middle = 0.5 * (a + b);
        }
        let value = function(middle);
        if value == 0.0 || middle <= a || middle >= b {
            return middle;
        }
        if value < 0.0 {
            (a, fa) = (middle, value);
            if retained < 0 {
                fb *= 0.5;
            }
            retained = -1;
        } else {
            (b, fb) = (middle, value);
            if retained > 0 {
                fa *= 0.5;
            }
            retained = 1;
        }
        if b - a <= 2.0 * f64::EPSILON * b.abs().max(a.abs()) {
            break;
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::increasing_root;

    #[test]
    fn cube_root_of_two() {
        let root = increasing_root(0.0, 2.0, |x| x * x * x - 2.0);
        assert!((root - 1.259_921_049_894_873_2).abs() < 1e-15);
    }

    #[test]
    fn outside_the_bounds_is_the_nearer_bound() {
        assert_eq!(increasing_root(1.0, 2.0, |x| x), 1.0);
        assert_eq!(increasing_root(-2.0, -1.0, |x| x), -1.0);
    }
}
