//! Rehearses publishing the packages that a user may depend on, in the order of their dependencies.

use std::collections::BTreeSet;
use std::fs;

use crate::run::{Outcome, cargo, cargo_output, repository};

/// Files that each package must contain in addition to its sources.
const REQUIRED: [&str; 4] = ["Cargo.toml", "LICENSE-MIT", "LICENSE-APACHE", "README.md"];

/// The only package that is also compiled from its packed files, because compiling all would take as long as the
/// workspace itself. `tests/repository/published.rs` checks that no package includes a file from outside its folder.
const COMPILED: &str = "dashpot-core";

/// A package of the workspace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Package {
    /// Name of the package.
    pub name: String,
    /// Folder in the repository.
    pub folder: String,
}

/// Packs every published package and checks its contents.
///
/// # Errors
/// A package cannot be packed or lacks a required file, or the package that is compiled does not compile.
pub fn rehearse_publishing() -> Outcome {
    let packages = published()?;
    for package in &packages {
        let listed = [
            "package",
            "--list",
            "--allow-dirty",
            "--package",
            &package.name,
        ];
        let missing = missing(&cargo_output(&listed)?);
        if !missing.is_empty() {
            return Err(format!(
                "the package {} lacks {}",
                package.name,
                missing.join(", ")
            ));
        }
    }
    let mut pack = vec![
        "package",
        "--allow-dirty",
        "--no-verify",
        "--target-dir",
        "target/package_rehearsal",
    ];
    for package in &packages {
        pack.extend(["--package", &package.name]);
    }
    cargo(&pack)?;
    let compile = [
        "package",
        "--allow-dirty",
        "--target-dir",
        "target/package_rehearsal",
        "--package",
        COMPILED,
    ];
    cargo(&compile)
}

/// Returns the required files that are missing from a package's list of files.
fn missing(list: &str) -> Vec<&'static str> {
    let files: BTreeSet<&str> = list.lines().map(str::trim).collect();
    REQUIRED
        .into_iter()
        .filter(|file| !files.contains(file))
        .collect()
}

/// Returns the packages of the workspace whose manifest does not say `publish = false`.
///
/// # Errors
/// A manifest is missing or names no package.
pub fn published() -> Outcome<Vec<Package>> {
    packages(|manifest| !has_line(manifest, "publish = false"))
}

/// Returns the packages of the workspace that have features.
///
/// # Errors
/// A manifest is missing or names no package.
pub fn with_features() -> Outcome<Vec<Package>> {
    packages(|manifest| has_line(manifest, "[features]"))
}

fn has_line(manifest: &str, line: &str) -> bool {
    manifest.lines().any(|other| other.trim() == line)
}

/// Returns the packages of the workspace below the top folder whose manifest is selected.
fn packages(is_selected: impl Fn(&str) -> bool) -> Outcome<Vec<Package>> {
    let read = |folder: &str| {
        let path = repository().join(folder).join("Cargo.toml");
        fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let mut packages = Vec::new();
    for folder in members(&read("")?) {
        let manifest = read(&folder)?;
        if is_selected(&manifest) {
            let name =
                name(&manifest).ok_or_else(|| format!("{folder}/Cargo.toml names no package"))?;
            packages.push(Package { name, folder });
        }
    }
    Ok(packages)
}

/// Returns the folders that the workspace's manifest lists.
fn members(manifest: &str) -> Vec<String> {
    let list = manifest
        .split_once("\nmembers = [")
        .and_then(|(_, rest)| rest.split_once(']'));
    let list = list.map_or("", |(list, _)| list);
    list.split('"')
        .skip(1)
        .step_by(2)
        .map(str::to_owned)
        .collect()
}

/// Returns the name of a manifest's package.
fn name(manifest: &str) -> Option<String> {
    let line = manifest
        .lines()
        .find(|line| line.starts_with("name = \""))?;
    line.split('"').nth(1).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::{members, missing, name, published, with_features};

    #[test]
    fn manifests_are_read() {
        let manifest = "[package]\nname = \"top\"\n\n[workspace]\n\
                        members = [\n    \"core\", \"rail\",\n    \"xtask\",\n]\n";
        assert_eq!(members(manifest), ["core", "rail", "xtask"]);
        assert_eq!(name(manifest).as_deref(), Some("top"));
    }

    #[test]
    fn the_core_is_published_and_this_package_is_not() {
        let packages = published().unwrap();
        assert!(
            packages
                .iter()
                .any(|package| package.name == "dashpot-core" && package.folder == "core")
        );
        assert!(packages.iter().all(|package| package.name != "xtask"));
    }

    #[test]
    fn the_core_has_features_and_this_package_has_none() {
        let names: Vec<String> = with_features()
            .unwrap()
            .into_iter()
            .map(|package| package.name)
            .collect();
        assert!(names.iter().any(|name| name == "dashpot-core"));
        assert!(names.iter().all(|name| name != "xtask"));
    }

    #[test]
    fn a_package_without_a_licence_is_refused() {
        assert_eq!(
            missing("Cargo.toml\nLICENSE-MIT\nREADME.md\nsrc/lib.rs\n"),
            ["LICENSE-APACHE"]
        );
        assert_eq!(
            missing("Cargo.toml\nLICENSE-APACHE\nLICENSE-MIT\nREADME.md\n"),
            [""; 0]
        );
    }
}
