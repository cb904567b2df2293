//! Parsing of the options that select parameters: `--vary`, `--prior` and `--hold`.

use std::str::FromStr;

use super::CalibrateArguments;
use dashpot_calibration::{Prior, Request, SKEW};

/// `KEY` or `KEY=MIN:MAX`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Variation {
    key: String,
    bounds: Option<[f64; 2]>,
}

/// `KEY=MEAN:DEVIATION`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NamedPrior {
    key: String,
    prior: Prior,
}

/// `KEY` or `KEY=VALUE`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Held {
    key: String,
    value: Option<f64>,
}

impl FromStr for Held {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((key, value)) = text.split_once('=') else {
            let (key, value) = (text.to_owned(), None);
            return Ok(Self { key, value });
        };
        let number = value.trim().parse::<f64>().ok();
        let number = number.filter(|number| number.is_finite());
        Ok(Self {
            key: key.into(),
            value: Some(number.ok_or("allowed after `=`: a number")?),
        })
    }
}

impl FromStr for Variation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((key, bounds)) = text.split_once('=') else {
            let (key, bounds) = (text.to_owned(), None);
            return Ok(Self { key, bounds });
        };
        let bounds = pair(bounds).filter(|[min, max]| min < max);
        let bounds = bounds.ok_or("allowed after `=`: MIN:MAX, two numbers, the smaller first")?;
        Ok(Self {
            key: key.into(),
            bounds: Some(bounds),
        })
    }
}

impl FromStr for NamedPrior {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split_once('=')
            .and_then(|(key, numbers)| Some((key, pair(numbers)?)));
        match numbers.filter(|(_, [_, deviation])| *deviation > 0.0) {
            Some((key, [mean, standard_deviation])) => Ok(Self {
                key: key.into(),
                prior: Prior {
                    mean,
                    standard_deviation,
                },
            }),
            None => Err(
                "allowed: KEY=MEAN:DEVIATION, two numbers, with a standard deviation above 0"
                    .into(),
            ),
        }
    }
}

/// Parses two finite numbers separated by a colon.
fn pair(text: &str) -> Option<[f64; 2]> {
    let (first, second) = text.split_once(':')?;
    let numbers = [first, second].map(|number| number.trim().parse::<f64>().ok());
    let [first, second] = numbers.map(|number| number.filter(|number| number.is_finite()));
    Some([first?, second?])
}

/// Builds the calibration request from the options.
pub(super) fn request(arguments: &CalibrateArguments) -> Request {
    let vary = arguments.vary.iter();
    let each = arguments.vary_each.iter();
    let priors = arguments.prior.iter();
    let hold = arguments.hold.iter();
    // Without loops there is no skew to hold.
    let no_skew = arguments.no_skew && !arguments.input.is_empty();
    let no_skew = no_skew.then(|| (SKEW.to_owned(), None));
    Request {
        vary: vary.map(|one| (one.key.clone(), one.bounds)).collect(),
        vary_each: each.map(|one| (one.key.clone(), one.bounds)).collect(),
        priors: priors.map(|one| (one.key.clone(), one.prior)).collect(),
        hold: hold
            .map(|one| (one.key.clone(), one.value))
            .chain(no_skew)
            .collect(),
        only_own_priors: arguments.no_priors,
    }
}
