//! Stick or slip of one element.

/// Traction `p` of an element whose slip is `s = others + own p`. The element sticks (`s = 0`) if this keeps `|p|`
/// within `limit`; otherwise `|p| = limit`, and `p` opposes `s + shift`. The shift acts fully in deep sliding and
/// vanishes at the onset of sliding.
pub(super) fn traction(others: [f64; 2], own: [f64; 2], shift: [f64; 2], limit: f64) -> [f64; 2] {
    // In sliding `(own + resistance) p = -others` with a resistance `|s| / limit` of zero or more.
    let at = |resistance: f64| {
        [0, 1].map(|k| {
            let sum = own[k] + resistance;
            -(others[k] + shift[k] * resistance / sum) / sum
        })
    };
    let sticking = at(0.0);
    if sticking[0].hypot(sticking[1]) <= limit {
        return sticking;
    }
    // 1/|p| is nearly linear in the resistance, so Newton's method on it converges in a few steps.
    let mut resistance = 0.0;
    for _ in 0..30 {
        let p = at(resistance);
        let square = p[0] * p[0] + p[1] * p[1];
        let slope: f64 = (0..2).map(|k| p[k] * p[k] / (own[k] + resistance)).sum();
        let step = square / slope * (square.sqrt() / limit - 1.0);
        resistance = f64::max(resistance + step, 0.0);
        if step.abs() <= 1e-9 * (own[0] + resistance) {
            break;
        }
    }
    let p = at(resistance);
    let factor = limit / p[0].hypot(p[1]);
    p.map(|p| p * factor)
}
