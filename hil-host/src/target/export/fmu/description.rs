//! The description of an FMU: `modelDescription.xml`, and of FMI 3 `buildDescription.xml`.

use std::fmt::Write;

use maud::Escaper;

use super::{Fmu, Interface};
use crate::study::tick_grid::nearest_nanosecond;
use crate::target::export::Word;

/// Largest clearance (m), as the core allows it.
const LARGEST_CLEARANCE_M: f64 = dashpot_core::parameters::LARGEST_CLEARANCE_M;

/// Causality, variability and how a variable begins.
#[derive(Clone, Copy)]
enum Kind {
    Input,
    Output,
    Tunable { start: f64 },
    Counter,
}

/// A variable of a damper; its place is that of `model.c`.
struct Variable {
    name: &'static str,
    unit: &'static str,
    description: &'static str,
    kind: Kind,
}

fn variables(clearance_m: f64) -> [Variable; 6] {
    [
        Variable {
            name: "displacement_m",
            unit: "m",
            description: "Displacement of the seats at the communication point, positive in extension",
            kind: Kind::Input,
        },
        Variable {
            name: "velocity_m_per_s",
            unit: "m/s",
            description: "Its rate over the communication step to come; with it the force is not late",
            kind: Kind::Input,
        },
        Variable {
            name: "force_n",
            unit: "N",
            description: "Force, positive when it resists extension",
            kind: Kind::Output,
        },
        Variable {
            name: "clearance_m",
            unit: "m",
            description: "Clearance 2a, the whole play",
            kind: Kind::Tunable { start: clearance_m },
        },
        Variable {
            name: "status",
            unit: "",
            description: "Bits latched: 1 input held, 2 input limited, 4 saturated, 8 damper swapped, 16 corrupted",
            kind: Kind::Counter,
        },
        Variable {
            name: "rejected_inputs",
            unit: "",
            description: "Steps whose displacement was held or limited, up to 65535",
            kind: Kind::Counter,
        },
    ]
}

const UNITS: [(&str, &str); 3] = [
    ("m", r#"m="1""#),
    ("m/s", r#"m="1" s="-1""#),
    ("N", r#"kg="1" m="1" s="-2""#),
];

/// Outputs at a communication point change by a step alone, by no input there: no loop of connected FMUs is an algebraic one.
const NOTHING: (&str, &str) = ("dependencies", "");

const CATEGORIES: [(&str, &str); 3] = [
    ("logStatusWarning", "Input that was held or limited"),
    (
        "logStatusDiscard",
        "Calls that were refused; nothing has changed",
    ),
    (
        "logStatusError",
        "Calls after which the instance must be reset",
    ),
];

impl<T: Word> Fmu<T> {
    /// `modelDescription.xml`.
    pub(super) fn description(&self) -> String {
        let mut xml = Xml::new();
        let version = concat!("Dashpot ", env!("CARGO_PKG_VERSION"));
        let (number, token, state) = match self.interface {
            Interface::Two => ("2.0", "guid", "FMUstate"),
            Interface::Three => ("3.0", "instantiationToken", "FMUState"),
        };
        xml.open(
            "fmiModelDescription",
            &[
                ("fmiVersion", number),
                ("modelName", &self.identifier),
                (token, &self.token()),
                ("description", &self.title()),
                ("generationTool", version),
                ("variableNamingConvention", "structured"),
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
                capabilities.push(("canInterpolateInputs", "true"));
                capabilities.push(("canNotUseMemoryManagementFunctions", "true"));
                xml.open("CoSimulation", &capabilities);
                xml.open("SourceFiles", &[]);
                for name in self.compiled() {
                    xml.empty("File", &[("name", name)]);
                }
                xml.close("SourceFiles");
                xml.close("CoSimulation");
            }
            Interface::Three => {
                capabilities.push(("fixedInternalStepSize", &step));
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
        // Steps of this size end there.
        let stop_s = (1.0 / self.step_s).round() * self.step_s;
        let stop = nearest_nanosecond(stop_s).to_string();
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

    /// `buildDescription.xml` of FMI 3.
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
        // Of a shared library; linked statically, functions have the prefix.
        let definition = [("name", "FMI3_OVERRIDE_FUNCTION_PREFIX"), ("value", "1")];
        xml.empty("PreprocessorDefinition", &definition);
        xml.close("SourceFileSet");
        xml.close("BuildConfiguration");
        xml.close("fmiBuildDescription");
        xml.text
    }

    /// What it is, in a line.
    pub(super) fn title(&self) -> String {
        let names: Vec<&str> = self.dampers.iter().map(|named| &*named.name).collect();
        let what = match names.len() {
            1 => "Damper",
            _ => "Dampers",
        };
        format!(
            "{what} {}, internal step {} s, {}",
            names.join(", "),
            self.step_s,
            T::NAME
        )
    }

    fn variables(&self, xml: &mut Xml) {
        let dampers = self.dampers.len();
        let all = (0..dampers).flat_map(|number| {
            let variables = variables(self.dampers[number].clearance_m).into_iter();
            variables.enumerate().map(move |(place, variable)| {
                let name = match dampers {
                    1 => variable.name.to_owned(),
                    _ => format!("damper[{}].{}", number + 1, variable.name),
                };
                (name, 1 + 6 * number + place, variable)
            })
        });
        xml.open("ModelVariables", &[]);
        self.variable(xml, "time", 0, None);
        let mut outputs = Vec::new();
        for (index, (name, reference, variable)) in (2..).zip(all) {
            self.variable(xml, &name, reference, Some(&variable));
            if matches!(variable.kind, Kind::Output | Kind::Counter) {
                outputs.push((index, reference));
            }
        }
        xml.close("ModelVariables");
        xml.open("ModelStructure", &[]);
        match self.interface {
            Interface::Two => {
                for list in ["Outputs", "InitialUnknowns"] {
                    xml.open(list, &[]);
                    for (index, _) in &outputs {
                        let index = index.to_string();
                        xml.empty("Unknown", &[("index", &index), NOTHING]);
                    }
                    xml.close(list);
                }
            }
            Interface::Three => {
                for element in ["Output", "InitialUnknown"] {
                    for (_, reference) in &outputs {
                        let reference = reference.to_string();
                        xml.empty(element, &[("valueReference", &reference), NOTHING]);
                    }
                }
            }
        }
        xml.close("ModelStructure");
    }

    /// One variable; `None` is the time.
    fn variable(&self, xml: &mut Xml, name: &str, reference: usize, variable: Option<&Variable>) {
        let reference = reference.to_string();
        let largest = LARGEST_CLEARANCE_M.to_string();
        let mut head = vec![("name", name), ("valueReference", &reference)];
        let mut own = Vec::new();
        let start;
        match variable.map(|variable| variable.kind) {
            None => head.extend([("causality", "independent"), ("variability", "continuous")]),
            Some(Kind::Input) => {
                head.extend([("causality", "input"), ("variability", "continuous")]);
                own.push(("start", "0"));
            }
            Some(Kind::Output) => head.extend([
                ("causality", "output"),
                ("variability", "continuous"),
                ("initial", "calculated"),
            ]),
            Some(Kind::Tunable { start: value }) => {
                head.extend([
                    ("causality", "parameter"),
                    ("variability", "tunable"),
                    ("initial", "exact"),
                ]);
                start = value.to_string();
                own.extend([("min", "0"), ("max", &largest), ("start", &start)]);
            }
            Some(Kind::Counter) => head.extend([
                ("causality", "output"),
                ("variability", "discrete"),
                ("initial", "calculated"),
            ]),
        }
        let description = variable.map_or("Time, s", |variable| variable.description);
        head.push(("description", description));
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

/// Lines of XML.
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
        // XML has no control characters; a file's name may.
        let value = value.replace(char::is_control, " ");
        let _ = Escaper::new(&mut text).write_str(&value);
        text.push('"');
    }
    text
}
