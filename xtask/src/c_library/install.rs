//! Creates the install tree of the C library: header, libraries, and files for pkg-config and CMake.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::{INTERFACE, Platform, folder, manifest};
use crate::run::Outcome;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Templates in which `@NAME@` marks the parts that differ between trees.
const PKG_CONFIG: &str = include_str!("../../../capi/install/dashpot.pc.in");
const CMAKE: &str = include_str!("../../../capi/install/DashpotConfig.cmake.in");
const CMAKE_VERSION: &str = include_str!("../../../capi/install/DashpotConfigVersion.cmake.in");

/// Builds the library for a platform, installs it in its own folder in `output`, and returns that folder. The folder
/// can be moved as a whole.
///
/// # Errors
/// The build fails, or a file cannot be written.
pub fn install(platform: &Platform, output: &Path) -> Outcome<PathBuf> {
    install_from(&manifest(), platform, output)
}

/// The same as [`install`], from a manifest.
///
/// # Errors
/// Those of [`install`].
pub fn install_from(manifest: &Path, platform: &Platform, output: &Path) -> Outcome<PathBuf> {
    let built = platform.build(manifest)?;
    let library = platform.library();
    let tree = output.join(platform.name());
    let (include, lib) = (tree.join("include"), tree.join("lib"));
    copy(
        &folder().join("include/dashpot.h"),
        &include.join("dashpot.h"),
    )?;
    copy(&built.archive, &lib.join(format!("lib{library}.a")))?;
    if let Some(shared) = built.shared {
        let name = format!("lib{library}.so");
        let (whole, interface) = (format!("{name}.{VERSION}"), format!("{name}.{INTERFACE}"));
        copy(&shared, &lib.join(&whole))?;
        link(&whole, &lib.join(&interface))?;
        link(&interface, &lib.join(&name))?;
    }
    let fill = |text: &str| {
        text.replace("@LIBRARY@", &library)
            .replace("@PLATFORM@", &platform.name())
            .replace("@VERSION@", VERSION)
            .replace("@INTERFACE@", INTERFACE)
            .replace("@POINTER_BYTES@", &platform.pointer_bytes().to_string())
    };
    let cmake = lib.join("cmake/Dashpot");
    for (path, text) in [
        (lib.join(format!("pkgconfig/{library}.pc")), PKG_CONFIG),
        (cmake.join("DashpotConfig.cmake"), CMAKE),
        (cmake.join("DashpotConfigVersion.cmake"), CMAKE_VERSION),
    ] {
        replace(&path, |new| fs::write(new, fill(text)))?;
    }
    Ok(tree)
}

fn copy(from: &Path, to: &Path) -> Outcome {
    replace(to, |new| fs::copy(from, new).map(drop))
}

/// Creates a link to a file in the same folder.
fn link(name: &str, to: &Path) -> Outcome {
    #[cfg(unix)]
    use std::os::unix::fs::symlink;
    #[cfg(not(unix))]
    fn symlink(_: &str, _: &Path) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }
    replace(to, |new| symlink(name, new))
}

/// Creates a file under a temporary name first, so that it is complete when it replaces an older one.
fn replace(path: &Path, create: impl FnOnce(&Path) -> io::Result<()>) -> Outcome {
    let parent = path.parent().unwrap_or(path);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let new = parent.join(format!(".{name}-{}", std::process::id()));
    fs::create_dir_all(parent)
        .and_then(|()| create(&new))
        .and_then(|()| fs::rename(&new, path))
        .map_err(|error| {
            let _ = fs::remove_file(&new);
            format!("{}: cannot write: {error}", path.display())
        })
}
