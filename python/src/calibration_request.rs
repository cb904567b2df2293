//! The request of a calibration from Python arguments.

use dashpot_calibration::{IndexTest, Prior, Recorded, Request};
use numpy::Ix1;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::arrays;
use crate::error::{Outcome, Refusal, refuse};
use crate::range::within;

/// Arrays of time (s), displacement (m) and force (N).
pub type Samples<'py> = [Bound<'py, PyAny>; 3];

/// Keys with their bounds.
type Keys = Vec<(String, Option<[f64; 2]>)>;

/// Reads a list of keys, or a dictionary from keys to bounds.
fn keys(given: Option<&Bound<'_, PyAny>>) -> Outcome<Keys> {
    match given.map(|given| (given, given.cast::<PyDict>())) {
        Some((_, Ok(bounded))) => {
            let pairs = bounded.into_iter();
            let pairs = pairs.map(|(key, bounds)| Ok((key.extract()?, bounds.extract()?)));
            pairs.collect()
        }
        Some((listed, Err(_))) => {
            let listed: Vec<String> = listed.extract()?;
            Ok(listed.into_iter().map(|key| (key, None)).collect())
        }
        None => Ok(Vec::new()),
    }
}

/// Builds the request from the arguments.
pub fn request(
    vary: Option<&Bound<'_, PyAny>>,
    vary_each: Option<&Bound<'_, PyAny>>,
    priors: Option<&Bound<'_, PyDict>>,
    hold: Option<&Bound<'_, PyDict>>,
) -> Outcome<Request> {
    let mut given: Vec<(String, Prior)> = Vec::new();
    for (key, pair) in priors.into_iter().flatten() {
        let (key, (mean, standard_deviation)): (String, (f64, f64)) =
            (key.extract()?, pair.extract()?);
        if !(standard_deviation > 0.0 && standard_deviation.is_finite()) {
            return refuse(format!(
                "prior {key}: standard deviation {standard_deviation}, allowed: above 0"
            ));
        }
        let prior = Prior {
            mean,
            standard_deviation,
        };
        given.push((key, prior));
    }
    let mut held: Vec<(String, Option<f64>)> = Vec::new();
    for (key, value) in hold.into_iter().flatten() {
        held.push((key.extract()?, value.extract()?));
    }
    Ok(Request {
        vary: keys(vary)?,
        vary_each: keys(vary_each)?,
        priors: given,
        hold: held,
        only_own_priors: false,
    })
}

/// Builds a recorded loop from three arrays.
pub fn recorded(
    list: &str,
    number: usize,
    [time_s, displacement_m, force_n]: &Samples<'_>,
) -> Outcome<Recorded> {
    let numbers = |name: &str, array| {
        let array = arrays::read::<f64, Ix1>(name, array).map_err(|refusal| match refusal {
            Refusal::Value(words) => Refusal::Value(format!("{list}[{number}]: {words}")),
            other => other,
        })?;
        Ok::<_, Refusal>(array.as_array().to_vec())
    };
    let (times, displacements) = (
        numbers("time", time_s)?,
        numbers("displacement", displacement_m)?,
    );
    let forces = numbers("force", force_n)?;
    Ok(Recorded::new(
        match list {
            "tests" => format!("test {number}"),
            list => format!("{list} {number}"),
        },
        times,
        displacements,
        forces,
    )?)
}

/// Reads tests that give only their indices.
pub fn index_tests(indices: Option<&Bound<'_, PyAny>>) -> Outcome<Vec<IndexTest>> {
    let Some(indices) = indices else {
        return Ok(Vec::new());
    };
    let py = indices.py();
    let finite = [("allow_nan", false)].into_py_dict(py)?;
    let text = py
        .import("json")?
        .call_method("dumps", (indices,), Some(&finite));
    let text: String = match text {
        Ok(text) => text.extract()?,
        Err(error) => {
            return refuse(format!(
                "indices: {}; allowed: a list of dicts of finite Python numbers; leave out indices that were not \
                 measured",
                error.value(py)
            ));
        }
    };
    match serde_json::from_str(&text) {
        Ok(tests) => Ok(tests),
        Err(error) => refuse(format!("indices: {error}")),
    }
}

/// Reads the oil temperatures (degC) of `count` recordings: a number for all, or a sequence with one for each.
pub fn temperatures_c(given: Option<&Bound<'_, PyAny>>, count: usize) -> Outcome<Vec<Option<f64>>> {
    let Some(given) = given else {
        return Ok(vec![None; count]);
    };
    let temperatures_c = match given.extract::<f64>() {
        Ok(one) => vec![Some(one); count],
        Err(_) => given.extract::<Vec<Option<f64>>>()?,
    };
    if temperatures_c.len() != count {
        return refuse(format!(
            "temperature_c: {} values for {count} recordings, allowed: one for all, or one for each",
            temperatures_c.len()
        ));
    }
    for temperature_c in temperatures_c.iter().flatten() {
        within("temperature_c", *temperature_c, [-100.0, 300.0])?;
    }
    Ok(temperatures_c)
}
