//! Each manifest states the `rust-version` with which CI compiles it.

use xtask::rust_version::{CORE, WORKSPACE};

use crate::workspaces::packages;

#[test]
fn stated_versions_are_those_that_ci_checks() {
    for (folder, package) in packages() {
        let expected = if folder == "core" { CORE } else { WORKSPACE };
        let stated = package.rust_version.as_ref().map(ToString::to_string);
        assert_eq!(
            stated.as_deref(),
            Some(&*format!("{expected}.0")),
            "{folder}"
        );
    }
}
