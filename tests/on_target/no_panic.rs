//! The functions that firmware calls in a tick cannot reach a panic, according to the relocations of a `no_std` release
//! build.

use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::process::Command;

use object::read::archive::ArchiveFile;
use object::{Object, ObjectSection, ObjectSymbol, RelocationTarget, SymbolKind};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Runs cargo; fails the test if cargo fails.
fn cargo(arguments: &[&str], variables: &[(&str, &str)]) {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .envs(variables.iter().copied())
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(
        output.status.success(),
        "cargo {} failed:\n{}",
        arguments.join(" "),
        String::from_utf8_lossy(&output.stderr)
    );
}

/// For each symbol, the symbols to which its code refers.
struct References(HashMap<String, BTreeSet<String>>);

impl References {
    /// Reads all objects in a static library whose functions have a section each.
    fn read(library: &Path) -> Self {
        let data = std::fs::read(library).expect("the library was built");
        let archive = ArchiveFile::parse(&*data).expect("a static library");
        let mut references: HashMap<String, BTreeSet<String>> = HashMap::new();
        for (number, member) in archive.members().enumerate() {
            let member = member.expect("a member of the library");
            let Ok(file) = object::File::parse(member.data(&*data).expect("its bytes")) else {
                continue; // metadata, not code
            };
            // Sections are nodes too, so that references through a section symbol count.
            let section_name = |index: usize| format!("section {number}.{index}");
            for section in file.sections() {
                let targets = references
                    .entry(section_name(section.index().0))
                    .or_default();
                for (_, relocation) in section.relocations() {
                    let RelocationTarget::Symbol(index) = relocation.target() else {
                        continue;
                    };
                    let symbol = file.symbol_by_index(index).expect("the symbol referred to");
                    match (symbol.kind(), symbol.section_index()) {
                        (SymbolKind::Section, Some(section)) => {
                            targets.insert(section_name(section.0));
                        }
                        _ => {
                            targets.insert(symbol.name().unwrap_or_default().to_owned());
                        }
                    }
                }
            }
            for symbol in file.symbols() {
                if let (Ok(name), Some(section)) = (symbol.name(), symbol.section_index())
                    && !name.is_empty()
                {
                    let targets = references.entry(name.to_owned()).or_default();
                    targets.insert(section_name(section.0));
                }
            }
        }
        Self(references)
    }

    /// Panic symbols reachable from `entry`.
    fn panics_from<'a>(&'a self, entry: &'a str) -> Vec<&'a str> {
        assert!(self.0.contains_key(entry), "no symbol {entry}");
        let mut seen = BTreeSet::new();
        let mut open = vec![entry];
        while let Some(name) = open.pop() {
            if seen.insert(name) {
                open.extend(self.0.get(name).into_iter().flatten().map(String::as_str));
            }
        }
        seen.into_iter()
            .filter(|name| name.contains("panic") && *name != entry)
            .collect()
    }
}

#[test]
fn firmware_calls_reach_no_panic() {
    for opt_level in ["3", "s"] {
        let target = root().join(format!("target/no_std_consumer/opt-{opt_level}"));
        cargo(
            &[
                "build",
                "--release",
                "--manifest-path",
                "tests/no_std_consumer/Cargo.toml",
                "--target-dir",
                target.to_str().expect("a path in UTF-8"),
            ],
            &[("CARGO_PROFILE_RELEASE_OPT_LEVEL", opt_level)],
        );
        let library = if cfg!(windows) {
            "release/no_std_consumer.lib"
        } else {
            "release/libno_std_consumer.a"
        };
        let references = References::read(&target.join(library));
        assert!(
            !references.panics_from("control_panics").is_empty(),
            "the check finds no panic where there is one"
        );
        for entry in [
            "checked_step_f32",
            "checked_step_f64",
            "checked_bank",
            "checked_change",
            "checked_image",
            "checked_transfer",
            "checked_slices",
            "checked_telemetry",
        ] {
            let found = references.panics_from(entry);
            assert!(
                found.is_empty(),
                "{entry} at opt-level {opt_level} reaches {found:?}"
            );
        }
    }
}
