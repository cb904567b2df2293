//! Searches for the cause of an implausible fit. It removes each possible cause in turn and fits again, so that the
//! advice is known to work.

use super::finding::Finding;
use super::loops::Factors;
use super::model::Model;
use super::remedy::{Advice, Remedy};
use super::varied::Varied;
use super::{Calibration, CalibrationError};
use dashpot_files::damper::{KeyedParameters, PRESETS, load};

/// Penalty per change, as a misfit (1): of two causes that explain the recordings equally well, the simpler one wins.
const COST_PER_CHANGE: f64 = 0.02;

/// Penalty, as a misfit (1), for moving all parameters across their whole range: if several units fit equally well, the
/// unit whose fit stays closest to the start wins.
const COST_OF_DISTANCE: f64 = 0.05;

/// Difference in rank within which two causes count as equally likely.
const TIE: f64 = 5e-3;

/// Maximum number of alternatives.
const MAX_ADVICE: usize = 2;

/// Usual range of amplitudes (m); values outside suggest a wrong unit.
const USUAL_AMPLITUDES_M: [f64; 2] = [1e-3, 0.1];
/// Usual range of peak forces (N); values outside suggest a wrong unit.
const USUAL_FORCES_N: [f64; 2] = [200.0, 2e5];

/// Parameters that vary in most calibrations of a physical damper.
const PHYSICAL: [&str; 3] = [
    "orifice.discharge_coefficient",
    "mount.stiffness_n_per_m",
    "mount.clearance_m",
];

/// Parameters that vary in most calibrations of a reduced damper.
const REDUCED: [&str; 4] = [
    "reduced.damping_n_s_per_m",
    "reduced.saturation_velocity_m_per_s",
    "mount.stiffness_n_per_m",
    "mount.clearance_m",
];

/// A calibration with a possible cause removed.
struct Candidate {
    advice: Advice,
    calibration: Calibration,
    /// Parameters that the user did not request and that may be left out again.
    added: Vec<String>,
}

impl Calibration {
    /// Returns remedies for `finding`, the most likely first; each was tried and yields a result.
    pub(super) fn advice(
        &self,
        finding: &Finding,
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Vec<Advice> {
        let candidates = self.candidates(finding);
        let ranked = dashpot_workers::map(&candidates, |candidate| {
            Ok::<_, ()>(candidate.rank(is_cancelled))
        });
        let mut ranked: Vec<(f64, Candidate)> = ranked
            .unwrap_or_default()
            .into_iter()
            .zip(candidates)
            .filter_map(|(rank, candidate)| Some((rank?, candidate)))
            .collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut advice: Vec<(f64, Advice)> = Vec::new();
        for (rank, candidate) in ranked {
            let is_as_likely = advice.first().is_none_or(|(best, _)| rank <= best + TIE);
            if advice.len() == MAX_ADVICE || !is_as_likely || is_cancelled() {
                break;
            }
            advice.extend(
                candidate
                    .confirmed(is_cancelled)
                    .map(|advice| (rank, advice)),
            );
        }
        advice.into_iter().map(|(_, advice)| advice).collect()
    }

    /// Returns all possible causes of `finding`.
    fn candidates(&self, finding: &Finding) -> Vec<Candidate> {
        let mut candidates = Vec::new();
        for (signs, reversed) in self.signs() {
            for (factors, scaled) in self.scales(finding) {
                let advice: Advice = reversed.iter().chain(&scaled).cloned().collect();
                if !advice.is_empty() {
                    let factors = Factors {
                        displacement: signs.displacement * factors.displacement,
                        force: signs.force * factors.force,
                    };
                    candidates.push(Candidate::new(self.scaled(factors), advice));
                }
            }
        }
        candidates.extend(self.wider(finding));
        if matches!(finding, Finding::Missed { .. } | Finding::AtBound { .. }) {
            candidates.extend(self.with_more_parameters());
            candidates.extend(self.started_from_presets());
        }
        candidates
    }

    /// Returns the reversals of force and displacement with which the damper may dissipate energy.
    fn signs(&self) -> Vec<(Factors, Advice)> {
        let factors = |displacement, force| Factors {
            displacement,
            force,
        };
        let force = (factors(1.0, -1.0), vec![Remedy::ReverseForce]);
        let displacement = (factors(-1.0, 1.0), vec![Remedy::ReverseDisplacement]);
        let both = (
            factors(-1.0, -1.0),
            vec![Remedy::ReverseForce, Remedy::ReverseDisplacement],
        );
        let neither = (factors(1.0, 1.0), Vec::new());
        match self.certain_sign() {
            Some(sign) if sign < 0.0 => vec![force, displacement],
            Some(_) => vec![neither, both],
            None => vec![neither, force, displacement, both],
        }
    }

    /// Returns factors that correct a displacement or a force that was read in the wrong unit.
    fn scales(&self, finding: &Finding) -> Vec<(Factors, Advice)> {
        let max = |value: &dyn Fn(&super::LoopTest) -> f64| {
            self.loops.iter().map(value).fold(0.0, f64::max)
        };
        let amplitude_m = max(&|test| test.amplitude_m);
        let force_n = max(&|test| test.peak_force_n);
        let of_displacement = |displacement| {
            let factors = Factors {
                displacement,
                force: 1.0,
            };
            (factors, vec![Remedy::ScaleDisplacement(displacement)])
        };
        let of_force = |force| {
            let factors = Factors {
                displacement: 1.0,
                force,
            };
            (factors, vec![Remedy::ScaleForce(force)])
        };
        if matches!(finding, Finding::TooFast { .. }) {
            // Millimetres, centimetres, inches, micrometres.
            return [1e-3, 1e-2, 0.0254, 1e-6].map(of_displacement).into();
        }
        let unchanged = Factors {
            displacement: 1.0,
            force: 1.0,
        };
        let mut scales = vec![(unchanged, Vec::new())];
        if amplitude_m < USUAL_AMPLITUDES_M[0] {
            scales.push(of_displacement(1e3));
        }
        if amplitude_m > USUAL_AMPLITUDES_M[1] {
            scales.push(of_displacement(1e-3));
        }
        if force_n < USUAL_FORCES_N[0] {
            scales.push(of_force(1e3));
        }
        if force_n > USUAL_FORCES_N[1] {
            scales.push(of_force(1e-3));
        }
        scales
    }

    /// Returns the calibration with both signals multiplied by `factors`.
    fn scaled(&self, factors: Factors) -> Self {
        let loops: Vec<_> = self.loops.iter().map(|test| test.scaled(factors)).collect();
        let varied = self.varied.iter().map(|varied| {
            // The default bounds of the force offset are proportional to the force.
            let mut scaled = varied.clone();
            if varied.key == super::FORCE_OFFSET && !varied.has_own_bounds {
                scaled.bounds = Varied::force_offset(&loops).bounds;
            }
            scaled
        });
        Self {
            varied: varied.collect(),
            loops,
            ..self.clone()
        }
    }

    /// Returns candidates with wider bounds for each parameter that ended at a bound.
    fn wider(&self, finding: &Finding) -> Vec<Candidate> {
        let keys: Vec<&String> = match finding {
            Finding::AtBound { key, .. } => vec![key],
            Finding::Missed { at_bounds, .. } => at_bounds.iter().map(|(key, _)| key).collect(),
            _ => Vec::new(),
        };
        let with_wider_bounds = |key: &String| {
            let parameter = self.varied.iter().position(|varied| varied.key == *key)?;
            let bounds = self.varied[parameter].wider()?;
            let mut calibration = self.clone();
            calibration.varied[parameter] = self.varied[parameter].with_bounds(bounds);
            let key = key.clone();
            Some(Candidate::new(
                calibration,
                vec![Remedy::Bounds { key, bounds }],
            ))
        };
        keys.into_iter().filter_map(with_wider_bounds).collect()
    }

    /// Returns the usual parameters of `damper` that are not in `varied`.
    fn usual(damper: &KeyedParameters, varied: &[Varied]) -> Vec<Varied> {
        let usual: &[&str] = match damper.number(REDUCED[0]) {
            Ok(_) => &REDUCED,
            Err(_) => &PHYSICAL,
        };
        let is_new = |key: &&&str| varied.iter().all(|varied| varied.key != **key);
        let new = usual.iter().filter(is_new);
        new.filter_map(|key| Varied::new(damper, key, None, None).ok())
            .collect()
    }

    /// Returns a candidate that also varies the usual parameters.
    fn with_more_parameters(&self) -> Option<Candidate> {
        let more = Self::usual(&self.damper, &self.varied);
        let keys: Vec<String> = more.iter().map(|varied| varied.key.clone()).collect();
        let mut calibration = self.clone();
        calibration.varied.splice(0..0, more);
        (!keys.is_empty()).then(|| Candidate {
            advice: vec![Remedy::VaryAlso(keys.clone())],
            calibration,
            added: keys,
        })
    }

    /// Returns a candidate for every other preset, starting from that preset.
    ///
    /// If the usual parameters of reduced dampers vary, all reduced presets are equivalent, so only one of them is
    /// tried, with and without saturation.
    fn started_from_presets(&self) -> Vec<Candidate> {
        let presets = PRESETS
            .iter()
            .filter_map(|(name, _)| self.started_from_preset(name));
        let mut presets: Vec<Candidate> = presets.collect();
        let is_reduced =
            |candidate: &Candidate| candidate.added.iter().any(|key| key == REDUCED[0]);
        if let Some(first) = presets.iter().position(is_reduced) {
            let linear = presets[first].without_saturation();
            let mut kept = 0;
            presets.retain(|candidate| {
                kept += usize::from(is_reduced(candidate));
                !is_reduced(candidate) || kept == 1
            });
            presets.extend(linear);
        }
        presets
    }

    /// Returns a candidate that starts from another preset and varies the same parameters; if the preset lacks one of
    /// them, its usual parameters are varied instead.
    fn started_from_preset(&self, name: &str) -> Option<Candidate> {
        let damper = KeyedParameters::new(name, &*load(name, &[]).ok()?).ok()?;
        if damper.name() == self.damper.name() {
            return None;
        }
        let (rig, own): (Vec<&Varied>, Vec<&Varied>) = self
            .varied
            .iter()
            .partition(|varied| varied.is_rig_parameter());
        let again = own.iter().map(|varied| {
            let bounds = varied.has_own_bounds.then_some(varied.bounds);
            Varied::new(&damper, &varied.key, bounds, varied.prior).ok()
        });
        let again: Option<Vec<Varied>> = again.collect();
        let (varied, added) = match again {
            Some(varied) => (varied, Vec::new()),
            None => {
                let usual = Self::usual(&damper, &[]);
                let keys = usual.iter().map(|varied| varied.key.clone()).collect();
                (usual, keys)
            }
        };
        let calibration = Self {
            damper,
            varied: varied.into_iter().chain(rig.into_iter().cloned()).collect(),
            ..self.clone()
        };
        let remedy = Remedy::OtherDamper {
            name: name.into(),
            vary: added.clone(),
        };
        Some(Candidate {
            advice: vec![remedy],
            calibration,
            added,
        })
    }
}

impl Candidate {
    fn new(calibration: Calibration, advice: Advice) -> Self {
        Self {
            advice,
            calibration,
            added: Vec::new(),
        }
    }

    /// Returns the same candidate with a reduced damper that never saturates and is therefore linear.
    fn without_saturation(&self) -> Option<Self> {
        let (key, value) = (REDUCED[1], 100.0);
        let damper = self.calibration.damper.with(&[(key, value)]).ok()?;
        let mut linear = Self {
            advice: self.advice.clone(),
            calibration: self.calibration.clone(),
            added: self
                .added
                .iter()
                .filter(|added| *added != key)
                .cloned()
                .collect(),
        };
        linear.calibration.damper =
            KeyedParameters::new(self.calibration.damper.name(), &damper).ok()?;
        linear.calibration.varied.retain(|varied| varied.key != key);
        linear.update_advice();
        linear.advice.push(Remedy::Set {
            key: key.into(),
            value,
        });
        Some(linear)
    }

    /// Lists in the advice the parameters that are added now, instead of those that were added before.
    fn update_advice(&mut self) {
        for remedy in &mut self.advice {
            match remedy {
                Remedy::VaryAlso(keys) | Remedy::OtherDamper { vary: keys, .. } => {
                    keys.clone_from(&self.added);
                }
                _ => {}
            }
        }
    }

    /// Returns how unlikely this cause is (lower is better); `None` if it does not explain the recordings.
    fn rank(&self, is_cancelled: &(dyn Fn() -> bool + Sync)) -> Option<f64> {
        let calibration = &self.calibration;
        calibration.reject_impossible().ok()?;
        let model: Model<'_> = calibration.model(is_cancelled);
        let fit = model.quick_fit()?;
        let share = model.worst_misfit(&fit.coordinates).ok()??.share;
        if share > calibration.assumed.max_misfit {
            return None;
        }
        let starts = calibration.varied.iter().zip(&fit.coordinates);
        let distance: f64 = starts
            .map(|(varied, coordinate)| (varied.coordinate(varied.start) - coordinate).abs())
            .sum();
        let distance = distance / calibration.varied.len() as f64;
        let changes = self.advice.len() + self.added.len();
        Some(share + COST_PER_CHANGE * changes as f64 + COST_OF_DISTANCE * distance)
    }

    /// Returns the advice if it leads to a result.
    ///
    /// Added parameters that the tests do not determine are removed first.
    fn confirmed(mut self, is_cancelled: &(dyn Fn() -> bool + Sync)) -> Option<Advice> {
        self.calibration.starts = 1;
        match self.calibration.attempt(&|_| {}, is_cancelled) {
            Ok(_) => return Some(self.advice),
            Err(CalibrationError::Undetermined { parameters }) => {
                let is_undetermined = |key: &String| {
                    parameters
                        .iter()
                        .any(|(undetermined, _)| undetermined == key)
                };
                if self.added.is_empty()
                    || !parameters.iter().all(|(key, _)| self.added.contains(key))
                {
                    return None;
                }
                self.added.retain(|key| !is_undetermined(key));
                self.calibration
                    .varied
                    .retain(|varied| !is_undetermined(&varied.key));
            }
            Err(_) => return None,
        }
        if self.added.is_empty() {
            return None;
        }
        self.update_advice();
        self.calibration.attempt(&|_| {}, is_cancelled).ok()?;
        Some(self.advice)
    }
}
