//! Archives whose bytes depend only on the files in them.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::Command;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::tree::failed;
use crate::run::{Outcome, output_of, run};

/// Packs the folder `name` in `parent` into a compressed tar file. All files have the time `time` and no owner.
///
/// # Errors
/// tar fails.
pub fn tar_gz(parent: &Path, name: &str, archive: &Path, time: &str) -> Outcome {
    let mut tar = Command::new("tar");
    tar.args(["--create", "--sort=name", "--format=gnu"])
        .args(["--owner=0", "--group=0", "--numeric-owner"])
        .args(["--mode=u=rwX,go=rX", &format!("--mtime=@{time}")])
        .args(["--use-compress-program=gzip --no-name --best"])
        .arg("--file")
        .arg(archive)
        .arg("--directory")
        .arg(parent)
        .arg(name);
    run(tar, &format!("tar {}", archive.display()))
}

/// Packs the folder `name` in `parent` into a zip file. All files have the same time.
///
/// # Errors
/// A file cannot be read or written.
pub fn zip(parent: &Path, name: &str, archive: &Path) -> Outcome {
    let file = File::create(archive).map_err(|error| failed(archive, error))?;
    let mut writer = ZipWriter::new(BufWriter::new(file));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(9))
        .last_modified_time(DateTime::default());
    for path in files(&parent.join(name))? {
        let below = path.strip_prefix(parent).unwrap_or(&path);
        let content = fs::read(&path).map_err(|error| failed(&path, error))?;
        writer
            .start_file_from_path(below, options)
            .map_err(std::io::Error::from)
            .and_then(|()| writer.write_all(&content))
            .map_err(|error| failed(&path, error))?;
    }
    let written = writer.finish().map_err(std::io::Error::from);
    written
        .and_then(|mut file| file.flush())
        .map_err(|error| failed(archive, error))
}

/// Writes `SHA256SUMS` with the digest of each file in `folder`, as `sha256sum --check` reads it.
///
/// # Errors
/// A file cannot be read, or the list cannot be written.
pub fn digests(folder: &Path) -> Outcome {
    const LIST: &str = "SHA256SUMS";
    let list = folder.join(LIST);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| failed(folder, error))? {
        let entry = entry.map_err(|error| failed(folder, error))?;
        if entry.path().is_file() && entry.file_name() != LIST {
            names.push(entry.file_name());
        }
    }
    names.sort();
    let mut sum = Command::new("sha256sum");
    sum.args(names).current_dir(folder);
    let text = output_of(sum, "sha256sum")?;
    fs::write(&list, text).map_err(|error| failed(&list, error))
}

/// Returns all files below a folder, sorted.
fn files(folder: &Path) -> Outcome<Vec<std::path::PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| failed(folder, error))? {
        let path = entry.map_err(|error| failed(folder, error))?.path();
        match path.is_dir() {
            true => found.extend(files(&path)?),
            false => found.push(path),
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;
    use std::time::{Duration, SystemTime};

    use super::{digests, tar_gz, zip};

    /// Two folders with the same files, made in another order and at other times, give the same bytes.
    #[test]
    fn archives_depend_on_names_and_contents_only() {
        let folder = tempfile::tempdir().unwrap();
        let make = |parent: &str, names: [&str; 3], age_s: u64| {
            let parent = folder.path().join(parent);
            for name in names {
                let path = parent.join("dashpot").join(name);
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(&path, name).unwrap();
                let time = SystemTime::now() - Duration::from_secs(age_s);
                fs::File::options()
                    .write(true)
                    .open(&path)
                    .and_then(|file| file.set_modified(time))
                    .unwrap();
            }
            tar_gz(&parent, "dashpot", &parent.join("a.tar.gz"), "1000000000").unwrap();
            zip(&parent, "dashpot", &parent.join("a.zip")).unwrap();
            digests(&parent).unwrap();
            let read = |name: &str| fs::read(parent.join(name)).unwrap();
            (read("a.tar.gz"), read("a.zip"), read("SHA256SUMS"))
        };
        let first = make("first", ["bin/a", "b", "share/c"], 0);
        let second = make("second", ["share/c", "b", "bin/a"], 100_000);
        assert!(first == second);
        let list = String::from_utf8(first.2).unwrap();
        assert!(
            list.lines().count() == 2 && list.contains("  a.zip\n"),
            "{list}"
        );
    }

    #[test]
    fn a_missing_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let error = zip(folder.path(), "none", Path::new("/nowhere/a.zip")).unwrap_err();
        assert!(error.starts_with("/nowhere/a.zip: "), "{error}");
    }
}
