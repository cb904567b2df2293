//! Checks that public interfaces have changed since the last tag only as the version number allows.

use crate::packages::published;
use crate::run::{Outcome, cargo, git};
use crate::tools::CARGO_SEMVER_CHECKS;

/// Prefix of the tags of versions, such as `v0.1.0`.
const PREFIX: &str = "v";

/// Compares the interface of each published package with that of the last tagged version.
///
/// # Errors
/// An interface changed more than the version number allows, or git or cargo-semver-checks does not run.
pub fn check_interfaces() -> Outcome {
    let Some(tag) = last_tag(&git(&[
        "tag",
        "--list",
        "--merged",
        "HEAD",
        "--sort=-version:refname",
    ])?) else {
        println!(
            "public interfaces: there is no tagged version yet, so there is nothing to compare with"
        );
        return Ok(());
    };
    let tagged = git(&["ls-tree", "-r", "--name-only", &tag])?;
    for package in published()? {
        if !is_tagged(&package.folder, &tagged) {
            println!(
                "public interface of {}: not in {tag}, so there is nothing to compare with",
                package.name
            );
            continue;
        }
        // Only its sources and manifest make its interface.
        let [sources, manifest] =
            ["src", "Cargo.toml"].map(|path| format!("{}/{path}", package.folder));
        if git(&["diff", "--name-only", &tag, "--", &sources, &manifest])?.is_empty() {
            println!("public interface of {}: as in {tag}", package.name);
            continue;
        }
        CARGO_SEMVER_CHECKS.install()?;
        cargo(&[
            "semver-checks",
            "--baseline-rev",
            &tag,
            "--package",
            &package.name,
        ])?;
    }
    Ok(())
}

/// Returns the newest version's tag from a list in descending order; `None` if no tag names a version.
fn last_tag(tags: &str) -> Option<String> {
    let is_version = |tag: &&str| {
        let version = tag.strip_prefix(PREFIX);
        version.is_some_and(|version| version.starts_with(|first: char| first.is_ascii_digit()))
    };
    tags.lines()
        .map(str::trim)
        .find(is_version)
        .map(str::to_owned)
}

/// True if a tag's list of files includes the package in this folder.
fn is_tagged(folder: &str, files: &str) -> bool {
    let manifest = format!("{folder}/Cargo.toml");
    files.lines().any(|file| file == manifest)
}

#[cfg(test)]
mod tests {
    use super::{is_tagged, last_tag};

    #[test]
    fn only_tags_of_versions_are_compared_with() {
        assert_eq!(last_tag(""), None);
        assert_eq!(last_tag("visit\nbefore-split\n"), None);
        assert_eq!(
            last_tag("visit\nv0.10.0\nv0.9.0\n").as_deref(),
            Some("v0.10.0")
        );
    }

    #[test]
    fn a_package_added_since_the_tag_is_not_compared() {
        let files = "Cargo.toml\ncore/Cargo.toml\ncore/src/lib.rs\n";
        assert!(is_tagged("core", files));
        assert!(!is_tagged("rail", files));
    }
}
