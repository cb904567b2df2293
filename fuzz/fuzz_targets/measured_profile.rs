//! Reads any text as a wheel or rail profile of any format. Either it is refused, or the lateral positions increase.
#![no_main]

use dashpot_rail::profile::Body;
use dashpot_rail::profile::measured::{self, Format, Mirror, Options};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let formats = Format::ALL.map(Some).into_iter().chain([None]);
    for format in formats {
        for body in [Body::Wheel, Body::Rail] {
            let options = Options::default()
                .with_format(format)
                .with_mirror(Some(Mirror::None));
            let Ok((profile, reading)) = measured::parse("fuzz.txt", text, body, &options) else {
                continue;
            };
            let points = profile.points();
            assert!(points.windows(2).all(|pair| pair[0].y_m < pair[1].y_m));
            assert!(points.iter().all(|point| point.z_m.is_finite()));
            assert!(reading.overhanging + reading.folded < reading.points);
        }
    }
});
