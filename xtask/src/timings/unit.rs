//! One run of the compiler, as the wrapper records it: a line of text.

use std::str::FromStr;

use crate::run::Outcome;

/// One run of the compiler.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unit {
    /// Package and version.
    pub package: String,
    /// True for a package of this repository.
    pub is_ours: bool,
    /// True for the compilation of a build script.
    pub is_build_script: bool,
    /// True if the package has a build script, which runs before this unit is compiled.
    pub needs_build_script: bool,
    /// Crate name with the hash of its output files.
    pub name: String,
    /// Names of the units that this unit uses.
    pub uses: Vec<String>,
    /// Processor time, user and system, of the compiler and the linker it runs, in seconds.
    pub processor_s: f64,
}

/// Separator of the columns of a line.
const SEPARATOR: char = '\t';

impl Unit {
    /// The line that [`Unit::from_str`] reads.
    pub fn line(&self) -> String {
        let columns = [
            self.package.clone(),
            self.is_ours.to_string(),
            self.is_build_script.to_string(),
            self.needs_build_script.to_string(),
            self.name.clone(),
            self.uses.join(" "),
            self.processor_s.to_string(),
        ];
        columns.join(&SEPARATOR.to_string())
    }

    /// Reads a unit from the compiler's arguments; `None` if cargo does not compile a crate with them but, for example,
    /// asks for the version.
    pub fn from_arguments(arguments: &[String]) -> Option<Self> {
        let value = |option: &str| {
            let at = arguments.iter().position(|argument| argument == option)?;
            arguments.get(at + 1)
        };
        let name = value("--crate-name").filter(|name| *name != "___")?;
        let hash = arguments
            .iter()
            .find_map(|argument| argument.split_once("extra-filename="));
        let hash = hash.map_or("", |(_, hash)| hash);
        let pairs = arguments.windows(2).filter(|pair| pair[0] == "--extern");
        let uses = pairs.filter_map(|pair| {
            let (_, path) = pair[1].split_once('=')?;
            let (_, file) = path.rsplit_once(['/', '\\'])?;
            let (stem, _) = file.rsplit_once('.')?;
            Some(stem.strip_prefix("lib").unwrap_or(stem).to_owned())
        });
        Some(Self {
            name: format!("{name}{hash}"),
            is_build_script: name.starts_with("build_script_"),
            uses: uses.collect(),
            ..Self::default()
        })
    }
}

impl FromStr for Unit {
    type Err = String;

    fn from_str(line: &str) -> Outcome<Self> {
        let wrong = || format!("not a line that the compiler's wrapper writes: {line}");
        let columns: Vec<&str> = line.split(SEPARATOR).collect();
        let [
            package,
            is_ours,
            is_build_script,
            needs_build_script,
            name,
            uses,
            processor_s,
        ] = columns[..]
        else {
            return Err(wrong());
        };
        let flag = |text: &str| text.parse().map_err(|_| wrong());
        Ok(Self {
            package: package.into(),
            is_ours: flag(is_ours)?,
            is_build_script: flag(is_build_script)?,
            needs_build_script: flag(needs_build_script)?,
            name: name.into(),
            uses: uses.split_whitespace().map(str::to_owned).collect(),
            processor_s: processor_s.parse().map_err(|_| wrong())?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;

    fn arguments(line: &str) -> Vec<String> {
        line.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn name_and_used_crates_are_read_from_the_arguments() {
        let line = "--crate-name wide --edition=2024 src/lib.rs --extern bytemuck=/t/deps/libbytemuck-0a.rmeta \
                    --extern noprelude:safe_arch=/t/deps/libsafe_arch-0b.rlib --extern proc_macro \
                    -C extra-filename=-0c";
        let unit = Unit::from_arguments(&arguments(line)).unwrap();
        assert_eq!(unit.name, "wide-0c");
        assert_eq!(unit.uses, ["bytemuck-0a", "safe_arch-0b"]);
        assert!(!unit.is_build_script);
        let script =
            Unit::from_arguments(&arguments("--crate-name build_script_build build.rs")).unwrap();
        assert!(script.is_build_script);
        assert_eq!(Unit::from_arguments(&arguments("-vV")), None);
        assert_eq!(
            Unit::from_arguments(&arguments("- --crate-name ___ --print=cfg")),
            None
        );
    }

    #[test]
    fn a_line_is_read_as_written() {
        let unit = Unit {
            package: "wide 1.7.1".into(),
            is_ours: false,
            is_build_script: false,
            needs_build_script: true,
            name: "wide-0c".into(),
            uses: vec!["bytemuck-0a".into(), "safe_arch-0b".into()],
            processor_s: 7.25,
        };
        assert_eq!(unit.line().parse(), Ok(unit));
        assert!("wide 1.7.1\ttrue".parse::<Unit>().is_err());
    }
}
