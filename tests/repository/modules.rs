//! Modules must not import one another in a cycle: no file or folder leads back to itself through the imports of the
//! files and folders beside it.

use std::collections::BTreeMap;

use cargo_metadata::{Package, TargetKind};

use crate::source::{Crate, Graph, Import, Module, circles};
use crate::workspaces::packages;

/// Modules of one parent, the arrows between them, and an import for each arrow.
#[derive(Default)]
struct Siblings<'a> {
    arrows: Graph<&'a str>,
    imports: BTreeMap<(&'a str, &'a str), &'a Import>,
}

/// Groups imports by the closest common parent of both modules. An import between a module and one of its own
/// submodules belongs to no group, because a folder's `mod.rs` is part of the folder.
fn siblings(imports: &[Import]) -> BTreeMap<&[String], Siblings<'_>> {
    let mut groups: BTreeMap<&[String], Siblings> = BTreeMap::new();
    for import in imports {
        let common = import
            .from
            .iter()
            .zip(&import.to)
            .take_while(|(from, to)| from == to)
            .count();
        let (Some(from), Some(to)) = (import.from.get(common), import.to.get(common)) else {
            continue;
        };
        let group = groups.entry(&import.from[..common]).or_default();
        group.arrows.entry(from).or_default().insert(to);
        group.imports.entry((from, to)).or_insert(import);
    }
    groups
}

/// Describes each import cycle of a crate, with an import for each of its arrows.
fn described_circles(root: &str, imports: &[Import]) -> Vec<String> {
    let mut found = Vec::new();
    for (parent, group) in siblings(imports) {
        for circle in circles(&group.arrows) {
            let mut text = format!("{root}, in {}:", name(parent));
            for ((from, to), import) in &group.imports {
                if circle.contains(from) && circle.contains(to) {
                    let (module, source) = (name(&import.from), name(&import.to));
                    text += &format!(
                        "\n  {from} -> {to}: {module} uses {} of {source}",
                        import.path
                    );
                }
            }
            found.push(text);
        }
    }
    found
}

fn name(module: &[String]) -> String {
    ["crate"]
        .into_iter()
        .chain(module.iter().map(String::as_str))
        .collect::<Vec<_>>()
        .join("::")
}

/// Root files of the package's library and programs.
fn roots(package: &Package) -> impl Iterator<Item = &str> {
    let skipped = [
        TargetKind::Test,
        TargetKind::Bench,
        TargetKind::Example,
        TargetKind::CustomBuild,
    ];
    let targets = package
        .targets
        .iter()
        .filter(move |target| !target.kind.iter().any(|kind| skipped.contains(kind)));
    targets.map(|target| target.src_path.as_str())
}

#[test]
fn there_is_no_circle_between_modules() {
    let mut found = Vec::new();
    let mut count = 0;
    for package in packages().values() {
        for root in roots(package) {
            let imports = Crate::read(root.as_ref()).imports();
            count += imports.len();
            found.append(&mut described_circles(root, &imports));
        }
    }
    assert!(count > 1000, "{count} imports: the sources were not read");
    assert!(
        found.is_empty(),
        "{} import cycles\n{}",
        found.len(),
        found.join("\n")
    );
}

fn import(from: &str, to: &str) -> Import {
    let module = |text: &str| -> Module { text.split_whitespace().map(str::to_owned).collect() };
    Import {
        from: module(from),
        to: module(to),
        path: "path".into(),
    }
}

#[test]
fn circles_of_folders_are_found_though_no_file_is_in_one() {
    let imports = [
        import("a x", "b x"),
        import("b y", "a y"),
        import("b y", "c"),
    ];
    let found = described_circles("lib.rs", &imports);
    let expected = "lib.rs, in crate:
  a -> b: crate::a::x uses path of crate::b::x
  b -> a: crate::b::y uses path of crate::a::y";
    assert_eq!(found, [expected]);
}

#[test]
fn a_folder_and_its_own_files_are_no_circle() {
    let imports = [
        import("a", "a x"),
        import("a x", "a"),
        import("a x", "a y"),
        import("", "a"),
        import("a", ""),
    ];
    assert_eq!(described_circles("lib.rs", &imports), [""; 0]);
}
