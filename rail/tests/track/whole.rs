//! A track composed of layout, irregularity and defects.

use dashpot_rail::track::{
    Defect, Generation, Irregularity, Layout, Part, RailDeviation, Rails, Spectrum, Track,
    TrackPoint,
};

#[test]
fn a_track_is_the_sum_of_its_parts() {
    let layout = Layout::new(&[
        Part::Straight { length_m: 100.0 },
        Part::Transition { length_m: 50.0 },
        Part::Circular {
            radius_m: -400.0,
            length_m: 200.0,
            cant_m: -0.1,
        },
    ])
    .unwrap();
    let irregularity = Generation::new(Spectrum::german_high()).with_length_m(300.0);
    let irregularity = irregularity.irregularity().unwrap();
    let dip = Defect::CosineDip {
        rails: Rails::Both,
        start_m: 119.0,
        length_m: 2.0,
        depth_m: 4e-3,
    };
    let track = Track::new(layout.clone(), irregularity.clone(), vec![dip]).unwrap();
    let point = track.at(120.0);
    assert_eq!(point.alignment, layout.at(120.0));
    for (found, alone) in point.rails.iter().zip(irregularity.at(120.0)) {
        assert_eq!(found.vertical_m, alone.vertical_m + 4e-3);
        assert_eq!(found.lateral_m, alone.lateral_m);
    }
    assert_eq!(track.layout(), &layout);
    assert_eq!(track.irregularity(), &irregularity);
}

#[test]
fn a_default_track_is_straight_and_even() {
    assert_eq!(Track::default().at(77.0), TrackPoint::default());
    assert_eq!(
        Irregularity::default().at(0.5),
        [RailDeviation::default(); 2]
    );
}
