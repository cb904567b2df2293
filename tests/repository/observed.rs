//! The indices that a study can observe, as docs/studies.md lists them.

use dashpot::document;
use dashpot_study::sweep::OBSERVED;

#[test]
fn the_indices_of_a_study_are_those_of_its_document() {
    let rows = OBSERVED.map(|index| format!("| `{}` | {} |\n", index.name, index.meaning));
    let table = format!("| name | index |\n|---|---|\n{}", rows.concat());
    document::compare_part("docs/studies.md", "observed", &table);
}
