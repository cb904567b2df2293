//! Options of `cargo xtask dist`.

use std::path::PathBuf;

use super::platform::{PLATFORMS, Platform};
use crate::run::repository;

/// Options of the command.
#[derive(Debug, PartialEq, Eq)]
pub struct Options {
    /// Platforms to build for.
    pub platforms: Vec<Platform>,
    /// Folder of the archives.
    pub output: PathBuf,
    /// Whether files may differ from the last commit.
    pub allow_changes: bool,
}

impl Options {
    /// Reads the arguments after the command.
    ///
    /// # Errors
    /// An argument is invalid. The message states what is allowed.
    pub fn parse(arguments: &[&str]) -> Result<Self, String> {
        let mut options = Self {
            platforms: Vec::new(),
            output: repository().join("target/dist"),
            allow_changes: false,
        };
        let mut rest = arguments.iter();
        while let Some(&option) = rest.next() {
            if option == "--allow-changes" {
                options.allow_changes = true;
                continue;
            }
            match (option, rest.next().copied()) {
                ("--platform", Some(name)) => options.platforms.push(platform(name)?),
                ("--output", Some(folder)) if !folder.is_empty() => {
                    options.output =
                        std::path::absolute(folder).map_err(|error| error.to_string())?
                }
                ("--platform" | "--output", _) => return Err(format!("{option} needs a value")),
                _ => {
                    return Err(format!(
                        "`{option}` is not an option of dist, allowed: --platform NAME, --output FOLDER, \
                         --allow-changes"
                    ));
                }
            }
        }
        if options.platforms.is_empty() {
            options.platforms = PLATFORMS.to_vec();
        }
        Ok(options)
    }
}

fn platform(name: &str) -> Result<Platform, String> {
    let found = PLATFORMS.into_iter().find(|platform| platform.name == name);
    found.ok_or_else(|| {
        let names = PLATFORMS.map(|platform| platform.name);
        format!("--platform {name}: unknown, allowed: {}", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::{Options, PLATFORMS};

    #[test]
    fn platforms_and_folder_are_read() {
        let options = Options::parse(&["--platform", "aarch64-linux", "--output", "/a"]).unwrap();
        assert_eq!(options.platforms, [PLATFORMS[1]]);
        assert_eq!(options.output.to_str(), Some("/a"));
        assert!(!options.allow_changes);
        let default = Options::parse(&["--allow-changes"]).unwrap();
        assert_eq!(default.platforms, PLATFORMS);
        assert!(default.allow_changes);
    }

    #[test]
    fn wrong_arguments_are_refused_with_what_is_allowed() {
        let refusal = |arguments: &[&str]| Options::parse(arguments).unwrap_err();
        assert_eq!(
            refusal(&["--platform", "linux"]),
            "--platform linux: unknown, allowed: x86-64-linux, aarch64-linux, x86-64-windows"
        );
        assert_eq!(refusal(&["--output"]), "--output needs a value");
        assert!(refusal(&["linux"]).contains("allowed: --platform NAME"));
    }
}
