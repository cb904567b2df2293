//! A vehicle, its external dampers and their connections as one file (System Structure and Parameterization 1.0).

use std::io::{Cursor, Write};

use zip::result::ZipResult;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::Fmu;
use super::variable::{Kind, UNITS, Unit, Variable};
use super::xml::Xml;

/// Namespaces of the standard.
const SPACES: [(&str, &str); 2] = [
    (
        "xmlns:ssd",
        "http://ssp-standard.org/SSP1/SystemStructureDescription",
    ),
    (
        "xmlns:ssc",
        "http://ssp-standard.org/SSP1/SystemStructureCommon",
    ),
];

/// An FMU as a part of a system.
pub struct Part<'a> {
    /// Name in the system; also that of its file.
    pub name: String,
    /// The FMU.
    pub fmu: &'a Fmu,
    /// Content of its file.
    pub content: Vec<u8>,
}

/// Packs a vehicle and its external dampers, in the order of the vehicle's terminals, as an SSP file. Each terminal of
/// the vehicle is connected with the damper's by the names of their members. The same content gives the same bytes.
///
/// # Errors
/// Returns an error if a file name is not valid in an archive.
pub fn system(name: &str, vehicle: &Part<'_>, dampers: &[Part<'_>]) -> ZipResult<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    zip.start_file("SystemStructure.ssd", options)?;
    zip.write_all(description(name, vehicle, dampers).as_bytes())?;
    for part in std::iter::once(vehicle).chain(dampers) {
        zip.start_file(part.file(), options)?;
        zip.write_all(&part.content)?;
    }
    Ok(zip.finish()?.into_inner())
}

/// Text of `SystemStructure.ssd`.
fn description(name: &str, vehicle: &Part<'_>, dampers: &[Part<'_>]) -> String {
    let mut xml = Xml::new();
    let tool = concat!("Dashpot ", env!("CARGO_PKG_VERSION"));
    let head = [
        &SPACES[..],
        &[("version", "1.0"), ("name", name), ("generationTool", tool)],
    ]
    .concat();
    xml.open("ssd:SystemStructureDescription", &head);
    xml.open("ssd:System", &[("name", name)]);
    xml.open("ssd:Elements", &[]);
    let parts = || std::iter::once(vehicle).chain(dampers);
    for part in parts() {
        part.component(&mut xml);
    }
    xml.close("ssd:Elements");
    xml.open("ssd:Connections", &[]);
    for (terminal, damper) in vehicle.fmu.terminals.iter().zip(dampers) {
        for (member, own) in &terminal.members {
            let others = damper
                .fmu
                .terminals
                .iter()
                .flat_map(|terminal| &terminal.members);
            for (_, other) in others.filter(|(name, _)| name == member) {
                let ends = match vehicle.fmu.is_input(own) {
                    false => [(vehicle, own), (damper, other)],
                    true => [(damper, other), (vehicle, own)],
                };
                let [(from, start), (to, end)] = ends;
                let connection = [
                    ("startElement", &*from.name),
                    ("startConnector", start),
                    ("endElement", &to.name),
                    ("endConnector", end),
                ];
                xml.empty("ssd:Connection", &connection);
            }
        }
    }
    xml.close("ssd:Connections");
    xml.close("ssd:System");
    xml.open("ssd:Units", &[]);
    let is_used = |unit: &&Unit| {
        let mut variables = parts().flat_map(|part| &part.fmu.variables);
        variables.any(|variable| variable.unit == unit.name)
    };
    for unit in UNITS.iter().filter(is_used) {
        xml.open("ssc:Unit", &[("name", unit.name)]);
        xml.line(&format!("<ssc:BaseUnit {}/>", unit.base));
        xml.close("ssc:Unit");
    }
    xml.close("ssd:Units");
    let stop = vehicle.fmu.stop_s.to_string();
    xml.empty(
        "ssd:DefaultExperiment",
        &[("startTime", "0"), ("stopTime", &stop)],
    );
    xml.close("ssd:SystemStructureDescription");
    xml.text
}

impl Part<'_> {
    fn file(&self) -> String {
        format!("resources/{}.fmu", self.name)
    }

    /// True for all variables but inputs of no terminal: some importers set inputs without a connection to zero.
    fn has_connector(&self, variable: &Variable) -> bool {
        let mut members = self
            .fmu
            .terminals
            .iter()
            .flat_map(|terminal| &terminal.members);
        let is_connected = members.any(|(_, name)| *name == variable.name);
        is_connected || !matches!(variable.kind, Kind::Input { .. })
    }

    fn component(&self, xml: &mut Xml) {
        let file = self.file();
        let head = [
            ("name", &*self.name),
            ("type", "application/x-fmu-sharedlibrary"),
            ("source", &file),
        ];
        xml.open("ssd:Component", &head);
        xml.open("ssd:Connectors", &[]);
        let variables = self.fmu.variables.iter();
        for variable in variables.filter(|variable| self.has_connector(variable)) {
            let kind = match variable.kind {
                Kind::Input { .. } => "input",
                Kind::Output | Kind::Counter => "output",
                Kind::Tunable { .. } => "parameter",
            };
            xml.open("ssd:Connector", &[("name", &variable.name), ("kind", kind)]);
            match variable.kind {
                Kind::Counter => xml.empty("ssc:Integer", &[]),
                _ if variable.unit.is_empty() => xml.empty("ssc:Real", &[]),
                _ => xml.empty("ssc:Real", &[("unit", variable.unit)]),
            }
            xml.close("ssd:Connector");
        }
        xml.close("ssd:Connectors");
        xml.close("ssd:Component");
    }
}

impl Fmu {
    fn is_input(&self, name: &str) -> bool {
        let is_it = |variable: &&Variable| variable.name == name;
        let found = self.variables.iter().find(is_it);
        found.is_some_and(|variable| matches!(variable.kind, Kind::Input { .. }))
    }
}
