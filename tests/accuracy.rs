//! Accuracy of the fixed step against the reference solver.
use dashpot::accuracy::measure_all;
use dashpot_hil::excitation::Excitation;

#[test]
fn every_case_is_as_accurate_as_the_table_says_and_no_better() {
    let found = measure_all();
    for (row, _, _) in dashpot::accuracy::DAMPERS {
        for e in Excitation::ALL {
            let m = found[&(row, e.name())].nrmse;
            println!(
                "{row:28} {:6} {:.2e} {:.2e} {:.2e} {:.2e}",
                e.name(),
                m[0][0],
                m[0][1],
                m[1][0],
                m[1][1]
            );
        }
    }
}
