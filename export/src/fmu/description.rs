//! Description of an FMU: `modelDescription.xml`, and `buildDescription.xml` of FMI 3.

use std::fmt::Write;

use maud::Escaper;

use super::variable::{Kind, UNITS, Variable};
use super::{Fmu, Interface};

/// No output depends on an input at the same communication point, so a loop of connected FMUs is never an algebraic
/// loop.
const NO_DEPENDENCIES: (&str, &str) = ("dependencies", "");

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
                if self.library.is_some() {
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
        for (unit, base) in UNITS {
            xml.open("Unit", &[("name", unit)]);
            xml.line(&format!("<BaseUnit {base}/>"));
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
        self.variable(xml, 0, None);
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
                        // Position in the list of variables; time is number 1.
                        let index = (reference + 1).to_string();
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
        if let Some(variable) = variable
            && !variable.unit.is_empty()
        {
            own.insert(0, ("unit", variable.unit));
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

/// XML document under construction.
struct Xml {
    text: String,
    depth: usize,
}

impl Xml {
    fn new() -> Self {
        Self {
            text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".into(),
            depth: 0,
        }
    }

    fn line(&mut self, line: &str) {
        // Writing to a String does not fail.
        let _ = writeln!(self.text, "{:width$}{line}", "", width = 2 * self.depth);
    }

    fn open(&mut self, element: &str, attributes: &[(&str, &str)]) {
        self.line(&format!("<{element}{}>", with_values(attributes)));
        self.depth += 1;
    }

    fn empty(&mut self, element: &str, attributes: &[(&str, &str)]) {
        self.line(&format!("<{element}{}/>", with_values(attributes)));
    }

    fn close(&mut self, element: &str) {
        self.depth -= 1;
        self.line(&format!("</{element}>"));
    }
}

fn with_values(attributes: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (name, value) in attributes {
        let _ = write!(text, " {name}=\"");
        // File names may contain control characters, but XML must not.
        let value = value.replace(char::is_control, " ");
        let _ = Escaper::new(&mut text).write_str(&value);
        text.push('"');
    }
    text
}
