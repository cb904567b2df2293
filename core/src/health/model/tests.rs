//! Choice of pieces, baselines and marks.

use super::{Baseline, BaselineError, HealthLimits, HealthModel, MARK, PIECES};

/// A model whose pieces hold their own number, negative in compression; the first piece ends at 1 N.
fn numbered() -> HealthModel {
    let mut model = HealthModel::EMPTY;
    // Bits of 1 N, one piece lower: a quarter of an octave below it.
    model.first_piece = (1.0_f32.to_bits() >> super::PIECE_SHIFT) - 1;
    for number in 0..PIECES {
        model.pieces[0][number].velocity = number as f32;
        model.pieces[1][number].velocity = -(number as f32);
    }
    model
}

#[test]
fn a_piece_is_a_quarter_of_an_octave_and_both_ends_take_the_rest() {
    let model = numbered();
    for (force_n, number) in [
        (0.0, 0.0),
        (1e-30, 0.0),
        (0.99, 0.0),
        (1.0, 1.0),
        (1.24, 1.0),
        (1.25, 2.0),
        (1.5, 3.0),
        (1.75, 4.0),
        (2.0, 5.0),
        (4.0, 9.0),
        (32767.0 * 0.99, 60.0),
        (32768.0, 61.0),
        (49152.0, 63.0),
        (57344.0, 63.0),
        (1e30, 63.0),
        (f32::INFINITY, 63.0),
        (f32::NAN, 63.0),
    ] {
        assert_eq!(model.piece(force_n).velocity, number, "{force_n} N");
        let compressed = model.piece(-force_n).velocity;
        assert_eq!(compressed, -number, "-{force_n} N");
    }
}

#[test]
fn a_baseline_needs_positive_finite_values_and_no_negative_deviation() {
    let valid = Baseline {
        flow_factor_sd: 0.125,
        compliance_sd_m_per_n: 0.25,
        clearance_sd_m: 0.5,
        ..Baseline::new(1.0, 2.0, -3.0)
    };
    let mut model = HealthModel::EMPTY;
    assert_eq!(model.set_baseline(valid), Ok(()));
    assert_eq!(model.baseline(), valid);

    let positive: [fn(&mut Baseline, f32); 2] = [
        |baseline, value| baseline.flow_factor = value,
        |baseline, value| baseline.compliance_m_per_n = value,
    ];
    let deviations: [fn(&mut Baseline, f32); 3] = [
        |baseline, value| baseline.flow_factor_sd = value,
        |baseline, value| baseline.compliance_sd_m_per_n = value,
        |baseline, value| baseline.clearance_sd_m = value,
    ];
    let mut refuse = |change: fn(&mut Baseline, f32), value| {
        let mut baseline = valid;
        change(&mut baseline, value);
        assert_eq!(model.set_baseline(baseline), Err(BaselineError), "{value}");
        assert_eq!(model.baseline(), valid);
    };
    for change in positive {
        for value in [0.0, -1.0, f32::INFINITY, f32::NAN] {
            refuse(change, value);
        }
    }
    for change in deviations {
        for value in [-1.0, f32::INFINITY, f32::NAN] {
            refuse(change, value);
        }
    }
    refuse(|baseline, value| baseline.clearance_m = value, f32::NAN);
    refuse(
        |baseline, value| baseline.clearance_m = value,
        f32::INFINITY,
    );
    let certain = Baseline::new(1.0, 2.0, 3.0);
    assert_eq!(model.set_baseline(certain), Ok(()));
    assert_eq!(model.baseline(), certain);
}

#[test]
fn a_model_knows_its_step_its_limits_and_its_mark() {
    let mut model = HealthModel {
        half_step_s: 0.25,
        ..HealthModel::EMPTY
    };
    assert_eq!(model.step_s(), 0.5);
    assert!(!model.is_marked());
    model.mark = MARK;
    assert!(model.is_marked());
    let limits = HealthLimits {
        clearance_m: f32::INFINITY,
        ..HealthLimits::default()
    };
    model.set_limits(limits);
    assert_eq!(model.limits(), limits);
}
