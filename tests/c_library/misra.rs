//! Compares what cppcheck's MISRA addon finds in the exported C with the record in docs/misra.md. The addon knows only
//! the numbers of rules, because their texts may not be distributed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use dashpot::controller::succeed;
use dashpot::{damper, document};
use dashpot_core::DamperParameters;
use dashpot_core::health::HealthSettings;
use dashpot_export::{
    Provenance, Word, c_header, c_source, health_c_header, health_c_source, standalone_header,
    standalone_source, transfer_header, transfer_source,
};
use xtask::tools::{CPPCHECK, PYTHON, have};

const RECORD: &str = "docs/misra.md";
const PROVENANCE: Provenance<'static> = Provenance {
    damper: "a damper",
    step_us: 1000.0,
    command: "a test",
};
/// Definitions of GCC for a Cortex-M7; without them the checker sees what a compiler without extensions sees.
const CORTEX_M7: [&str; 3] = ["-D__GNUC__=12", "-D__ARM_FP=12", "-D__ARM_FPV5__"];
/// Values of float.h, because the checker reads no header of the system.
const FLOAT_H: [&str; 4] = [
    "-DFLT_EVAL_METHOD=0",
    "-DFLT_RADIX=2",
    "-DFLT_MANT_DIG=24",
    "-DDBL_MANT_DIG=53",
];
/// What the record calls the exports, in the order of its columns.
const COLUMNS: [&str; 3] = ["damper", "transfer system", "header of the C library"];
/// Places that a cell lists by name; of more it has the number.
const MAX_NAMES: usize = 20;

/// Number of findings for each rule and place.
type Findings = BTreeMap<(Rule, String), usize>;

/// Number of a rule, in the order of the standard.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Rule(u32, u32);

impl Rule {
    fn parse(text: &str) -> Option<Self> {
        let (section, number) = text.split_once('.')?;
        Some(Self(section.parse().ok()?, number.parse().ok()?))
    }
}

impl std::fmt::Display for Rule {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}.{}", self.0, self.1)
    }
}

/// Exported C in a folder: column of the record, prefix of its names, source file.
struct Export {
    column: usize,
    prefix: &'static str,
    file: String,
    /// Also checked as GCC for a Cortex-M7 sees it.
    has_extensions: bool,
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("a writable folder");
}

/// A damper as header and source, or as one source.
fn standalone<T: Word>(
    folder: &Path,
    prefix: &'static str,
    parameters: &DamperParameters,
    step_s: f64,
    has_header: bool,
) -> Export {
    let constant = prefix.to_uppercase();
    let damper = parameters.build::<T>(step_s).expect("a valid damper");
    let header = standalone_header(&constant, &damper, &PROVENANCE).expect("a name");
    let included = format!("{prefix}.h");
    write(folder, &included, &header);
    let included = has_header.then_some(included);
    let source = standalone_source(&constant, &damper, &PROVENANCE, included.as_deref());
    let file = format!("{prefix}.c");
    write(folder, &file, &source.expect("a name"));
    Export {
        column: 0,
        prefix,
        file,
        has_extensions: prefix == "in_service",
    }
}

/// One export for each option of `dashpot export --lang c` and `dashpot hybrid export`, and the C library's header.
fn exports(folder: &Path) -> Vec<Export> {
    let in_service = damper("in-service", &[]);
    let valves = damper("reduced-vertical", &["mount.clearance_m=1e-3"]);
    let mut exports = vec![
        standalone::<f32>(folder, "in_service", &in_service, 1e-3, true),
        standalone::<f64>(folder, "double_precision", &in_service, 5e-4, true),
        standalone::<f32>(folder, "one_source", &valves, 1e-3, false),
    ];
    let built = in_service.build::<f32>(1e-3).expect("a valid damper");
    write(
        folder,
        "image.h",
        &c_header("IMAGE", &built, &PROVENANCE).expect("a name"),
    );
    write(
        folder,
        "image.c",
        &c_source("IMAGE", &built, &PROVENANCE).expect("a name"),
    );
    let checked = in_service.check().expect("a valid damper");
    let model = checked
        .health_model(&HealthSettings::new(6e-5, 60.0), 1e-3)
        .expect("a model");
    write(
        folder,
        "health.h",
        &health_c_header("HEALTH", &PROVENANCE).expect("a name"),
    );
    write(
        folder,
        "health.c",
        &health_c_source("HEALTH", &model, &PROVENANCE).expect("a name"),
    );
    write(
        folder,
        "transfer.h",
        &transfer_header("TRANSFER", "a test").expect("a name"),
    );
    let source = transfer_source("TRANSFER", "a test", Some("transfer.h"));
    write(folder, "transfer.c", &source.expect("a name"));
    write(
        folder,
        "library.h",
        &document::read("capi/include/dashpot.h"),
    );
    write(folder, "library.c", "#include \"library.h\"\n");
    let more = [(0, "image"), (0, "health"), (1, "transfer"), (2, "dashpot")];
    exports.extend(more.map(|(column, prefix)| Export {
        column,
        prefix,
        file: format!("{}.c", if column == 2 { "library" } else { prefix }),
        has_extensions: column == 1,
    }));
    exports
}

/// What the checker prints. One runs after the other, because their temporary files have the same names.
fn check(folder: &Path, file: &str, compiler: &[&str]) -> String {
    let mut command = Command::new(CPPCHECK.program);
    command.args([
        "--quiet",
        "--std=c99",
        "--addon=misra",
        "--enable=warning,style",
    ]);
    command.arg("--template={file}:{line}:{severity}:{id}");
    command
        .args(FLOAT_H)
        .args(compiler)
        .arg(file)
        .current_dir(folder);
    String::from_utf8_lossy(&succeed(&mut command).stderr).into_owned()
}

/// The function, type or macro that contains a line, without the prefix of its name.
fn place(text: &str, line: usize, prefix: &str) -> String {
    let before: Vec<&str> = text.lines().take(line).collect();
    let starts =
        |line: &&&str| line.starts_with(char::is_alphabetic) || line.starts_with("#define ");
    let declaration = before.iter().rev().find(starts).expect("a declaration");
    let name = match declaration.strip_prefix("#define ") {
        Some(rest) => rest.split([' ', '(']).next(),
        None => declaration
            .split(['(', '{'])
            .next()
            .and_then(|head| head.split_whitespace().last()),
    };
    let name = name.expect("a name").trim_start_matches('*').to_owned();
    for prefix in [format!("{prefix}_"), format!("{}_", prefix.to_uppercase())] {
        if let Some(rest) = name.strip_prefix(&prefix) {
            return rest.to_owned();
        }
    }
    name
}

/// What the addon finds in one export with one compiler.
fn findings(folder: &Path, export: &Export, printed: &str) -> Findings {
    let mut found = Findings::new();
    for line in printed
        .lines()
        .filter(|line| line.contains(".c:") || line.contains(".h:"))
    {
        let [file, line, severity, id] = line.splitn(4, ':').collect::<Vec<_>>()[..] else {
            panic!("{}: {line}", export.file);
        };
        let Some(rule) = id.strip_prefix("misra-c2012-").and_then(Rule::parse) else {
            assert!(
                !["error", "warning"].contains(&severity),
                "{file}:{line}: {id}"
            );
            continue;
        };
        let text = std::fs::read_to_string(folder.join(file)).expect("an exported file");
        let line = line.parse().expect("a line number");
        *found
            .entry((rule, place(&text, line, export.prefix)))
            .or_default() += 1;
    }
    found
}

/// Most findings of any export and compiler, for each column of the record.
fn all() -> [Findings; COLUMNS.len()] {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut all = <[Findings; COLUMNS.len()]>::default();
    for export in exports(folder.path()) {
        let compilers: &[&[&str]] = if export.has_extensions {
            &[&[], &CORTEX_M7]
        } else {
            &[&[]]
        };
        for compiler in compilers {
            let printed = check(folder.path(), &export.file, compiler);
            for (key, count) in findings(folder.path(), &export, &printed) {
                let most = all[export.column].entry(key).or_default();
                *most = count.max(*most);
            }
        }
    }
    all
}

fn cell(found: &Findings, rule: Rule) -> String {
    let places = found.iter().filter(|((of, _), _)| *of == rule);
    let names: Vec<String> = places
        .map(|((_, place), &count)| match count {
            1 => format!("`{place}`"),
            _ => format!("`{place}` {count}"),
        })
        .collect();
    if names.len() > MAX_NAMES {
        return format!("{} places", names.len());
    }
    names.join(", ")
}

#[test]
fn the_record_lists_what_the_addon_finds() {
    if !have(&[CPPCHECK, PYTHON], "the record of MISRA deviations") {
        return;
    }
    let all = all();
    let rules: BTreeSet<Rule> = all
        .iter()
        .flat_map(|found| found.keys().map(|(rule, _)| *rule))
        .collect();
    let mut table = format!(
        "\n| rule | {} |\n|---|{}\n",
        COLUMNS.join(" | "),
        "---|".repeat(COLUMNS.len())
    );
    for rule in &rules {
        let cells = all.each_ref().map(|found| cell(found, *rule));
        table += &format!("| {rule} | {} |\n", cells.join(" | "));
    }
    document::compare_part(RECORD, "places", &(table + "\n"));

    let record = document::read(RECORD);
    let explained = record
        .lines()
        .filter_map(|line| line.strip_prefix("### Rule "));
    let explained: BTreeSet<Rule> = explained
        .map(|heading| {
            let number = heading.strip_suffix(", advisory").unwrap_or_else(|| {
                panic!("{RECORD}: `{heading}`: only advisory rules may be deviated from")
            });
            Rule::parse(number).expect("the number of a rule")
        })
        .collect();
    let numbers = |rules: &BTreeSet<Rule>| rules.iter().map(Rule::to_string).collect::<Vec<_>>();
    assert_eq!(
        numbers(&explained),
        numbers(&rules),
        "{RECORD}: a section for each rule of the table"
    );
}

#[test]
fn findings_are_placed_in_functions_types_and_macros() {
    let text = "#define IN_SERVICE_DIGEST 1U\nstatic int in_service_step(const int *a,\n        int b)\n{\n    ;\n}\n\
                typedef union in_service_word {\n    int a;\n";
    let at = |line| place(text, line, "in_service");
    assert_eq!(
        ["DIGEST", "step", "word"],
        [at(1), at(5), at(8)].each_ref().map(String::as_str)
    );
}
