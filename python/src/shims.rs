//! Shim packs of a damper.

use dashpot_files::damper;
use dashpot_testbench::shim_report::{ValveReport, valve_reports};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::class::Class;
use crate::damper::Damper;
use crate::error::Outcome;
use crate::table::columns;

static SHIMS: Class = Class::new("dashpot._shims", "Shims");

/// Columns of the table of pressures.
const PRESSURES: [&str; 6] = [
    "pressure_pa",
    "theory_uniform_m",
    "published_uniform_m",
    "published_real_m",
    "lift_m",
    "flow_m3_per_s",
];

/// Computes the shim packs of a damper's three valves, as `dashpot shims`: stiffness by disc theory, and lift and flow
/// over the pressure as the damper model uses them. Each valve is a `dashpot.Shims`. A reduced damper has no valves and
/// is refused.
///
/// >>> import dashpot
/// >>> valves = dashpot.shims(dashpot.Damper("in-service"))
/// >>> [valve.valve for valve in valves]
/// ['piston extension', 'piston compression', 'foot compression']
/// >>> round(1e3 * float(valves[0].pressures["lift_m"][-1]), 3)  # mm, at 10 MPa
/// 0.028
#[pyfunction]
pub fn shims<'py>(py: Python<'py>, damper: &Bound<'py, Damper>) -> Outcome<Bound<'py, PyList>> {
    let parameters = &damper.get().parameters;
    let paper = damper::load("paper", &[])?;
    let valves = PyList::empty(py);
    for valve in valve_reports(parameters, &paper)? {
        valves.append(in_python(py, &valve)?)?;
    }
    Ok(valves)
}

fn in_python<'py>(py: Python<'py>, valve: &ValveReport) -> Outcome<Bound<'py, PyAny>> {
    let found = PyDict::new(py);
    let pack = valve.pack.as_ref();
    let numbers = [
        ("clamp_radius_m", Some(valve.clamp_radius_m)),
        ("free_radius_m", Some(valve.free_radius_m)),
        (
            "equivalent_thickness_m",
            pack.map(|pack| pack.equivalent_thickness_m),
        ),
        (
            "edge_compliance_m_per_pa",
            pack.map(|pack| pack.edge_compliance_m_per_pa),
        ),
        (
            "given_edge_compliance_m_per_pa",
            valve.given_edge_compliance_m_per_pa,
        ),
        (
            "equivalent_pressure_factor",
            Some(valve.equivalent_pressure_factor),
        ),
        (
            "effective_edge_compliance_m_per_pa",
            Some(valve.effective_edge_compliance_m_per_pa),
        ),
        ("preload_pa", Some(valve.preload_pa)),
        ("theory_over_published", valve.theory_over_published),
    ];
    found.set_item("valve", valve.valve)?;
    for (name, value) in numbers {
        found.set_item(name, value)?;
    }
    found.set_item("shims_m", PyArray1::from_slice(py, &valve.shims_m))?;
    let cw = pack.map(|pack| columns(py, &["radius_m", "cw_m6_per_n"], &pack.cw));
    found.set_item("cw", cw.transpose()?)?;
    found.set_item("pressures", columns(py, &PRESSURES, &valve.pressures)?)?;
    SHIMS.make_of(&found)
}
