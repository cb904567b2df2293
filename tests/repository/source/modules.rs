//! The modules of a crate and the arrows between them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use super::imports::{Contents, Path, Use, contents};
use super::tokens;

/// Path of a module as the list of names from the crate's root; empty for the root itself.
pub type Module = Vec<String>;

/// Maximum number of re-exports in a chain.
const MAX_STEPS: usize = 32;

/// A crate read from its source files.
#[derive(Debug, Default)]
pub struct Crate {
    modules: BTreeMap<Module, Contents>,
}

/// An import from one module of the crate into another.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Import {
    /// Importing module.
    pub from: Module,
    /// Module that defines what is imported.
    pub to: Module,
    /// Path as written.
    pub path: String,
}

impl Crate {
    /// Reads the crate whose root is this file.
    ///
    /// # Panics
    /// A file is missing.
    pub fn read(root: &std::path::Path) -> Self {
        let mut modules = Self::default();
        let folder = root.parent().expect("a folder");
        modules.add_file(root.to_owned(), folder, Vec::new());
        modules
    }

    fn add_file(&mut self, file: PathBuf, folder: &std::path::Path, module: Module) {
        let text =
            fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        self.add(contents(&tokens(&text)), folder, module);
    }

    /// Adds a module, with those in the files and in the text below it.
    fn add(&mut self, mut contents: Contents, folder: &std::path::Path, module: Module) {
        for name in &contents.files {
            let inner = [&module[..], std::slice::from_ref(name)].concat();
            let own_folder = folder.join(name);
            let in_folder = own_folder.join("mod.rs");
            let file = if in_folder.exists() {
                in_folder
            } else {
                folder.join(format!("{name}.rs"))
            };
            self.add_file(file, &own_folder, inner);
        }
        for (name, inner) in std::mem::take(&mut contents.inline) {
            let own_folder = folder.join(&name);
            self.add(inner, &own_folder, [&module[..], &[name]].concat());
        }
        self.modules.insert(module, contents);
    }

    /// Returns every import of one module from another of the crate.
    pub fn imports(&self) -> Vec<Import> {
        let mut imports = BTreeSet::new();
        for (module, contents) in &self.modules {
            let uses = contents.uses.iter().map(|one| (&one.path, one.name == "*"));
            let paths = contents.paths.iter().map(|path| (path, false));
            for (path, is_glob) in uses.chain(paths) {
                let Some(absolute) = self.absolute(module, path) else {
                    continue; // another crate's
                };
                let to = self.defining(absolute, is_glob);
                if to != *module {
                    imports.insert(Import {
                        from: module.clone(),
                        to,
                        path: path.join("::"),
                    });
                }
            }
        }
        imports.into_iter().collect()
    }

    /// The path from the crate's root; `None` for a path into another crate.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Path> {
        let first = path.first()?;
        if first == "crate" {
            return Some(path[1..].to_vec());
        }
        let up = path.iter().take_while(|name| *name == "super").count();
        if up > 0 || first == "self" {
            let rest = &path[up.max(1)..];
            let base = &module[..module.len().saturating_sub(up)];
            return Some([base, rest].concat());
        }
        let inner = [module, &path[..1]].concat();
        let is_own = self.modules.contains_key(&inner);
        is_own.then(|| [module, path].concat())
    }

    /// Follows a path through modules and re-exports to the module that defines what it names.
    fn defining(&self, mut path: Path, is_glob: bool) -> Module {
        for _ in 0..MAX_STEPS {
            let known = (0..=path.len())
                .rev()
                .find(|length| self.modules.contains_key(&path[..*length]));
            let module = path[..known.unwrap_or(0)].to_vec();
            let Some(name) = path.get(module.len()) else {
                return module;
            };
            let rest = &path[module.len() + 1..];
            match self.reexported(&module, name) {
                Some(to) if !is_glob || !rest.is_empty() => path = [&to[..], rest].concat(),
                _ => return module,
            }
        }
        panic!("re-exports of {} do not end", path.join("::"));
    }

    /// The path that a module imports under this name; `None` if it does not import it from this crate.
    fn reexported(&self, module: &Module, name: &str) -> Option<Path> {
        let contents = &self.modules[module];
        if contents.items.iter().any(|item| item == name) {
            return None;
        }
        let target = |one: &Use| {
            self.absolute(module, &one.path)
                .filter(|path| path[..] != [&module[..], &[name.to_owned()]].concat())
        };
        let named = contents.uses.iter().filter(|one| one.name == name);
        if let Some(path) = named.filter_map(target).next() {
            return Some(path);
        }
        let globs = contents
            .uses
            .iter()
            .filter(|one| one.name == "*")
            .filter_map(target);
        globs
            .filter(|glob| glob != module)
            .map(|glob| self.defining(glob, false))
            .find_map(|glob| {
                let inner = &self.modules[&glob];
                let path = [&glob[..], &[name.to_owned()]].concat();
                let has = self.modules.contains_key(&path)
                    || inner.items.iter().any(|item| item == name)
                    || inner
                        .uses
                        .iter()
                        .any(|one| one.name == name && one.is_public);
                has.then_some(path)
            })
    }
}
