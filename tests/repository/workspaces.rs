//! What cargo tells of the workspaces of the repository.

use std::sync::LazyLock;

use cargo_metadata::{CargoOpt, Metadata, MetadataCommand};
use dashpot::document::in_repository;

/// Folders with a lock file.
const FOLDERS: [&str; 5] = [".", "capi", "firmware", "fuzz", "tests/no_std_consumer"];

/// With all features, so that what is optional is seen too; the lock files must be up to date.
pub static WORKSPACES: LazyLock<Vec<Metadata>> = LazyLock::new(|| {
    let metadata = FOLDERS.map(|folder| {
        MetadataCommand::new()
            .manifest_path(in_repository(folder).join("Cargo.toml"))
            .features(CargoOpt::AllFeatures)
            .other_options(["--locked".to_owned()])
            .exec()
            .unwrap_or_else(|error| panic!("{folder}: {error}"))
    });
    metadata.into()
});
