//! Generated irregularities: reproducible, smooth, zero at their ends; invalid parameters are rejected.

use dashpot_rail::track::{
    Band, Generation, Irregularity, RailDeviation, Seeds, Spectrum, TrackError,
};

fn generation() -> Generation {
    Generation::new(Spectrum::fra(4).unwrap())
        .with_seeds(Seeds::from(42))
        .with_length_m(500.0)
}

fn irregularity() -> Irregularity {
    generation().irregularity().unwrap()
}

#[test]
fn the_same_seed_gives_the_same_bits_on_every_machine() {
    assert_eq!(irregularity(), irregularity());
    let seeds = Seeds::from(42);
    assert_eq!(
        [
            seeds.vertical,
            seeds.lateral,
            seeds.cross_level,
            seeds.gauge
        ],
        SEEDS
    );
    let [deviations, _] = irregularity().channels(250.0);
    let bits = [
        deviations.vertical,
        deviations.lateral,
        deviations.cross_level,
        deviations.gauge,
    ]
    .map(f64::to_bits);
    assert_eq!(bits, BITS, "{deviations:?}");
}

/// First numbers of PCG64 seeded with 42.
const SEEDS: [u64; 4] = [
    4178418447715145737,
    4410739922618931473,
    14034899209665866285,
    9736923071240364268,
];
/// The four channels at 250 m.
const BITS: [u64; 4] = [
    4582802594734626115,
    4579370775783286958,
    13796631127482711835,
    4574207434472931796,
];

#[test]
fn each_channel_has_its_own_seed() {
    let one = irregularity().channels(250.0)[0];
    let mut other = generation();
    other.seeds.cross_level += 1;
    let other = other.irregularity().unwrap().channels(250.0)[0];
    assert_ne!(one.cross_level, other.cross_level);
    assert_eq!(
        (one.vertical, one.lateral, one.gauge),
        (other.vertical, other.lateral, other.gauge)
    );
}

#[test]
fn a_longer_or_finer_track_is_the_same_track() {
    let one = irregularity();
    let longer = generation().with_length_m(2000.0);
    let finer = generation().with_spacing_m(Some(0.1));
    let [longer, finer] = [longer, finer].map(|g| g.irregularity().unwrap());
    for i in 0..4000 {
        let distance_m = f64::from(i) * 0.1;
        let expected = one.channels(distance_m)[0];
        for (other, allowed_m) in [(&longer, 1e-15), (&finer, 2e-6)] {
            let found = other.channels(distance_m)[0];
            assert!(
                (found.vertical - expected.vertical).abs() < allowed_m,
                "{distance_m}"
            );
            assert!(
                (found.gauge - expected.gauge).abs() < allowed_m,
                "{distance_m}"
            );
        }
    }
}

#[test]
fn deviations_start_and_end_smoothly_at_zero() {
    let irregularity = irregularity();
    assert_eq!(irregularity.ends_m(), [0.0, 500.0]);
    for distance_m in [-1e9, -10.0, 510.0, f64::INFINITY] {
        assert_eq!(
            irregularity.at(distance_m),
            [RailDeviation::default(); 2],
            "{distance_m}"
        );
    }
    assert!(irregularity.at(f64::NAN)[0].vertical_m.is_nan());
    // Class 4 has about 11 mm RMS. Half a metre into the ramp of 50 m the weight is 1/4000.
    for end in [0.0, 500.0] {
        for i in -100..=100 {
            let distance_m = end + 0.005 * f64::from(i);
            for rail in irregularity.at(distance_m) {
                assert!(rail.vertical_m.abs() < 20e-6, "{distance_m}: {rail:?}");
                assert!(rail.vertical_slope.abs() < 50e-6, "{distance_m}: {rail:?}");
            }
        }
    }
    // The weight of the ramp follows from the ratio between a track with a long ramp and one with a short ramp.
    let ramped = |ramp_m| generation().with_ramp_m(ramp_m).irregularity().unwrap();
    let (short, long) = (ramped(1.0), ramped(200.0));
    for (distance_m, weight) in [
        (20.0, 0.024_471_741_852_423_2),
        (100.0, 0.5),
        (400.0, 0.5),
        (250.0, 1.0),
    ] {
        let [free, weighted] = [&short, &long].map(|i| i.channels(distance_m)[0].vertical);
        assert!(
            (weighted - weight * free).abs() < 1e-9,
            "{distance_m}: {weighted} {free}"
        );
    }
}

#[test]
fn slopes_are_those_of_the_deviations_and_nothing_jumps() {
    let irregularity = irregularity();
    let step_m = 1e-4;
    for i in 0..50_600 {
        // At nodes, between nodes and beyond both ends.
        let distance_m = -3.0 + 0.01 * f64::from(i);
        let [before, here, behind] =
            [-1.0, 0.0, 1.0].map(|k| irregularity.at(distance_m + k * step_m));
        for side in 0..2 {
            let (a, b, c) = (&before[side], &here[side], &behind[side]);
            let vertical = (c.vertical_m - a.vertical_m) / (2.0 * step_m);
            let lateral = (c.lateral_m - a.lateral_m) / (2.0 * step_m);
            assert!((b.vertical_slope - vertical).abs() < 1e-8, "{distance_m}");
            assert!((b.lateral_slope - lateral).abs() < 1e-8, "{distance_m}");
            // The slope is continuous too: curvatures are below 0.05 1/m.
            let bend = (c.vertical_slope - a.vertical_slope).abs() / (2.0 * step_m);
            assert!(bend < 0.05, "{distance_m}: {bend}");
        }
    }
}

#[test]
fn curvature_is_continuous_at_every_node_even_where_a_short_ramp_ends() {
    let irregularity = generation().with_ramp_m(1.0).irregularity().unwrap();
    let step_m = 1e-5;
    let mut max: f64 = 0.0;
    for i in -60..=2060 {
        let node_m = irregularity.spacing_m() * f64::from(i);
        let slope = |k: f64| irregularity.channels(node_m + k * step_m)[1].lateral;
        let before = (slope(-1.0) - slope(-2.0)) / step_m;
        let behind = (slope(2.0) - slope(1.0)) / step_m;
        assert!(
            (behind - before).abs() < 2e-5,
            "{node_m}: {before} {behind}"
        );
        max = max.max(behind.abs());
    }
    assert!(max > 0.02, "{max}");
}

#[test]
fn rails_are_the_track_with_half_of_cross_level_and_gauge() {
    let irregularity = irregularity();
    let [deviations, slopes] = irregularity.channels(321.0);
    let [left, right] = irregularity.at(321.0);
    // With z down, a higher left rail has a smaller z; with y right, a wider gauge moves the right rail to larger y.
    assert!((right.vertical_m - left.vertical_m - deviations.cross_level).abs() < 1e-17);
    assert!((0.5 * (right.vertical_m + left.vertical_m) - deviations.vertical).abs() < 1e-17);
    assert!((right.lateral_m - left.lateral_m - deviations.gauge).abs() < 1e-17);
    assert!((0.5 * (right.lateral_m + left.lateral_m) - deviations.lateral).abs() < 1e-17);
    assert!((right.vertical_slope - left.vertical_slope - slopes.cross_level).abs() < 1e-17);
    assert!((right.lateral_slope - left.lateral_slope - slopes.gauge).abs() < 1e-17);
    let moving = left.displacement(40.0);
    assert_eq!(moving.vertical_velocity_m_per_s, 40.0 * left.vertical_slope);
    assert_eq!(moving.lateral_velocity_m_per_s, 40.0 * left.lateral_slope);
    assert_eq!(
        (moving.lateral_m, moving.vertical_m),
        (left.lateral_m, left.vertical_m)
    );
}

#[test]
fn invalid_parameters_are_rejected() {
    let band = |shortest_m, longest_m| generation().with_band(Band::new(shortest_m, longest_m));
    let mut negative = generation();
    negative.spectrum.gauge.gain_rad3_per_m = -1.0;
    let cases = [
        (
            band(0.1, 80.0),
            "irregularity: band.shortest_m 0.1, allowed: 0.3 to 72",
        ),
        (band(80.0, 3.0), "band.shortest_m 80, allowed: 0.3 to 2.7"),
        (band(3.0, f64::NAN), "band.longest_m NaN"),
        (
            generation().with_length_m(-1.0),
            "length_m -1, allowed: 2 to 1000000",
        ),
        (
            generation().with_ramp_m(251.0),
            "ramp_m 251, allowed: 1 to 250",
        ),
        (
            generation().with_spacing_m(Some(1.0)),
            "spacing_m 1, allowed: 0.03 to 0.5",
        ),
        (
            generation().with_spacing_m(Some(0.05)).with_length_m(1e6),
            "20000001 samples, allowed: 4000000 or fewer",
        ),
        (negative, "density in m^2/(rad/m) -"),
    ];
    for (generation, expected) in cases {
        let error: TrackError = generation.irregularity().unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
}
