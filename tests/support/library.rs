//! Size and symbols of the C library, read from its archive.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use object::{Object, ObjectSection, ObjectSymbol, RelocationTarget, SectionKind};

use crate::budget::Figures;

/// Prefixes of the health functions, and of those for hybrid tests.
const HEALTH: &[&str] = &["dashpot_health_"];
const HYBRID: &[&str] = &["dashpot_transfer_", "dashpot_motion_filter_"];

/// Code and constants (bytes) of the C library, for a target with the core and its interface.
///
/// There are three figures: the part that a linker with `--gc-sections` keeps for all functions except those for health
/// and hybrid tests, and the part that each of these two groups adds to it alone. Three more are the numbers of symbols
/// that panic, use a heap or compute in double precision.
pub fn library_figures(library: &Path) -> Figures {
    let bytes = std::fs::read(library).expect("a library");
    let archive = object::read::archive::ArchiveFile::parse(&*bytes).expect("an archive");
    let (mut panics, mut heap, mut doubles) = (0, 0, 0);
    let mut sections = Sections::default();
    for member in archive.members() {
        let member = member.expect("an archive's member");
        if !member.name().starts_with(b"dashpot") {
            continue;
        }
        let object = member.data(&*bytes).expect("a member's bytes");
        let object = object::File::parse(object).expect("an object file");
        for symbol in object.symbols() {
            let name = symbol.name().unwrap_or_default();
            panics += u32::from(name.contains("panicking"));
            heap += u32::from(name.contains("alloc") || name.contains("free"));
            doubles += u32::from(is_soft_double(name));
        }
        sections.add(&object);
    }
    let function = |name: &&String| name.starts_with("dashpot_");
    let functions: Vec<&String> = sections.defined.keys().filter(function).collect();
    let of_group = |name: &str, group: &[&str]| group.iter().any(|prefix| name.starts_with(prefix));
    let without_group = |group: &[&str]| -> Vec<&String> {
        let others = functions.iter().filter(|name| !of_group(name, group));
        others.copied().collect()
    };
    let [without_health, without_hybrid] = [HEALTH, HYBRID].map(without_group);
    let others = without_group(&[HEALTH, HYBRID].concat());
    assert!(
        without_hybrid.len() > others.len() + 5
            && without_health.len() > others.len() + 5
            && others.len() > 10,
        "{functions:?}: a section for each function"
    );
    let [without, with_health, with_hybrid] =
        [&others, &without_hybrid, &without_health].map(|group| sections.bytes_of(group));
    vec![
        ("code_and_constant_bytes".into(), without as f64),
        (
            "health_code_and_constant_bytes".into(),
            (with_health - without) as f64,
        ),
        (
            "hybrid_code_and_constant_bytes".into(),
            (with_hybrid - without) as f64,
        ),
        ("panic_symbols".into(), f64::from(panics)),
        ("heap_symbols".into(), f64::from(heap)),
        ("soft_double_symbols".into(), f64::from(doubles)),
    ]
}

/// Sections of code and constants, numbered over all members, with their references.
#[derive(Default)]
struct Sections {
    bytes: Vec<u64>,
    targets: Vec<Vec<Target>>,
    /// Section of each global symbol.
    defined: HashMap<String, usize>,
}

/// The target of a reference.
enum Target {
    Section(usize),
    /// A symbol of another member, or outside the library.
    Symbol(String),
}

impl Sections {
    /// Adds the sections of a member.
    fn add(&mut self, object: &object::File<'_>) {
        let first = self.bytes.len();
        for section in object.sections() {
            let counts = matches!(
                section.kind(),
                SectionKind::Text | SectionKind::ReadOnlyData | SectionKind::ReadOnlyString
            );
            let place = first + section.index().0;
            self.bytes.resize(self.bytes.len().max(place + 1), 0);
            self.targets.resize_with(self.bytes.len(), Vec::new);
            if !counts {
                continue;
            }
            self.bytes[place] = section.size();
            for (_, relocation) in section.relocations() {
                let RelocationTarget::Symbol(index) = relocation.target() else {
                    continue;
                };
                let symbol = object
                    .symbol_by_index(index)
                    .expect("the symbol referred to");
                self.targets[place].push(match symbol.section_index() {
                    Some(section) => Target::Section(first + section.0),
                    None => Target::Symbol(symbol.name().unwrap_or_default().to_owned()),
                });
            }
        }
        for symbol in object.symbols().filter(|symbol| symbol.is_global()) {
            if let (Ok(name), Some(section)) = (symbol.name(), symbol.section_index()) {
                self.defined.insert(name.to_owned(), first + section.0);
            }
        }
    }

    /// Bytes of all sections reachable from functions.
    fn bytes_of(&self, functions: &[&String]) -> u64 {
        let mut open: Vec<usize> = functions.iter().map(|name| self.defined[*name]).collect();
        let mut seen = BTreeSet::new();
        while let Some(place) = open.pop() {
            if !seen.insert(place) {
                continue;
            }
            open.extend(
                self.targets[place]
                    .iter()
                    .filter_map(|target| match target {
                        Target::Section(place) => Some(*place),
                        Target::Symbol(name) => self.defined.get(name).copied(),
                    }),
            );
        }
        seen.iter().map(|place| self.bytes[*place]).sum()
    }
}

/// Returns true for a function of the Arm run-time ABI or of GCC that computes with doubles.
fn is_soft_double(name: &str) -> bool {
    let abi = name.strip_prefix("__aeabi_");
    abi.is_some_and(|rest| rest.starts_with('d') || rest.contains("2d") || rest.contains("cdcmp"))
        || ["df2", "df3", "dfsf2"]
            .iter()
            .any(|end| name.ends_with(end))
}
