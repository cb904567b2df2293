//! Two solvers of different families agree on the same damper.

use std::time::Instant;

use dashpot_core::DamperParameters;
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::nrmse;

use crate::common::radau::Radau;
use crate::common::{dampers, motions};

/// Largest normalised difference allowed between ESDIRK5 and Radau5; 5.8e-8 is the largest seen.
const AGREEMENT: f64 = 1e-6;

fn agree(parameters: &DamperParameters) {
    for (name, (times, x)) in [
        ("ride", motions::ride(1e3, 1.0)),
        ("sweep", motions::sweep(1e3, 1.0)),
        ("saw", motions::saw(1e3, 0.8)),
        ("decay", motions::decay(1e3, 0.6)),
    ] {
        let mut reference = Reference::new(parameters).expect("laws");
        let started = Instant::now();
        let production = reference.forces(&times, &x).expect(name);
        let (first, statistics) = (started.elapsed(), reference.statistics());
        let second = reference
            .forces_with(&mut Radau::default(), &times, &x)
            .expect(name);
        let difference = nrmse(&production, &second);
        println!(
            "{name}: {difference:.1e}, {statistics:?} in {first:.2?}, Radau {:?} in {:.2?}",
            reference.statistics(),
            started.elapsed() - first
        );
        assert!(difference < AGREEMENT, "{name}: {difference:e}");
        // At 6 MN/m this corresponds to 0.1 uN.
        assert!(statistics.closure_m < 2e-14, "{name}: {statistics:?}");
    }
}

#[test]
fn paper() {
    agree(&dampers::paper());
}

#[test]
fn paper_with_clearance() {
    agree(&dampers::paper_with_clearance());
}

#[test]
fn reduced_vertical() {
    agree(&dampers::reduced_vertical());
}

#[test]
fn in_service_lumped() {
    agree(&dampers::in_service(false));
}

#[test]
fn in_service_two_chamber() {
    agree(&dampers::in_service(true));
}
