//! What the C library is made of, read from its archive.

use std::path::Path;

use object::{Object, ObjectSection, ObjectSymbol, SectionKind};

use crate::budget::Figures;

/// Code and constants (bytes) of the C library for the target, which has the core and its border, and
/// how many of its symbols panic, use a heap or compute in double precision.
pub fn library_figures(library: &Path) -> Figures {
    let bytes = std::fs::read(library).expect("a library");
    let archive = object::read::archive::ArchiveFile::parse(&*bytes).expect("an archive");
    let (mut code, mut panics, mut heap, mut doubles) = (0, 0, 0, 0);
    for member in archive.members() {
        let member = member.expect("an archive's member");
        if !member.name().starts_with(b"dashpot") {
            continue;
        }
        let object = member.data(&*bytes).expect("a member's bytes");
        let object = object::File::parse(object).expect("an object file");
        for section in object.sections() {
            if matches!(
                section.kind(),
                SectionKind::Text | SectionKind::ReadOnlyData | SectionKind::ReadOnlyString
            ) {
                code += section.size();
            }
        }
        for symbol in object.symbols() {
            let name = symbol.name().unwrap_or_default();
            panics += u32::from(name.contains("panicking"));
            heap += u32::from(name.contains("alloc") || name.contains("free"));
            doubles += u32::from(is_soft_double(name));
        }
    }
    vec![
        ("code_and_constant_bytes".into(), code as f64),
        ("panic_symbols".into(), f64::from(panics)),
        ("heap_symbols".into(), f64::from(heap)),
        ("soft_double_symbols".into(), f64::from(doubles)),
    ]
}

/// Whether a function of the Arm run-time ABI or of GCC's computes with doubles.
fn is_soft_double(name: &str) -> bool {
    let abi = name.strip_prefix("__aeabi_");
    abi.is_some_and(|rest| rest.starts_with('d') || rest.contains("2d") || rest.contains("cdcmp"))
        || ["df2", "df3", "dfsf2"]
            .iter()
            .any(|end| name.ends_with(end))
}
