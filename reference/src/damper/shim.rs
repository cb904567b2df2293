//! Edge compliance of a shim pack from the bending theory of an annular disc.

use dashpot_core::parameters::Valve;

/// Edge lift per pressure `k_w` (m/Pa), including the equivalent-pressure factor.
///
/// `k_w = w' Ce`, where `w'` is given or is `Cw(r_w)/h_e^3` with `h_e^3 = sum h_i^3` (frictionless stack).
pub(super) fn edge_compliance_m_per_pa(valve: &Valve) -> f64 {
    let uniform = valve.edge_compliance_m_per_pa.unwrap_or_else(|| {
        let cube_sum: f64 = valve.shims_m.iter().map(|h| h.powi(3)).sum();
        edge_coefficient(
            valve.clamp_radius_m,
            valve.free_radius_m,
            valve.elastic_modulus_pa,
            valve.poisson_ratio,
        ) / cube_sum
    });
    uniform * valve.equivalent_pressure_factor
}

/// Deflection coefficient at the free edge `Cw(r_w) = w(r_w) h^3/P` (m^6/N) of a disc clamped at
/// `inner` and free at `outer` under uniform pressure.
///
/// `w = C1 ln r + C2 r^2 + C3 r^2 ln r + C4 + P r^4/(64 D)`; the constants follow from zero deflection and slope at the
/// clamp, and zero moment and shear at the edge.
fn edge_coefficient(inner: f64, outer: f64, modulus: f64, poisson: f64) -> f64 {
    let (rn2, rw2) = (inner * inner, outer * outer);
    // D/h^3 of the plate, so 1/(64 D) -> 12 (1 - nu^2)/(64 E)
    let plate = (1.0 - poisson * poisson) / modulus;
    let b1 = -1.5 * plate * rw2;
    let b2 = 1.5 * plate * rn2 * (rw2 * (2.0 * inner.ln() + 1.0) - rn2 / 2.0);
    let b3 = 1.5 * plate * rw2 * rw2 / (1.0 - poisson)
        * (2.0 * (1.0 + poisson) * outer.ln() + (3.0 + poisson) / 2.0);
    let b4 = -2.0 * ((1.0 + poisson) / (1.0 - poisson) * rw2 + rn2);
    let c3 = b1;
    let c2 = -(b2 + b3) / b4;
    let c1 = b2 + 2.0 * rn2 * (b2 + b3) / b4;
    let shape = |r: f64| {
        let r2 = r * r;
        c1 * r.ln() + c2 * r2 + c3 * r2 * r.ln() + 12.0 / 64.0 * plate * r2 * r2
    };
    shape(outer) - shape(inner)
}

#[cfg(test)]
mod tests {
    use super::edge_coefficient;

    /// `y_max = K P r_w^4/D`, Roark's formulas, case 2l, nu = 0.3.
    #[test]
    fn edge_deflection_is_roarks() {
        let (modulus, poisson, outer) = (2.0e11, 0.3, 0.029);
        let flexural = modulus / (12.0 * (1.0 - poisson * poisson));
        for (ratio, roark) in [
            (0.1, 0.07569),
            (0.3, 0.03182),
            (0.5, 0.008589),
            (0.7, 0.001096),
            (0.9, 0.0000129),
        ] {
            let ours = edge_coefficient(ratio * outer, outer, modulus, poisson) * flexural
                / f64::powi(outer, 4);
            // Half a unit of the last printed digit.
            let printed = if ratio < 0.2 { 5e-6 } else { 5e-4 * roark };
            let printed = if ratio > 0.8 { 5e-8 } else { printed };
            assert!((ours - roark).abs() <= printed, "{ratio}: {ours} {roark}");
        }
    }

    /// Discs of Table 1 of the source paper; `Cw(r_w)` (m^6/N) was computed independently to five digits.
    #[test]
    fn coefficients_of_the_papers_discs() {
        for (inner, outer, expected) in [(0.016, 0.029, 2.1427e-19), (0.005, 0.011, 9.6981e-21)] {
            let ours = edge_coefficient(inner, outer, 2.0e11, 0.3);
            assert!((ours / expected - 1.0).abs() < 2.5e-5, "{inner}: {ours:e}");
        }
    }
}
