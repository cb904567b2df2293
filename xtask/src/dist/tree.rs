//! Folders whose files become an archive.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, git, output_of, repository};

/// A folder that is empty at first.
#[derive(Debug)]
pub struct Tree {
    folder: PathBuf,
}

impl Tree {
    /// Makes the folder, or empties it.
    ///
    /// # Errors
    /// It cannot be made or emptied.
    pub fn new(folder: PathBuf) -> Outcome<Self> {
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(|error| failed(&folder, error))?;
        }
        fs::create_dir_all(&folder).map_err(|error| failed(&folder, error))?;
        Ok(Self { folder })
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Copies a file of any place.
    ///
    /// # Errors
    /// It cannot be read or written.
    pub fn copy(&self, from: &Path, to: &str) -> Outcome {
        fs::copy(from, self.place(to)?)
            .map(drop)
            .map_err(|error| failed(from, error))
    }

    /// Copies the committed files at or below `path` of the repository to the same places.
    ///
    /// # Errors
    /// No such file is committed, or one cannot be read or written.
    pub fn copy_committed(&self, path: &str) -> Outcome {
        let list = git(&["ls-files", "--", path])?;
        if list.is_empty() {
            return Err(format!("{path}: no such file is committed"));
        }
        for file in list.lines() {
            self.copy(&repository().join(file), file)?;
        }
        Ok(())
    }

    /// Copies all files of a folder, and links as links.
    ///
    /// # Errors
    /// One cannot be read or written.
    pub fn copy_folder(&self, from: &Path, to: &str) -> Outcome {
        let parent = self.place(to)?;
        let mut copy = Command::new("cp");
        copy.args(["--recursive", "--no-dereference", "--preserve=links"]);
        copy.arg(from).arg(&parent);
        output_of(copy, &format!("cp {} {}", from.display(), parent.display())).map(drop)
    }

    /// Writes a file.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, to: &str, content: impl AsRef<[u8]>) -> Outcome {
        let path = self.place(to)?;
        fs::write(&path, content).map_err(|error| failed(&path, error))
    }

    /// Path of a file, whose folder is made.
    ///
    /// # Errors
    /// The folder cannot be made.
    pub fn place(&self, to: &str) -> Outcome<PathBuf> {
        let path = self.folder.join(to);
        let parent = path.parent().unwrap_or(&self.folder);
        fs::create_dir_all(parent).map_err(|error| failed(parent, error))?;
        Ok(path)
    }
}

/// Says which file or folder an error is about.
pub fn failed(path: &Path, error: std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::Tree;

    #[test]
    fn only_committed_files_are_copied() {
        let folder = tempfile::tempdir().unwrap();
        let tree = Tree::new(folder.path().join("tree")).unwrap();
        tree.copy_committed("data/dampers").unwrap();
        tree.copy_committed("README.md").unwrap();
        assert!(tree.folder().join("data/dampers/paper.toml").is_file());
        assert!(tree.folder().join("README.md").is_file());
        let error = tree.copy_committed("target").unwrap_err();
        assert_eq!(error, "target: no such file is committed");
    }

    #[test]
    fn a_tree_begins_empty() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tree");
        Tree::new(path.clone())
            .unwrap()
            .write("a/b", "old")
            .unwrap();
        assert!(!Tree::new(path).unwrap().folder().join("a").exists());
    }
}
