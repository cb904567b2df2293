//! Metadata of the repository's workspaces, as cargo reports it.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use cargo_metadata::camino::Utf8Path;
use cargo_metadata::{CargoOpt, Metadata, MetadataCommand, Package};
use dashpot::document::in_repository;

/// Metadata of each workspace with all features, so that it includes optional dependencies. The lock files must be
/// up to date.
pub static WORKSPACES: LazyLock<Vec<Metadata>> = LazyLock::new(|| {
    let metadata = xtask::dependencies::WORKSPACES.map(|folder| {
        MetadataCommand::new()
            .manifest_path(in_repository(folder).join("Cargo.toml"))
            .features(CargoOpt::AllFeatures)
            .other_options(["--locked".to_owned()])
            .exec()
            .unwrap_or_else(|error| panic!("{folder}: {error}"))
    });
    metadata.into()
});

/// Returns our packages by folder. The package in the top folder, which has the tests across crates, is `tests`.
pub fn packages() -> BTreeMap<String, &'static Package> {
    let all = WORKSPACES.iter().flat_map(|workspace| &workspace.packages);
    all.filter(|package| package.source.is_none())
        .map(|package| (folder_of(package.manifest_path.parent()), package))
        .collect()
}

/// Returns the packages on which a user may depend, by folder.
pub fn published() -> BTreeMap<String, &'static Package> {
    let is_published = |package: &Package| {
        package
            .publish
            .as_ref()
            .is_none_or(|registries| !registries.is_empty())
    };
    packages()
        .into_iter()
        .filter(|(_, package)| is_published(package))
        .collect()
}

/// Returns a folder's path within the repository; the top folder is `tests`.
pub fn folder_of(path: Option<&Utf8Path>) -> String {
    let path = path.expect("a folder").as_std_path();
    let repository = in_repository("").canonicalize().expect("the repository");
    let path = path.canonicalize().expect("a folder");
    let folder = path
        .strip_prefix(repository)
        .expect("within the repository");
    match folder.to_string_lossy().replace('\\', "/") {
        top if top.is_empty() => "tests".into(),
        folder => folder,
    }
}
