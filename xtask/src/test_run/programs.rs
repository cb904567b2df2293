//! The test programs of the workspace, as cargo builds them.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::run::{Outcome, cargo_command, output_of};

/// Programs that take longest. They begin first, so that none of them runs alone at the end.
const LONGEST: [&str; 5] = ["commands", "on_target", "vehicle", "runs", "pages"];

/// A program with tests.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TestProgram {
    /// Package and target, such as `dashpot-hil commands`.
    pub name: String,
    path: PathBuf,
    folder: PathBuf,
}

/// All test programs, and what they need to run.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Built {
    pub programs: Vec<TestProgram>,
    /// Variables with the paths of commands that tests start.
    commands: Vec<(String, PathBuf)>,
    /// Folders with shared libraries.
    libraries: Vec<PathBuf>,
}

/// Builds all test programs.
///
/// # Errors
/// One does not compile.
pub(super) fn built() -> Outcome<Built> {
    let build = ["test", "--workspace", "--no-run"];
    let json = ["--message-format", "json-render-diagnostics"];
    let line = format!("cargo {}", build.join(" "));
    eprintln!("> {line}");
    let mut command = cargo_command(&build);
    // What the compiler says goes to standard error as it comes.
    command.args(json).stderr(Stdio::inherit());
    let mut built = Built::of(&output_of(command, &line)?);
    let mut sysroot = Command::new("rustc");
    sysroot.args(["--print", "sysroot"]);
    let sysroot = output_of(sysroot, "rustc --print sysroot")?;
    built.libraries.push(Path::new(sysroot.trim()).join("lib"));
    Ok(built)
}

impl Built {
    /// Reads the messages of cargo, one a line.
    fn of(messages: &str) -> Self {
        let mut built = Self::default();
        let messages = messages
            .lines()
            .filter_map(|line| serde_json::from_str(line).ok());
        for message in messages {
            built.add(&message);
        }
        let place = |program: &TestProgram| {
            let is_it = |long: &&str| program.name.split(' ').next_back() == Some(*long);
            LONGEST.iter().position(is_it).unwrap_or(LONGEST.len())
        };
        built.programs.sort_by_key(place);
        built
    }

    fn add(&mut self, message: &Value) {
        let (Some(path), Some(manifest)) = (
            message["executable"].as_str(),
            message["manifest_path"].as_str(),
        ) else {
            return;
        };
        let path = PathBuf::from(path);
        let folder = Path::new(manifest).parent().unwrap_or(Path::new("."));
        let target = message["target"]["name"].as_str().unwrap_or_default();
        if message["profile"]["test"] == true {
            let package = folder.file_name().unwrap_or_default().to_string_lossy();
            self.programs.push(TestProgram {
                name: format!("{package} {target}"),
                folder: folder.to_owned(),
                path,
            });
        } else if message["target"]["kind"][0] == "bin" {
            let variable = format!("CARGO_BIN_EXE_{target}");
            if let Some(libraries) = path.parent() {
                self.libraries.push(libraries.join("deps"));
            }
            self.commands.push((variable, path));
        }
    }

    /// The command that runs the tests of a program, as cargo does.
    pub fn command(&self, program: &TestProgram) -> Command {
        let mut command = Command::new(&program.path);
        command
            .current_dir(&program.folder)
            .env("CARGO_MANIFEST_DIR", &program.folder)
            .envs(self.commands.iter().map(|(name, path)| (name, path)));
        let before = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
        let all = self
            .libraries
            .iter()
            .cloned()
            .chain(std::env::split_paths(&before));
        if let Ok(all) = std::env::join_paths(all) {
            command.env("LD_LIBRARY_PATH", all);
        }
        command
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::Built;

    fn artifact(folder: &str, kind: &str, name: &str, tested: bool, path: Option<&str>) -> String {
        json!({
            "reason": "compiler-artifact", "manifest_path": format!("/d/{folder}/Cargo.toml"),
            "target": {"kind": [kind], "name": name}, "profile": {"test": tested}, "executable": path,
        })
        .to_string()
    }

    #[test]
    fn programs_are_read_from_the_messages_of_cargo() {
        let messages = [
            artifact("core", "lib", "dashpot_core", false, None),
            artifact("core", "lib", "dashpot_core", true, Some("/d/deps/core-1")),
            artifact("hil-host", "bin", "dashpot", false, Some("/d/dashpot")),
            artifact(
                "hil-host",
                "test",
                "commands",
                true,
                Some("/d/deps/commands-2"),
            ),
            "nonsense".into(),
        ];
        let built = Built::of(&messages.join("\n"));
        let programs = built.programs.iter();
        let names: Vec<&str> = programs.map(|program| &*program.name).collect();
        assert_eq!(names, ["hil-host commands", "core dashpot_core"]);
        let command = built.command(&built.programs[0]);
        assert_eq!(command.get_program(), "/d/deps/commands-2");
        assert_eq!(
            command.get_current_dir().unwrap().to_str(),
            Some("/d/hil-host")
        );
        let mut variables = command.get_envs();
        let found = variables.find(|(name, _)| *name == "CARGO_BIN_EXE_dashpot");
        assert_eq!(found.unwrap().1.unwrap(), "/d/dashpot");
    }
}
