//! A hybrid test through every fault has the digest that C and Python are compared with, tests/golden/transfer.txt.

use dashpot::document;
use dashpot::transfer_sequence::{digest, run};
use dashpot_core::hybrid::{GuardAction, HybridStatus};

const GOLDEN: &str = "tests/golden/transfer.txt";

#[test]
fn a_test_through_every_fault_has_its_digest() {
    let mut text = "# end of a test, digest of everything that comes out\n".to_owned();
    for (name, action) in [
        ("hold", GuardAction::Hold),
        ("zero_force", GuardAction::ZeroForce),
    ] {
        let rows = run(action).unwrap();
        let noticed = rows.iter().fold(0, |noticed, row| noticed | row.status);
        assert_eq!(noticed, HybridStatus::all().bits(), "{name}");
        text += &format!("{name}; {:016x}\n", digest(&rows).value());
    }
    document::compare(GOLDEN, &text);
}
