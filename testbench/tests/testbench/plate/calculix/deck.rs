//! CalculiX input files in mm, N and MPa, and their printed results.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::process::Command;

/// Elastic modulus (MPa) and Poisson's ratio of every model.
const STEEL: &str = "200000., 0.3";

/// Builder of an input file.
pub struct Deck {
    text: String,
    nodes: u32,
    elements: u32,
}

/// Kind of analysis.
#[derive(Clone, Copy, PartialEq)]
pub enum Geometry {
    /// Geometrically linear.
    Linear,
    /// Geometrically nonlinear.
    Nonlinear,
}

/// Rows of values by heading, without the set and the time at the end of each heading.
pub type Printed = BTreeMap<String, Vec<Vec<f64>>>;

impl Deck {
    pub fn new() -> Self {
        let text = "*NODE, NSET=ALL\n".into();
        Self {
            text,
            nodes: 0,
            elements: 0,
        }
    }

    /// Adds a node (mm) and returns its number.
    pub fn node(&mut self, [x, y, z]: [f64; 3]) -> u32 {
        self.nodes += 1;
        writeln!(self.text, "{}, {x:.12}, {y:.12}, {z:.12}", self.nodes).unwrap();
        self.nodes
    }

    pub fn line(&mut self, line: &str) {
        self.text += line;
        self.text += "\n";
    }

    /// Starts a list of steel elements of one type.
    pub fn elements(&mut self, kind: &str) {
        self.line(&format!("*ELEMENT, TYPE={kind}, ELSET=PLATE"));
    }

    /// Adds an element and returns its number.
    pub fn element(&mut self, nodes: &[u32]) -> u32 {
        self.elements += 1;
        let mut entries = vec![self.elements.to_string()];
        entries.extend(nodes.iter().map(u32::to_string));
        // A line has at most sixteen entries.
        let lines: Vec<String> = entries.chunks(12).map(|part| part.join(", ")).collect();
        self.line(&lines.join(",\n"));
        self.elements
    }

    pub fn node_set(&mut self, name: &str, nodes: &[u32]) {
        self.line(&format!("*NSET, NSET={name}"));
        for node in nodes {
            self.line(&format!("{node},"));
        }
    }

    /// Defines a surface from the same face of several elements.
    pub fn surface(&mut self, name: &str, elements: &[u32], face: u32) {
        self.line(&format!("*SURFACE, NAME={name}, TYPE=ELEMENT"));
        for element in elements {
            self.line(&format!("{element}, S{face}"));
        }
    }

    pub fn steel(&mut self) {
        self.line("*MATERIAL, NAME=STEEL\n*ELASTIC");
        self.line(STEEL);
        self.line("*SOLID SECTION, ELSET=PLATE, MATERIAL=STEEL");
    }

    /// Solves a static step with pressure (MPa) on the first face of each of `loaded`, and returns the requested
    /// `prints`.
    ///
    /// CalculiX reads at most 20 characters per number.
    pub fn solve(
        mut self,
        loaded: &[u32],
        pressure_mpa: f64,
        geometry: Geometry,
        prints: &str,
    ) -> Printed {
        self.line(match geometry {
            Geometry::Linear => "*STEP\n*STATIC",
            Geometry::Nonlinear => "*STEP, NLGEOM\n*STATIC",
        });
        self.line("*DLOAD");
        for element in loaded {
            self.line(&format!("{element}, P1, {pressure_mpa:.9e}"));
        }
        self.line(prints);
        self.line("*END STEP");
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("plate.inp"), &self.text).unwrap();
        let output = Command::new("ccx")
            .arg("plate")
            .current_dir(folder.path())
            .env("OMP_NUM_THREADS", "1")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(said.contains("Job finished"), "{said}");
        printed(&std::fs::read_to_string(folder.path().join("plate.dat")).unwrap())
    }
}

/// Returns the rows of the last increment by heading.
fn printed(text: &str) -> Printed {
    let mut all = Printed::new();
    let mut heading = String::new();
    for line in text.lines() {
        let numbers: Option<Vec<f64>> = line.split_whitespace().map(|x| x.parse().ok()).collect();
        match numbers {
            Some(numbers) if numbers.is_empty() => {}
            Some(numbers) => all.entry(heading.clone()).or_default().push(numbers),
            None => {
                heading = line.split('(').next().unwrap_or_default().trim().into();
                all.insert(heading.clone(), Vec::new());
            }
        }
    }
    all
}
