//! Platforms for which the command is built.

use crate::c_library;

/// A platform that users have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Platform {
    /// Name in options and files.
    pub name: &'static str,
    /// Rust's target of the command. On Linux it is linked with its C library, so it runs on every distribution.
    pub target: &'static str,
    /// Name of the platform among those of the C library; `None` if the library is not built for it.
    pub c_library: Option<&'static str>,
    /// Debian's name of the processor; `None` outside Linux.
    pub debian: Option<&'static str>,
    /// Rust's target of the Python package, which uses the C library of the system; `None` if it is not built.
    pub python: Option<&'static str>,
}

/// List of all platforms. The first is that on which the archives are built.
pub const PLATFORMS: [Platform; 3] = [
    Platform {
        name: "x86-64-linux",
        target: "x86_64-unknown-linux-musl",
        c_library: Some("x86-64"),
        debian: Some("amd64"),
        python: Some("x86_64-unknown-linux-gnu"),
    },
    Platform {
        name: "aarch64-linux",
        target: "aarch64-unknown-linux-musl",
        c_library: Some("aarch64"),
        debian: Some("arm64"),
        python: Some("aarch64-unknown-linux-gnu"),
    },
    Platform {
        name: "x86-64-windows",
        target: "x86_64-pc-windows-gnu",
        c_library: None,
        debian: None,
        python: None,
    },
];

impl Platform {
    /// True if this machine runs programs of the platform.
    pub fn is_host(&self) -> bool {
        let processor = self.target.split('-').next();
        cfg!(target_os = "linux")
            && processor == Some(std::env::consts::ARCH)
            && self.target.contains("linux")
    }

    /// Name of the command's file.
    pub fn program(&self) -> &'static str {
        match self.target.contains("windows") {
            true => "dashpot.exe",
            false => "dashpot",
        }
    }

    /// Platforms of the C library in the archive: the platform itself and the processors without an operating system.
    pub fn c_libraries(&self) -> Vec<c_library::Platform> {
        let all = c_library::Platform::ALL.into_iter();
        all.filter(|platform| {
            matches!(platform, c_library::Platform::Bare(_))
                || self.c_library.is_some_and(|name| platform.name() == name)
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::PLATFORMS;

    #[test]
    fn an_archive_has_the_library_of_its_platform_and_of_the_bare_processors() {
        let libraries = PLATFORMS.map(|platform| {
            let libraries = platform.c_libraries().into_iter();
            libraries
                .map(|library| library.name())
                .collect::<Vec<_>>()
                .join(" ")
        });
        let bare = "cortex-m4f cortex-m7 cortex-m33";
        let expected = [
            format!("{bare} x86-64"),
            format!("{bare} aarch64"),
            bare.to_owned(),
        ];
        assert_eq!(libraries, expected);
    }
}
