//! Regression test: with a force offset in the recordings, the parameters had no intervals at all. With offsets of both
//! sensors, 95 % intervals must contain the truth as often as without offsets.

use dashpot_calibration::{
    Assumed, Calibration, FORCE_OFFSET, HeldRig, LoopTest, Recorded, SKEW, Varied,
};
use dashpot_files::damper::{KeyedParameters, load};
use fastrand::Rng;

use crate::fits::{recorded, with};

const KEYS: [&str; 3] = [
    "reduced.damping_n_s_per_m",
    "mount.stiffness_n_per_m",
    "mount.clearance_m",
];

const TRUTHS: [f64; 3] = [110e3, 7e6, 0.8e-3];

/// Offsets of the force sensor (N) and the displacement sensor (m).
const OFFSETS: (f64, f64) = (200.0, 0.35);

#[test]
fn intervals_of_95_percent_contain_the_truth_with_offsets() {
    let truth = with("reduced-vertical", KEYS, TRUTHS);
    let damper = KeyedParameters::new("start", &load("reduced-vertical", &[]).unwrap()).unwrap();
    let (seeds, step_s) = (12, 2.5e-4);
    let mut within = [0; 5];
    for seed in 0..seeds {
        let mut rng = Rng::with_seed(300 + seed);
        let loops = [(10e-3, 0.8), (3e-3, 3.1)].iter().flat_map(|motion| {
            let recorded = recorded(&truth, *motion, 0.02, &mut rng);
            let off = |values: &[f64], by: f64| values.iter().map(|value| value + by).collect();
            let recorded = Recorded {
                displacements_m: off(&recorded.displacements_m, OFFSETS.1),
                forces_n: off(&recorded.forces_n, OFFSETS.0),
                ..recorded
            };
            LoopTest::from_recording(&recorded, step_s).unwrap()
        });
        let loops: Vec<LoopTest> = loops.collect();
        for test in &loops {
            assert!((test.displacement_offset_m - OFFSETS.1).abs() < 2e-4);
        }
        let varied = KEYS
            .iter()
            .map(|key| Varied::new(&damper, key, None, None).unwrap());
        let rig = [Varied::skew(), Varied::force_offset(&loops)];
        let calibration = Calibration {
            damper: damper.clone(),
            varied: varied.chain(rig).collect(),
            loops,
            indices: Vec::new(),
            step_s,
            starts: 1,
            rig: HeldRig::default(),
            assumed: Assumed::default(),
        };
        assert_eq!(
            [&calibration.varied[3].key, &calibration.varied[4].key],
            [SKEW, FORCE_OFFSET]
        );
        let found = calibration.run(&|_| {}).unwrap();
        let truths = TRUTHS.iter().chain(&[3e-3, OFFSETS.0]);
        for ((interval, truth), within) in found.intervals.iter().zip(truths).zip(&mut within) {
            let [least, greatest] = interval.map(Option::unwrap);
            *within += usize::from((least..=greatest).contains(truth));
        }
    }
    println!("of {seeds}: {within:?}");
    // By chance, fewer than 53 of 60 intervals contain the truth once in 100 times, and fewer than 9 of 12 once in 450
    // times.
    assert!(within.iter().sum::<usize>() >= 53, "{within:?}");
    assert!(within.iter().all(|within| *within >= 9), "{within:?}");
}
