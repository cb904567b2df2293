//! The compensator that the keywords describe.

use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, InverseModel, PolynomialExtrapolation, Uncompensated,
};

use super::any::AnyCompensator;
use crate::error::{Outcome, refuse};

const KINDS: &str = "none, polynomial, inverse or adaptive";

/// Keywords of a compensator; `None` for those that are not given.
#[derive(Clone, Copy)]
pub struct Given {
    pub delay_s: Option<f32>,
    pub delay_error_s: Option<f32>,
    pub coefficients: Option<[f32; 4]>,
    pub order: Option<i64>,
    pub largest_change: Option<[f32; 4]>,
    pub noise_m: Option<f32>,
    pub least_motion_m: Option<f32>,
    pub pole_hz: Option<f32>,
    pub memory_s: Option<f32>,
    pub change_s: Option<f32>,
}

impl Given {
    /// Builds the compensator of a kind.
    ///
    /// # Errors
    /// The kind is unknown, a keyword is missing or belongs to another kind, or a value is outside its range.
    pub fn build(&self, kind: &str, step_s: f32) -> Outcome<AnyCompensator> {
        match kind {
            "none" => {
                self.refuse_others(kind, &[])?;
                Ok(AnyCompensator::Uncompensated(Uncompensated))
            }
            "polynomial" => {
                self.refuse_others(kind, &["delay_s", "order"])?;
                let Some(delay_s) = self.delay_s else {
                    return refuse("delay_s: missing, which compensator=\"polynomial\" needs");
                };
                let order = self.order.unwrap_or(3);
                let Some(order) = u8::try_from(order).ok().filter(|order| *order <= 3) else {
                    return refuse(format!("order: {order}, allowed: 1 to 3"));
                };
                let polynomial = PolynomialExtrapolation::new(order, delay_s, step_s)?;
                Ok(AnyCompensator::Polynomial(polynomial))
            }
            "inverse" => {
                self.refuse_others(kind, &["delay_s", "coefficients"])?;
                Ok(AnyCompensator::Inverse(self.nominal(kind)?))
            }
            "adaptive" => {
                self.refuse_others(kind, &ADAPTIVE)?;
                let adaptive = AdaptiveTimeSeries::new(&self.adaptive()?, step_s)?;
                Ok(AnyCompensator::Adaptive(adaptive))
            }
            _ => refuse(format!("compensator: {kind}, allowed: {KINDS}")),
        }
    }

    /// The inverse that a delay or coefficients describe.
    fn nominal(&self, kind: &str) -> Outcome<InverseModel> {
        match (self.delay_s, self.coefficients) {
            (Some(delay_s), None) => Ok(InverseModel::of_delay(delay_s)?),
            (None, Some(coefficients)) => Ok(InverseModel::new(coefficients)?),
            _ => refuse(format!(
                "compensator=\"{kind}\" needs either delay_s or coefficients"
            )),
        }
    }

    fn adaptive(&self) -> Outcome<AdaptiveSettings> {
        let nominal = self.nominal("adaptive")?.coefficients();
        let Some(delay_error_s) = self.delay_error_s else {
            return refuse("delay_error_s: missing, which compensator=\"adaptive\" needs");
        };
        let defaults = AdaptiveSettings::new(nominal, delay_error_s);
        Ok(AdaptiveSettings {
            nominal,
            largest_change: self.largest_change.unwrap_or(defaults.largest_change),
            noise_m: self.noise_m.unwrap_or(defaults.noise_m),
            least_motion_m: self.least_motion_m.unwrap_or(defaults.least_motion_m),
            pole_hz: self.pole_hz.unwrap_or(defaults.pole_hz),
            memory_s: self.memory_s.unwrap_or(defaults.memory_s),
            change_s: self.change_s.unwrap_or(defaults.change_s),
        })
    }

    /// Refuses keywords that this kind of compensator would ignore.
    fn refuse_others(&self, kind: &str, allowed: &[&str]) -> Outcome<()> {
        let given = [
            ("delay_s", self.delay_s.is_some()),
            ("delay_error_s", self.delay_error_s.is_some()),
            ("coefficients", self.coefficients.is_some()),
            ("order", self.order.is_some()),
            ("largest_change", self.largest_change.is_some()),
            ("noise_m", self.noise_m.is_some()),
            ("least_motion_m", self.least_motion_m.is_some()),
            ("pole_hz", self.pole_hz.is_some()),
            ("memory_s", self.memory_s.is_some()),
            ("change_s", self.change_s.is_some()),
        ];
        let unused = given
            .iter()
            .find(|(name, is_given)| *is_given && !allowed.contains(name));
        match unused {
            None => Ok(()),
            Some((name, _)) if allowed.is_empty() => refuse(format!(
                "{name}: compensator=\"{kind}\" has no such setting, allowed: none"
            )),
            Some((name, _)) => refuse(format!(
                "{name}: compensator=\"{kind}\" has no such setting, allowed: {}",
                allowed.join(", ")
            )),
        }
    }
}

/// Keywords of an adaptive compensator.
const ADAPTIVE: [&str; 9] = [
    "delay_s",
    "delay_error_s",
    "coefficients",
    "largest_change",
    "noise_m",
    "least_motion_m",
    "pole_hz",
    "memory_s",
    "change_s",
];
