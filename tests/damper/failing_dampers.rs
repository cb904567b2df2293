//! Three dampers whose errors under these motions were 1.2 to 9.8 times the limits of the former accuracy promise,
//! which depended only on the relaxation time. The errors that `dashpot verify` promises for each damper must cover
//! them.

use std::path::Path;

use dashpot_files::damper;
use dashpot_recording::Recording;
use dashpot_reference::probing::{Kind, Motion};
use dashpot_testbench::accuracy_limits::{AccuracyLimits, relaxation_time_s};
use dashpot_testbench::step_errors::{SCALARS, StepErrors};
use dashpot_testbench::verification::reference_forces;

const STEP_S: f64 = 1e-3;

/// Displacements (m) of a motion sampled at the ticks.
fn displacements(path: &Path) -> Vec<f64> {
    let mut recording = Recording::open(path).expect("a recording");
    let samples = recording.read_all().expect("samples");
    samples.iter().map(|sample| sample.displacement_m).collect()
}

#[test]
fn the_promise_of_each_damper_covers_its_motion() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/damper/failing");
    for name in ["saw_across_clearance", "saw_with_friction", "move_and_stop"] {
        let file = |extension: &str| folder.join(name).with_extension(extension);
        let damper = damper::load(&file("toml").to_string_lossy(), &[]).expect("a damper");
        let displacements = displacements(&file("csv"));
        assert_eq!(displacements.len(), 1001);
        let motion = Motion::new(Kind::Other, 0.0, displacements.clone());
        let errors = StepErrors::new(&damper, STEP_S, None).expect("a damper that is built");
        let largest = errors.largest(2).expect("a reference");
        let promised = errors.promised(&largest);
        let found = errors.on_motion(&motion).expect("a reference");
        for ((found, (error_n, nrmse)), scalar) in found.iter().zip(promised).zip(SCALARS) {
            println!(
                "{name}, {scalar}: {:.2} N of {error_n:.2} N, NRMSE {:.2e} of {nrmse:.2e}",
                found.largest_n, found.nrmse
            );
            assert!(found.largest_n <= error_n, "{name}, {scalar}: {found:?}");
            assert!(found.nrmse <= nrmse, "{name}, {scalar}: {found:?}");
        }
        // The limits by relaxation time hold for the shipped motions and do not apply here.
        let forces = reference_forces(&damper, STEP_S, &motion.displacements_m).expect("forces");
        let relaxation = relaxation_time_s(&damper, STEP_S, &motion.displacements_m, &forces);
        let limit = AccuracyLimits::for_relaxation_time(relaxation)
            .and_then(|limits| limits.nrmse(STEP_S, SCALARS[0]));
        assert!(
            limit.is_some_and(|limit| found[0].nrmse > limit),
            "{name}: {limit:?}"
        );
    }
}
