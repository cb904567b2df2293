//! docs/parameters.md lists every parameter of a damper file with its range and default.

use dashpot::document;
use dashpot_core::parameters::ranges;

const PAGE: &str = "docs/parameters.md";

/// Number as people write it.
fn number(value: f64) -> String {
    if value == 0.0 || (1e-3..1e4).contains(&value) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[test]
fn every_parameter_is_documented() {
    let mut table = String::from("\n| table | key | allowed | default |\n|---|---|---|---|\n");
    let mut last = "";
    for (name, range) in ranges() {
        let table_name = if name == last {
            String::new()
        } else {
            format!("`[{}]`", if name == "valves" { "valves.*" } else { name })
        };
        last = name;
        let default = range.default.map_or(String::new(), number);
        table += &format!(
            "| {table_name} | `{}` | {} | {default} |\n",
            range.key, range.allowed
        );
    }
    document::compare_part(PAGE, "parameters", &table);
}

#[test]
fn every_default_lies_in_its_range() {
    for (table, range) in ranges() {
        assert!(range.min < range.max, "{table}.{}", range.key);
        assert!(
            range.default.is_none_or(|value| range.contains(value)),
            "{table}.{}",
            range.key
        );
        assert!(!range.contains(f64::NAN));
    }
}
