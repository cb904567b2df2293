//! The library in the pages is the one named by its README.

use std::path::Path;

use crate::common::are_as_their_readme_says;
use crate::shown::{VEHICLE, WHOLE_DEMONSTRATION};

#[test]
fn the_plotting_library_is_what_its_readme_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../report/src/page/uplot");
    are_as_their_readme_says(&folder);
}

/// Its licence requires: "in all copies or substantial portions of the Software".
#[test]
fn pages_have_the_librarys_licence() {
    let licence = include_str!("../../../report/src/page/uplot/LICENSE");
    for page in [&*WHOLE_DEMONSTRATION, &*VEHICLE] {
        assert!(page.contains(&format!("<!-- uPlot\n{licence}-->")));
    }
}
