//! Description of an FMU: `modelDescription.xml`, and `buildDescription.xml` of FMI 3.

use super::variable::{Kind, UNITS, Unit, Variable};
use super::xml::Xml;
use super::{Fmu, Interface};

/// No output depends on an input at the same communication point, so a loop of connected FMUs is never an algebraic
/// loop.
const NO_DEPENDENCIES: (&str, &str) = ("dependencies", "");

/// Whose work the FMU is, as in CITATION.cff and the licence.
const AUTHOR: &str = "The Dashpot developers";
const COPYRIGHT: &str = "Copyright (c) 2026 The Dashpot developers";
const LICENCE: &str = "MIT OR Apache-2.0; the text of the first is in documentation/licenses";

const CATEGORIES: [(&str, &str); 3] = [
    (
        "logStatusWarning",
        "Held or limited input, or the end of the run",
    ),
    ("logStatusDiscard", "Refused calls"),
    (
        "logStatusError",
        "Calls after which the instance must be reset",
    ),
];

impl Fmu {
    /// Text of `modelDescription.xml`.
    pub(super) fn description(&self) -> String {
        let mut xml = Xml::new();
        let version = concat!("Dashpot ", env!("CARGO_PKG_VERSION"));
        // Only the run of a vehicle may end. Its variables contain names from the vehicle file, which need not follow
        // the structured convention.
        let naming = if self.may_end { "flat" } else { "structured" };
        let (number, token, state) = match self.interface {
            Interface::Two => ("2.0", "guid", "FMUstate"),
            Interface::Three => ("3.0", "instantiationToken", "FMUState"),
        };
        xml.open(
            "fmiModelDescription",
            &[
                ("fmiVersion", number),
                ("modelName", &self.identifier),
                (token, &self.token),
                ("description", &self.title),
                ("author", AUTHOR),
                ("version", env!("CARGO_PKG_VERSION")),
                ("copyright", COPYRIGHT),
                ("license", LICENCE),
                ("generationTool", version),
                ("variableNamingConvention", naming),
            ],
        );
        let step = self.step_s.to_string();
        let can_get = format!("canGetAndSet{state}");
        let can_serialize = format!("canSerialize{state}");
        let mut capabilities = vec![
            ("modelIdentifier", &*self.identifier),
            ("canHandleVariableCommunicationStepSize", "true"),
            (&can_get, "true"),
            (&can_serialize, "true"),
        ];
        match self.interface {
            Interface::Two => {
                if self.has_input_derivatives {
                    capabilities.push(("canInterpolateInputs", "true"));
                }
                capabilities.push(("canNotUseMemoryManagementFunctions", "true"));
                if !self.has_sources() {
                    xml.empty("CoSimulation", &capabilities);
                } else {
                    xml.open("CoSimulation", &capabilities);
                    xml.open("SourceFiles", &[]);
                    for name in self.compiled() {
                        xml.empty("File", &[("name", name)]);
                    }
                    xml.close("SourceFiles");
                    xml.close("CoSimulation");
                }
            }
            Interface::Three => {
                capabilities.push(("fixedInternalStepSize", &step));
                if self.may_end {
                    capabilities.push(("mightReturnEarlyFromDoStep", "true"));
                }
                xml.empty("CoSimulation", &capabilities);
            }
        }
        xml.open("UnitDefinitions", &[]);
        let is_used = |unit: &&Unit| {
            self.variables
                .iter()
                .any(|variable| variable.unit == unit.name)
        };
        for unit in UNITS.iter().filter(is_used) {
            xml.open("Unit", &[("name", unit.name)]);
            xml.line(&format!("<BaseUnit {}/>", unit.base));
            if let Some((name, factor)) = unit.display {
                xml.empty("DisplayUnit", &[("name", name), ("factor", factor)]);
            }
            xml.close("Unit");
        }
        xml.close("UnitDefinitions");
        xml.open("LogCategories", &[]);
        for (name, description) in CATEGORIES {
            xml.empty("Category", &[("name", name), ("description", description)]);
        }
        xml.close("LogCategories");
        let stop = self.stop_s.to_string();
        let experiment = [
            ("startTime", "0"),
            ("stopTime", &*stop),
            ("stepSize", &step),
        ];
        xml.empty("DefaultExperiment", &experiment);
        self.variables(&mut xml);
        xml.close("fmiModelDescription");
        xml.text
    }

    /// Text of `buildDescription.xml` (FMI 3).
    pub(super) fn build_description(&self) -> String {
        let mut xml = Xml::new();
        xml.open("fmiBuildDescription", &[("fmiVersion", "3.0")]);
        xml.open(
            "BuildConfiguration",
            &[("modelIdentifier", &self.identifier)],
        );
        xml.open("SourceFileSet", &[("language", "C99")]);
        for name in self.compiled() {
            xml.empty("SourceFile", &[("name", name)]);
        }
        // This definition is for a shared library; in a static library, the functions have the prefix.
        let definition = [("name", "FMI3_OVERRIDE_FUNCTION_PREFIX"), ("value", "1")];
        xml.empty("PreprocessorDefinition", &definition);
        xml.close("SourceFileSet");
        xml.close("BuildConfiguration");
        xml.close("fmiBuildDescription");
        xml.text
    }

    fn variables(&self, xml: &mut Xml) {
        xml.open("ModelVariables", &[]);
        // FMI 2 needs no variable for the time, and old importers ask for its start value, which the standard forbids.
        if self.interface == Interface::Three {
            self.variable(xml, 0, None);
        }
        let mut outputs = Vec::new();
        for (reference, variable) in (1..).zip(&self.variables) {
            self.variable(xml, reference, Some(variable));
            if matches!(variable.kind, Kind::Output | Kind::Counter) {
                outputs.push(reference);
            }
        }
        xml.close("ModelVariables");
        xml.open("ModelStructure", &[]);
        match self.interface {
            Interface::Two => {
                for list in ["Outputs", "InitialUnknowns"] {
                    xml.open(list, &[]);
                    for reference in &outputs {
                        // Position in the list of variables, which is the reference.
                        let index = reference.to_string();
                        xml.empty("Unknown", &[("index", &index), NO_DEPENDENCIES]);
                    }
                    xml.close(list);
                }
            }
            Interface::Three => {
                for element in ["Output", "InitialUnknown"] {
                    for reference in &outputs {
                        let reference = reference.to_string();
                        xml.empty(element, &[("valueReference", &reference), NO_DEPENDENCIES]);
                    }
                }
            }
        }
        xml.close("ModelStructure");
    }

    /// Writes one variable; `None` is the time.
    fn variable(&self, xml: &mut Xml, reference: usize, variable: Option<&Variable>) {
        let reference = reference.to_string();
        let name = variable.map_or("time", |variable| &variable.name);
        let mut head = vec![("name", name), ("valueReference", &reference)];
        let mut own: Vec<(&str, &str)> = Vec::new();
        let (start, max): (String, String);
        match variable.map(|variable| variable.kind) {
            None => head.extend([("causality", "independent"), ("variability", "continuous")]),
            Some(Kind::Input { start: value }) => {
                head.extend([("causality", "input"), ("variability", "continuous")]);
                start = value.to_string();
                own.push(("start", &start));
            }
            Some(Kind::Output) => head.extend([
                ("causality", "output"),
                ("variability", "continuous"),
                ("initial", "calculated"),
            ]),
            Some(Kind::Tunable {
                start: value,
                max: bound,
            }) => {
                head.extend([
                    ("causality", "parameter"),
                    ("variability", "tunable"),
                    ("initial", "exact"),
                ]);
                (start, max) = (value.to_string(), bound.to_string());
                own.extend([("min", "0"), ("max", &*max), ("start", &start)]);
            }
            Some(Kind::Counter) => head.extend([
                ("causality", "output"),
                ("variability", "discrete"),
                ("initial", "calculated"),
            ]),
        }
        let description = variable.map_or("Time, s", |variable| variable.description);
        if !description.is_empty() {
            head.push(("description", description));
        }
        let unit =
            variable.and_then(|variable| UNITS.iter().find(|unit| unit.name == variable.unit));
        if let Some(unit) = unit {
            own.extend([("unit", unit.name), ("nominal", unit.nominal)]);
            own.extend(unit.display.map(|(name, _)| ("displayUnit", name)));
        }
        let is_integer = variable.is_some_and(|variable| matches!(variable.kind, Kind::Counter));
        match (self.interface, is_integer) {
            (Interface::Two, is_integer) => {
                xml.open("ScalarVariable", &head);
                xml.empty(if is_integer { "Integer" } else { "Real" }, &own);
                xml.close("ScalarVariable");
            }
            (Interface::Three, is_integer) => {
                head.extend(own);
                xml.empty(if is_integer { "Int32" } else { "Float64" }, &head);
            }
        }
    }
}
