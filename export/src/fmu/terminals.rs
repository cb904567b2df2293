//! Terminals, which connect several variables at once, and the icon (FMI 3.0, sections 2.5.1.5 and 2.4.9).

use super::xml::Xml;
use super::{Fmu, Interface};

/// Files of the icon: FMI 2 has one name at the top, FMI 3 a folder with both forms.
const PNG: &[u8] = include_bytes!("icon.png");
const SVG: &[u8] = include_bytes!("icon.svg");

/// Variables that belong together: those of one end of a connection.
pub(super) struct Terminal {
    pub name: String,
    pub description: &'static str,
    /// Names in the terminal, by which a `plug` is connected, and names of the variables.
    pub members: Vec<(&'static str, String)>,
}

impl Fmu {
    /// Names and contents of the files with the icon and the terminals.
    pub(super) fn icon_files(&self) -> Vec<(&'static str, Vec<u8>)> {
        match self.interface {
            Interface::Two => vec![("model.png", PNG.to_vec())],
            Interface::Three => vec![
                ("terminalsAndIcons/icon.png", PNG.to_vec()),
                ("terminalsAndIcons/icon.svg", SVG.to_vec()),
                (
                    "terminalsAndIcons/terminalsAndIcons.xml",
                    self.terminals_and_icons().into_bytes(),
                ),
            ],
        }
    }

    fn terminals_and_icons(&self) -> String {
        let mut xml = Xml::new();
        let square = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
        xml.open("fmiTerminalsAndIcons", &[("fmiVersion", "3.0")]);
        xml.open("GraphicalRepresentation", &[]);
        let scale = [&square[..], &[("suggestedScalingFactorTo_mm", "0.1")]].concat();
        xml.empty("CoordinateSystem", &scale);
        xml.empty("Icon", &square);
        xml.close("GraphicalRepresentation");
        xml.open("Terminals", &[]);
        for terminal in &self.terminals {
            let head = [
                ("name", &*terminal.name),
                ("matchingRule", "plug"),
                ("description", terminal.description),
            ];
            xml.open("Terminal", &head);
            for (member, variable) in &terminal.members {
                let names = [
                    ("variableName", &**variable),
                    ("memberName", member),
                    ("variableKind", "signal"),
                ];
                xml.empty("TerminalMemberVariable", &names);
            }
            xml.close("Terminal");
        }
        xml.close("Terminals");
        xml.close("fmiTerminalsAndIcons");
        xml.text
    }
}
