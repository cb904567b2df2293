//! Reads any text as a measured track. Either it is refused, or all deviations and slopes are finite.
#![no_main]

use dashpot_rail::track::measured::{self, Options};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    // Also adds a header, which random bytes hardly ever contain.
    let headed = format!("distance_m,vertical_m,lateral_m,cross_level_m,gauge_m\n{text}");
    let options = Options::default().with_ramp_m(1.0);
    for text in [text, &headed] {
        let Ok((irregularity, reading)) = measured::parse(text, &options) else {
            continue;
        };
        assert!(reading.rows >= measured::MIN_ROWS);
        let [from_m, to_m] = irregularity.ends_m();
        assert!(from_m < to_m);
        for i in -10..=110 {
            let distance_m = from_m + (to_m - from_m) * f64::from(i) / 100.0;
            for rail in irregularity.at(distance_m) {
                assert!(rail.vertical_m.is_finite() && rail.vertical_slope.is_finite());
                assert!(rail.lateral_m.is_finite() && rail.lateral_slope.is_finite());
            }
        }
    }
});
