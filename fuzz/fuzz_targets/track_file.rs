//! Reads any text as a track file. Either it is refused, or the track is finite everywhere. The target generates
//! irregularity only if that is quick.
#![no_main]

use std::path::Path;

use dashpot_files::track::{self, IrregularityParameters, TrackParameters};
use dashpot_rail::track::{Band, Track};
use libfuzzer_sys::fuzz_target;

/// Builds the track, except with irregularity that is read from a file or takes long to generate.
fn built(parameters: &TrackParameters) -> Option<Track> {
    match &parameters.irregularity {
        IrregularityParameters::Measured { .. } => return None,
        IrregularityParameters::Generated { generation, .. } => {
            let Band { shortest_m, .. } = generation.band;
            let spacing_m = generation.spacing_m.unwrap_or(0.25);
            if shortest_m < 3.0 || generation.length_m / spacing_m > 4000.0 {
                return None;
            }
        }
        IrregularityParameters::None | IrregularityParameters::Given(_) => {}
    }
    parameters.build().ok()
}

fuzz_target!(|text: &str| {
    let Ok(parameters) = track::parse("fuzz.toml", text, Path::new("")) else {
        return;
    };
    let Some(track) = built(&parameters) else {
        return;
    };
    let length_m = parameters.layout.length_m();
    for i in -10..=110 {
        let point = track.at(length_m * f64::from(i) / 100.0);
        assert!(point.alignment.curvature_per_m.is_finite() && point.alignment.cant_m.is_finite());
        for rail in point.rails {
            assert!(rail.vertical_m.is_finite() && rail.vertical_slope.is_finite());
            assert!(rail.lateral_m.is_finite() && rail.lateral_slope.is_finite());
        }
    }
});
