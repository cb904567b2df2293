//! Quantities derived from a reading.

use super::{Estimate, HealthReading, HealthStatus};

#[test]
fn the_damping_factor_is_the_inverse_of_the_flow_factor() {
    let flow_factor = Estimate {
        value: 0.25,
        sd: 0.125,
    };
    let reading = HealthReading {
        flow_factor,
        ..HealthReading::default()
    };
    // d(1/phi) = dphi/phi^2
    let expected = Estimate {
        value: 4.0,
        sd: 0.125 * 16.0,
    };
    assert_eq!(reading.damping_factor(), expected);
}

/// A force in the wrong unit is rejected in most samples; what the others say means nothing.
#[test]
fn a_reading_of_which_most_samples_were_rejected_is_not_trusted() {
    for (samples, rejected, is_trusted) in [(10, 10, true), (10, 11, false), (0, 1, false)] {
        let reading = HealthReading {
            samples,
            rejected,
            ..HealthReading::default()
        };
        assert_eq!(reading.is_trusted(), is_trusted, "{samples} {rejected}");
    }
}

#[test]
fn a_reading_is_trusted_unless_one_of_four_bits_is_set() {
    for (bit, is_trusted) in [
        (HealthStatus::empty(), true),
        (HealthStatus::FLOW, true),
        (HealthStatus::STIFFNESS, true),
        (HealthStatus::CLEARANCE, true),
        (HealthStatus::LITTLE_EXCITATION, true),
        (HealthStatus::INPUT_REJECTED, true),
        (HealthStatus::RESTARTED, true),
        (HealthStatus::FORCE_ZERO, true),
        (HealthStatus::NO_FORCE, false),
        (HealthStatus::LATE, false),
        (HealthStatus::SEVERAL_CHANGED, false),
        (HealthStatus::MISFIT, false),
    ] {
        let reading = HealthReading {
            status: bit | HealthStatus::FLOW,
            ..HealthReading::default()
        };
        assert_eq!(reading.is_trusted(), is_trusted, "{bit:?}");
    }
}

#[test]
fn status_bits_have_fixed_numbers() {
    // Firmware and C programs read these numbers.
    let bits = [
        HealthStatus::FLOW,
        HealthStatus::STIFFNESS,
        HealthStatus::CLEARANCE,
        HealthStatus::LITTLE_EXCITATION,
        HealthStatus::INPUT_REJECTED,
        HealthStatus::RESTARTED,
        HealthStatus::NO_FORCE,
        HealthStatus::FORCE_ZERO,
        HealthStatus::LATE,
        HealthStatus::SEVERAL_CHANGED,
        HealthStatus::MISFIT,
    ];
    for (place, bit) in bits.into_iter().enumerate() {
        assert_eq!(bit.bits(), 2_u16.pow(place as u32));
    }
}

#[test]
fn a_baseline_has_the_values_and_deviations_of_the_reading() {
    let estimate = |value, sd| Estimate { value, sd };
    let reading = HealthReading {
        flow_factor: estimate(1.0, 2.0),
        compliance_m_per_n: estimate(3.0, 4.0),
        clearance_m: estimate(5.0, 6.0),
        ..HealthReading::default()
    };
    let baseline = reading.as_baseline();
    let values = [
        baseline.flow_factor,
        baseline.flow_factor_sd,
        baseline.compliance_m_per_n,
        baseline.compliance_sd_m_per_n,
        baseline.clearance_m,
        baseline.clearance_sd_m,
    ];
    assert_eq!(values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
}

#[cfg(feature = "link")]
#[test]
fn a_status_is_sent_as_its_number_and_keeps_unknown_bits() {
    for bits in [0, 0x0402, 0x8001] {
        let status = HealthStatus::from_bits_retain(bits);
        let mut buffer = [0; 8];
        let bytes = postcard::to_slice(&status, &mut buffer).expect("eight bytes are enough");
        assert_eq!(postcard::from_bytes::<u16>(bytes), Ok(bits));
        assert_eq!(postcard::from_bytes(bytes), Ok(status));
    }
}
