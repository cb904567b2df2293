//! Files that options name twice, which is wrong use.

use std::path::{Path, PathBuf};

use super::failure::{Failure, Outcome};
use dashpot_files::input::is_standard_stream;

/// Refuses `-` for more than one of `inputs`, each an option and the file it names.
///
/// # Errors
/// Two of them are `-`: standard input can be read once.
pub(super) fn refuse_second_standard_input(inputs: &[(&str, &Path)]) -> Outcome<()> {
    let options: Vec<&str> = inputs
        .iter()
        .filter(|(_, path)| is_standard_stream(path))
        .map(|(option, _)| *option)
        .collect();
    if options.len() > 1 {
        return Err(Failure::wrong_use(format!(
            "{}: `-` is standard input, which can be read for one of them only",
            options.join(" and ")
        )));
    }
    Ok(())
}

/// Refuses to write the file at `path`, as `option` asks, over the one at `input`.
///
/// # Errors
/// Both are the same file.
pub(super) fn refuse_input(option: &str, path: &Path, input: &Path) -> Outcome<()> {
    if is_standard_stream(path) || is_standard_stream(input) {
        return Ok(());
    }
    match (path.canonicalize(), input.canonicalize()) {
        (Ok(same), Ok(input)) if same == input => Err(Failure::wrong_use(format!(
            "{option} {}: is the input too; give another output file",
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// Refuses a file that `option` names twice.
///
/// # Errors
/// Two paths are the same file.
pub(super) fn refuse_twice(option: &str, inputs: &[PathBuf]) -> Outcome<()> {
    let files: Vec<_> = inputs.iter().map(|path| path.canonicalize().ok()).collect();
    for (number, file) in files.iter().enumerate() {
        if file.is_some() && files[..number].contains(file) {
            return Err(Failure::wrong_use(format!(
                "{option} {}: given twice, and would count twice; allowed: each file once",
                inputs[number].display()
            )));
        }
    }
    Ok(())
}

/// Refuses one file for two of `outputs`, each an option and the file it names.
///
/// # Errors
/// Two are the same file, however their paths are written.
pub(super) fn refuse_same_output(outputs: &[(&str, Option<&Path>)]) -> Outcome<()> {
    let place = |path: &Path| {
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize();
        folder.map_or_else(
            |_| path.to_owned(),
            |folder| folder.join(path.file_name().unwrap_or_default()),
        )
    };
    let outputs: Vec<(&str, &Path)> = outputs
        .iter()
        .filter_map(|(option, path)| Some((*option, (*path)?)))
        .collect();
    for (number, (option, path)) in outputs.iter().enumerate() {
        for (other, earlier) in &outputs[..number] {
            if place(path) == place(earlier) {
                return Err(Failure::wrong_use(format!(
                    "{other} and {option}: both are {}; give each a file of its own",
                    path.display()
                )));
            }
        }
    }
    Ok(())
}
