//! Frequency response of a damper.

use dashpot_testbench::TestbenchError;
use dashpot_testbench::response::{Response, at_amplitude, frequencies, linearised};
use dashpot_testbench::swept_sine;
use numpy::ndarray::Array2;
use numpy::{Ix1, PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::class::Class;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_in_thread;

const MODULE: &str = "dashpot._response";
static RESPONSE: Class = Class::new(MODULE, "Response");
static CURVES: Class = Class::new(MODULE, "ResponseCurves");

/// A quantity of a response.
type Quantity = fn(&Response) -> f64;

/// Quantities by name.
const QUANTITIES: [(&str, Quantity); 5] = [
    ("dynamic_stiffness_n_per_m", Response::stiffness_n_per_m),
    ("loss_angle_deg", |response| {
        response.loss_angle_deg().unwrap_or(f64::NAN)
    }),
    ("storage_n_per_m", |response| response.storage_n_per_m),
    ("loss_n_per_m", |response| response.loss_n_per_m),
    ("damping_n_s_per_m", Response::damping_n_s_per_m),
];

/// Computes dynamic stiffness, loss angle and damping over frequency and amplitude, and those of the linearised damper,
/// as `dashpot response`.
///
/// `amplitude_m` (m) is a number or a sequence. `frequency_hz` (Hz) is a float64 array; the default is that of the
/// command, 41 frequencies from 0.1 to 20 Hz in a constant ratio. With `swept`, one motion through all frequencies,
/// which must rise, at `octaves_per_minute` is demodulated and compared. Use a loop over `damper.replace` to compare
/// dampers. Ctrl-C cancels the computation.
///
/// >>> import dashpot, numpy
/// >>> damper = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0.0})
/// >>> found = dashpot.response(damper, 0.5e-3, frequency_hz=numpy.array([0.5, 2.0]))
/// >>> dashpot_n_per_m = 120e3 * 2 * numpy.pi * found.frequency_hz
/// >>> expected = dashpot_n_per_m / numpy.hypot(1, dashpot_n_per_m / 8e6)  # in series with 8 MN/m
/// >>> bool(numpy.allclose(found.harmonic.dynamic_stiffness_n_per_m[0], expected, rtol=1e-3))
/// True
#[pyfunction]
#[pyo3(signature = (
    damper, amplitude_m=None, *, frequency_hz=None, swept=false, octaves_per_minute=1.0
))]
pub fn response<'py>(
    py: Python<'py>,
    damper: &Bound<'py, Damper>,
    amplitude_m: Option<&Bound<'py, PyAny>>,
    frequency_hz: Option<&Bound<'py, PyAny>>,
    swept: bool,
    octaves_per_minute: f64,
) -> Outcome<Bound<'py, PyAny>> {
    let amplitudes_m = match amplitude_m {
        None => vec![1e-3, 2e-3, 5e-3],
        Some(one) => match one.extract::<f64>() {
            Ok(one) => vec![one],
            Err(_) => one.extract()?,
        },
    };
    if amplitudes_m.is_empty() {
        return refuse("amplitude_m: empty, allowed: at least one amplitude");
    }
    let frequencies_hz = match frequency_hz {
        None => frequencies(0.1, 20.0, 41),
        Some(array) => arrays::read::<f64, Ix1>("frequency_hz", array)?
            .as_array()
            .to_vec(),
    };
    if frequencies_hz.is_empty() {
        return refuse("frequency_hz: empty, allowed: at least one frequency");
    }
    if swept && frequencies_hz.windows(2).any(|pair| pair[0] >= pair[1]) {
        return refuse("frequency_hz: not rising, allowed with swept=True: rising frequencies");
    }
    let computed = Computed {
        damper: damper.get(),
        amplitudes_m: &amplitudes_m,
        frequencies_hz: &frequencies_hz,
    };
    let rate = swept.then_some(octaves_per_minute);
    let (all, swept) = py.detach(|| run_in_thread(|unwanted| computed.run(rate, unwanted)))??;
    let (harmonic, linear) = all.split_at(amplitudes_m.len() * frequencies_hz.len());
    let found = PyDict::new(py);
    found.set_item("frequency_hz", PyArray1::from_slice(py, &frequencies_hz))?;
    found.set_item("amplitude_m", PyArray1::from_slice(py, &amplitudes_m))?;
    found.set_item("harmonic", curves(py, harmonic, frequencies_hz.len())?)?;
    found.set_item("linearised", curves(py, linear, frequencies_hz.len())?)?;
    let difference = swept.as_ref().map(|swept| {
        let pairs = swept.iter().zip(harmonic);
        let difference = pairs.map(|(swept, harmonic)| swept.difference_from(harmonic));
        difference.map(|part| part.unwrap_or(f64::NAN)).collect()
    });
    let difference: Option<Vec<f64>> = difference;
    let difference = difference.map(|all| rows(py, all, frequencies_hz.len()));
    found.set_item("difference", difference.transpose()?)?;
    let swept = swept.map(|swept| curves(py, &swept, frequencies_hz.len()));
    found.set_item("swept", swept.transpose()?)?;
    RESPONSE.make_of(&found)
}

/// The damper and the motions whose response to compute.
struct Computed<'a> {
    damper: &'a Damper,
    amplitudes_m: &'a [f64],
    frequencies_hz: &'a [f64],
}

/// Responses in rows of one amplitude.
type Rows = Vec<Response>;

impl Computed<'_> {
    /// Returns the harmonic responses, followed by the linearised ones, and those of a sweep with `rate` octaves per
    /// minute.
    fn run(
        &self,
        rate: Option<f64>,
        is_unwanted: &(dyn Fn() -> bool + Sync),
    ) -> Outcome<(Rows, Option<Rows>)> {
        let parameters = &self.damper.parameters;
        let amplitudes = self.amplitudes_m.iter().copied().map(Some);
        let points = amplitudes.chain([None]).flat_map(|amplitude_m| {
            let frequencies = self.frequencies_hz.iter();
            frequencies.map(move |frequency_hz| (amplitude_m, *frequency_hz))
        });
        let all = cancellable_map(
            &points.collect::<Vec<_>>(),
            is_unwanted,
            |(amplitude_m, frequency_hz)| match amplitude_m {
                Some(amplitude_m) => at_amplitude(parameters, *amplitude_m, &[*frequency_hz]),
                None => linearised(parameters, &[*frequency_hz]),
            },
        )?;
        let Some(rate) = rate else {
            return Ok((all, None));
        };
        let swept = cancellable_map(self.amplitudes_m, is_unwanted, |amplitude_m| {
            swept_sine::responses(parameters, *amplitude_m, self.frequencies_hz, rate)
        })?;
        Ok((all, Some(swept)))
    }
}

/// Computes the responses of all items on all cores; nothing more once they are unwanted.
fn cancellable_map<T: Sync>(
    items: &[T],
    is_unwanted: &(dyn Fn() -> bool + Sync),
    work: impl Fn(&T) -> Result<Rows, TestbenchError> + Sync,
) -> Outcome<Rows> {
    let found = dashpot_workers::map(items, |item| match is_unwanted() {
        true => Ok(Vec::new()),
        false => work(item).map_err(Refusal::from),
    })?;
    Ok(found.into_iter().flatten().collect())
}

/// Curves from responses in rows of `columns`.
fn curves<'py>(
    py: Python<'py>,
    responses: &[Response],
    columns: usize,
) -> Outcome<Bound<'py, PyAny>> {
    let curves = PyDict::new(py);
    for (name, of) in QUANTITIES {
        let values = rows(py, responses.iter().map(of).collect(), columns)?;
        curves.set_item(name, values)?;
    }
    CURVES.make_of(&curves)
}

fn rows<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    columns: usize,
) -> Outcome<Bound<'py, PyArray2<f64>>> {
    match Array2::from_shape_vec((values.len() / columns, columns), values) {
        Ok(rows) => Ok(PyArray2::from_owned_array(py, rows)),
        Err(error) => refuse(error),
    }
}
