//! Measured values, parameters, units and groups.

use std::collections::BTreeSet;
use std::fmt::{self, Write};

use super::layout::{MEASUREMENTS, PARAMETERS, VALUE_BYTES};
use super::{Description, ascii, identifier, quoted};

/// Limits of a measured value: none are known.
const LIMIT: &str = "1.7e308";

pub(super) fn write(out: &mut String, slave: &Description) -> fmt::Result {
    writeln!(
        out,
        "/begin RECORD_LAYOUT value FNC_VALUES 1 FLOAT64_IEEE ROW_DIR DIRECT /end RECORD_LAYOUT"
    )?;
    let units = slave.measurements.iter().map(|value| &value.unit);
    let units = units.chain(slave.parameters.iter().map(|value| &value.unit));
    for unit in units.map(String::as_str).collect::<BTreeSet<_>>() {
        let (method, shown) = (method(unit), shown(unit));
        writeln!(
            out,
            "/begin COMPU_METHOD {method} \"\" IDENTICAL \"%12.6\" {} /end COMPU_METHOD",
            quoted(&shown)
        )?;
    }
    for (index, value) in slave.measurements.iter().enumerate() {
        let name = identifier(&value.name);
        let (description, unit) = (quoted(&value.description), method(&value.unit));
        let address = address(MEASUREMENTS, index);
        writeln!(
            out,
            "/begin MEASUREMENT {name} {description} FLOAT64_IEEE {unit} 0 0 -{LIMIT} {LIMIT}\n  \
             ECU_ADDRESS {address:#010x}\n  \
             /begin IF_DATA XCP /begin DAQ_EVENT FIXED_EVENT_LIST EVENT 0 /end DAQ_EVENT /end IF_DATA\n\
             /end MEASUREMENT"
        )?;
    }
    for (index, value) in slave.parameters.iter().enumerate() {
        let name = path(&value.name);
        let (description, unit) = (quoted(&value.description), method(&value.unit));
        let address = address(PARAMETERS, index);
        writeln!(
            out,
            "/begin CHARACTERISTIC {name} {description} VALUE {address:#010x} value 0 {unit} {} {}\n\
             /end CHARACTERISTIC",
            value.min, value.max
        )?;
    }
    write_groups(out, slave)
}

/// One group of measured values, and one of the parameters of each damper.
fn write_groups(out: &mut String, slave: &Description) -> fmt::Result {
    let mut group = |name: &str, kind: &str, members: Vec<String>| {
        writeln!(
            out,
            "/begin GROUP {name} \"\" ROOT\n  /begin REF_{kind} {} /end REF_{kind}\n/end GROUP",
            members.join(" ")
        )
    };
    if !slave.measurements.is_empty() {
        let names = slave.measurements.iter();
        let names = names.map(|value| identifier(&value.name)).collect();
        group("measured", "MEASUREMENT", names)?;
    }
    let owner = |name: &str| identifier(name.split('.').next().unwrap_or(name));
    for owned in slave
        .parameters
        .chunk_by(|a, b| owner(&a.name) == owner(&b.name))
    {
        let names = owned.iter().map(|value| path(&value.name)).collect();
        let name = owned.first().map(|value| owner(&value.name));
        let name = format!("parameters_of_{}", name.unwrap_or_default());
        group(&name, "CHARACTERISTIC", names)?;
    }
    Ok(())
}

/// A name whose parts are separated by points.
fn path(name: &str) -> String {
    let parts: Vec<String> = name.split('.').map(identifier).collect();
    parts.join(".")
}

fn address(first: u32, index: usize) -> u32 {
    first + VALUE_BYTES * index as u32
}

/// Name of the conversion method of a unit.
fn method(unit: &str) -> String {
    let unit = ascii(unit).replace('/', "_per_");
    format!(
        "unit_{}",
        unit.replace(|letter: char| !letter.is_ascii_alphanumeric(), "_")
    )
}

/// A unit as a tool shows it.
fn shown(unit: &str) -> String {
    match unit {
        "1" => String::new(),
        unit => ascii(unit),
    }
}
