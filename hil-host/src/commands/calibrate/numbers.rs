//! The numbers that are varied, as options name them.

use std::str::FromStr;

use super::CalibrateArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::files::damper::Keyed;
use crate::study::calibration::{Prior, Varied};

/// `KEY` or `KEY=LEAST:GREATEST`.
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

impl FromStr for Variation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((key, bounds)) = text.split_once('=') else {
            let (key, bounds) = (text.to_owned(), None);
            return Ok(Self { key, bounds });
        };
        let bounds = pair(bounds).filter(|[least, greatest]| least < greatest);
        let bounds =
            bounds.ok_or("allowed after `=`: LEAST:GREATEST, two numbers, the lesser first")?;
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
                "allowed: KEY=MEAN:DEVIATION, two numbers, the standard deviation above 0".into(),
            ),
        }
    }
}

/// Two finite numbers with a colon between them.
fn pair(text: &str) -> Option<[f64; 2]> {
    let (first, second) = text.split_once(':')?;
    let numbers = [first, second].map(|number| number.trim().parse::<f64>().ok());
    let [first, second] = numbers.map(|number| number.filter(|number| number.is_finite()));
    Some([first?, second?])
}

/// The numbers of `damper` that the options vary.
///
/// # Errors
/// A number that there is not or that forces do not tell, bounds that are none, or a prior of a number that is not varied.
pub(super) fn varied(damper: &Keyed, arguments: &CalibrateArguments) -> Outcome<Vec<Varied>> {
    let varied = arguments.vary.iter().map(|variation| {
        let given = arguments
            .prior
            .iter()
            .find(|given| given.key == variation.key);
        let prior = given.map(|given| given.prior);
        let mut varied = Varied::new(damper, &variation.key, variation.bounds, prior)?;
        if arguments.no_priors {
            varied.prior = prior;
        }
        Ok(varied)
    });
    let varied: Vec<Varied> = varied.collect::<Outcome<_>>()?;
    for (number, given) in arguments.prior.iter().enumerate() {
        let earlier = &arguments.prior[..number];
        if earlier.iter().any(|earlier| earlier.key == given.key) {
            return Err(Failure::wrong_use(format!(
                "--prior {}: given twice",
                given.key
            )));
        }
        if !varied.iter().any(|varied| varied.key == given.key) {
            return Err(Failure::wrong_use(format!(
                "--prior {}: not varied; allowed: a number that --vary names",
                given.key
            )));
        }
    }
    Ok(varied)
}
