//! Checks the accuracy promise with a short search for its worst case; `cargo xtask search` searches for as long as you
//! like.

use dashpot::search::search;

/// Number of motions tried, on sixteen dampers.
const EVALUATIONS: usize = 832;

#[test]
fn the_promise_survives_a_search_for_its_worst_case() {
    let found = search(EVALUATIONS, 26, |case| println!("{}", case.line()));
    assert_eq!(found.evaluations, EVALUATIONS);
    // The reference solves every damper that can move within its force limit.
    for reason in &found.unsolved {
        assert!(reason.contains("the force limit"), "{reason}");
    }
    let worst = found.cases.first().expect("a case");
    assert!(
        worst.ratio() <= 1.0,
        "the promise is broken: {}\nwrite it by `cargo xtask search`",
        worst.line()
    );
    // A search whose worst error is far below the promise does not work.
    assert!(worst.ratio() > 0.15, "{}", worst.line());
}

#[test]
fn the_same_seed_finds_the_same() {
    let lines = |seed| {
        let cases = search(20, seed, |_| ()).cases;
        cases.iter().map(|case| case.line()).collect::<Vec<_>>()
    };
    assert_eq!(lines(3), lines(3));
    assert_ne!(lines(3), lines(4));
}
