//! Slowness of this processor: its time to compile well-known packages, divided by that of a reference processor.
//!
//! Processors differ by a factor of two, and one that is shared with other work differs from itself. The build measures
//! itself with packages that change only when their version does.

use super::unit::Unit;
use crate::run::Outcome;

/// Packages, with the seconds of processor time that each takes on the reference processor, on which the whole build
/// took 222 s and two idle cores finished it in 115 s.
const REFERENCE_S: [(&str, f64); 17] = [
    ("parquet", 17.3),
    ("falcon_mdf", 12.2),
    ("fearless_simd", 5.6),
    ("nalgebra", 4.9),
    ("rustfft", 3.3),
    ("simba", 2.7),
    ("rustix", 2.7),
    ("brotli", 2.7),
    ("zerocopy", 2.7),
    ("brotli-decompressor", 2.5),
    ("encoding_rs", 2.5),
    ("zlib-rs", 2.5),
    ("libc", 1.9),
    ("clap_builder", 1.8),
    ("serde_core", 1.7),
    ("serde_json", 1.7),
    ("serde_derive", 1.6),
];

/// Minimum number of these packages in a build.
const MIN_PACKAGES: usize = 9;

/// Median of the ratios of all reference packages; the median ignores single packages that became larger or smaller.
///
/// # Errors
/// Too few of the packages were built.
pub fn slowness(units: &[Unit]) -> Outcome<f64> {
    let ratios = REFERENCE_S.iter().filter_map(|(name, reference_s)| {
        let is_this = |unit: &&Unit| {
            let (package, _) = unit.package.split_once(' ').unwrap_or_default();
            package == *name
        };
        let measured_s: f64 = units
            .iter()
            .filter(is_this)
            .map(|unit| unit.processor_s)
            .sum();
        (measured_s > 0.0).then_some(measured_s / reference_s)
    });
    let mut ratios: Vec<f64> = ratios.collect();
    if ratios.len() < MIN_PACKAGES {
        return Err(format!(
            "only {} of {} reference packages were built, at least {MIN_PACKAGES} are needed: renew the list in \
             xtask/src/timings/slowness.rs",
            ratios.len(),
            REFERENCE_S.len()
        ));
    }
    ratios.sort_by(f64::total_cmp);
    Ok(ratios[ratios.len() / 2])
}

#[cfg(test)]
mod tests {
    use super::{MIN_PACKAGES, REFERENCE_S, Unit, slowness};

    fn units(count: usize, factor: f64) -> Vec<Unit> {
        let packages = REFERENCE_S[..count].iter();
        let unit = |(name, reference_s): &(&str, f64)| Unit {
            package: format!("{name} 1.0.0"),
            processor_s: factor * reference_s,
            ..Unit::default()
        };
        packages.map(unit).collect()
    }

    #[test]
    fn a_package_that_grew_does_not_count() {
        let mut units = units(REFERENCE_S.len(), 1.5);
        units[0].processor_s *= 10.0;
        assert!((slowness(&units).unwrap() - 1.5).abs() < 1e-12);
    }

    #[test]
    fn a_build_without_the_packages_is_refused() {
        assert!(slowness(&units(MIN_PACKAGES, 1.0)).is_ok());
        assert!(slowness(&units(MIN_PACKAGES - 1, 1.0)).is_err());
    }
}
