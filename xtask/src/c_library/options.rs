//! Options of `cargo xtask c-library`.

use std::path::PathBuf;

use super::Platform;
use crate::run::repository;

/// Options of the command.
#[derive(Debug, PartialEq, Eq)]
pub struct Options {
    /// Platforms to build for; empty for all platforms for which this machine can build.
    pub platforms: Vec<Platform>,
    /// Folder of the install trees.
    pub output: PathBuf,
}

impl Options {
    /// Reads the arguments after the command.
    ///
    /// # Errors
    /// An argument is invalid. The message states what is allowed.
    pub fn parse(arguments: &[&str]) -> Result<Self, String> {
        let mut options = Self {
            platforms: Vec::new(),
            output: repository().join("target/c-library"),
        };
        let mut rest = arguments.iter();
        while let Some(&option) = rest.next() {
            let value = rest.next().copied();
            match (option, value) {
                ("--target", Some(name)) => options.platforms.push(platform(name)?),
                ("--output", Some(folder)) if !folder.is_empty() => options.output = folder.into(),
                ("--target" | "--output", _) => return Err(format!("{option} needs a value")),
                _ => {
                    return Err(format!(
                        "`{option}` is not an option of c-library, allowed: --target NAME, --output FOLDER"
                    ));
                }
            }
        }
        Ok(options)
    }
}

fn platform(name: &str) -> Result<Platform, String> {
    let found = Platform::ALL
        .into_iter()
        .find(|platform| platform.name() == name);
    found.ok_or_else(|| {
        let names = Platform::ALL.map(|platform| platform.name());
        format!("--target {name}: unknown, allowed: {}", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::{Options, Platform};

    #[test]
    fn targets_and_folder_are_read() {
        let options = Options::parse(&[
            "--target",
            "cortex-m4f",
            "--output",
            "a",
            "--target",
            "x86-64",
        ]);
        let expected = Options {
            platforms: vec![Platform::ALL[0], Platform::ALL[3]],
            output: "a".into(),
        };
        assert_eq!(options, Ok(expected));
        let default = Options::parse(&[]).unwrap();
        assert_eq!(default.platforms, []);
        assert!(default.output.ends_with("target/c-library"));
    }

    #[test]
    fn wrong_arguments_are_refused_with_what_is_allowed() {
        let refusal = |arguments: &[&str]| Options::parse(arguments).unwrap_err();
        assert_eq!(
            refusal(&["--target", "cortex-m3"]),
            "--target cortex-m3: unknown, allowed: cortex-m4f, cortex-m7, cortex-m33, x86-64, aarch64"
        );
        assert_eq!(refusal(&["--target"]), "--target needs a value");
        assert_eq!(refusal(&["--output", ""]), "--output needs a value");
        assert!(refusal(&["cortex-m7"]).contains("allowed: --target NAME"));
    }
}
