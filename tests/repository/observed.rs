//! docs/studies.md lists the indices that a study can observe.

use dashpot::document;
use dashpot_study::sweep::OBSERVED;

#[test]
fn the_document_lists_the_indices_of_a_study() {
    let rows = OBSERVED.map(|index| format!("| `{}` | {} |\n", index.name, index.meaning));
    let table = format!("| name | index |\n|---|---|\n{}", rows.concat());
    document::compare_part("docs/studies.md", "observed", &table);
}
