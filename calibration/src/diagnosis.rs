//! What would make the recordings fit: each cause that a user can remove is tried by a fit, so that what is advised works.

use super::misfit::Finding;
use super::model::Model;
use super::remedy::{Advice, Remedy};
use super::varied::Varied;
use super::{Calibration, CalibrationError};
use dashpot_files::damper::{Keyed, PRESETS, load};

/// A change that a user has to make counts like so much more of the force missed: of two that explain as much the simpler is advised.
const A_CHANGE: f64 = 0.02;

/// Where units cannot be told apart by the fit, the one that leaves the numbers nearest to the start is advised: a search through all its bounds counts so.
const A_SEARCH: f64 = 0.05;

/// Two causes are as likely within this.
const SAME: f64 = 5e-3;

/// Pieces of advice at most.
const MOST_ADVICE: usize = 2;

/// Larger displacements (m) than a bench usually makes, and smaller ones than show a damper's law; forces (N) likewise.
const USUAL_AMPLITUDES_M: [f64; 2] = [1e-3, 0.1];
const USUAL_FORCES_N: [f64; 2] = [200.0, 2e5];

/// Numbers that vary in most calibrations of a physical damper.
const PHYSICAL: [&str; 3] = [
    "orifice.discharge_coefficient",
    "mount.stiffness_n_per_m",
    "mount.clearance_m",
];

/// Those of a reduced one.
const REDUCED: [&str; 4] = [
    "reduced.damping_n_s_per_m",
    "reduced.saturation_velocity_m_per_s",
    "mount.stiffness_n_per_m",
    "mount.clearance_m",
];

/// A calibration with a cause removed.
struct Candidate {
    advice: Advice,
    calibration: Calibration,
    /// Numbers that nobody asked for and that may be left out.
    added: Vec<String>,
}

impl Calibration {
    /// What a user can do about `finding`, the most likely first: each was tried and gives a result.
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
            let is_as_likely = advice.first().is_none_or(|(best, _)| rank <= best + SAME);
            if advice.len() == MOST_ADVICE || !is_as_likely || is_cancelled() {
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

    /// All causes that may be behind `finding`.
    fn candidates(&self, finding: &Finding) -> Vec<Candidate> {
        let mut candidates = Vec::new();
        for (signs, reversed) in self.signs() {
            for (factors, scaled) in self.scales(finding) {
                let advice: Advice = reversed.iter().chain(&scaled).cloned().collect();
                if !advice.is_empty() {
                    let factors = [signs[0] * factors[0], signs[1] * factors[1]];
                    candidates.push(Candidate::of(self.scaled(factors), advice));
                }
            }
        }
        candidates.extend(self.wider(finding));
        if matches!(finding, Finding::Missed { .. } | Finding::AtBound { .. }) {
            candidates.extend(self.with_more_numbers());
            candidates.extend(self.started_from_presets());
        }
        candidates
    }

    /// Signs of displacement and force that the work allows.
    fn signs(&self) -> Vec<([f64; 2], Advice)> {
        let force = ([1.0, -1.0], vec![Remedy::ReverseForce]);
        let displacement = ([-1.0, 1.0], vec![Remedy::ReverseDisplacement]);
        let both = (
            [-1.0, -1.0],
            vec![Remedy::ReverseForce, Remedy::ReverseDisplacement],
        );
        let neither = ([1.0, 1.0], Vec::new());
        match self.certain_sign() {
            Some(sign) if sign < 0.0 => vec![force, displacement],
            Some(_) => vec![neither, both],
            None => vec![neither, force, displacement, both],
        }
    }

    /// Factors of displacement and force that usual units differ by.
    fn scales(&self, finding: &Finding) -> Vec<([f64; 2], Advice)> {
        let largest =
            |of: &dyn Fn(&super::LoopTest) -> f64| self.loops.iter().map(of).fold(0.0, f64::max);
        let amplitude_m = largest(&|test| test.amplitude_m);
        let force_n = largest(&|test| test.peak_force_n);
        let of_displacement = |factor| ([factor, 1.0], vec![Remedy::ScaleDisplacement(factor)]);
        let of_force = |factor| ([1.0, factor], vec![Remedy::ScaleForce(factor)]);
        if matches!(finding, Finding::TooFast { .. }) {
            // Millimetres, centimetres, inches, micrometres.
            return [1e-3, 1e-2, 0.0254, 1e-6].map(of_displacement).into();
        }
        let mut scales = vec![([1.0, 1.0], Vec::new())];
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

    fn scaled(&self, factors: [f64; 2]) -> Self {
        let loops: Vec<_> = self.loops.iter().map(|test| test.scaled(factors)).collect();
        let varied = self.varied.iter().map(|varied| {
            // Default bounds of the force's offset follow the force.
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

    /// With wider bounds of a number that ended at one.
    fn wider(&self, finding: &Finding) -> Vec<Candidate> {
        let keys: Vec<&String> = match finding {
            Finding::AtBound { key, .. } => vec![key],
            Finding::Missed { at_bounds, .. } => at_bounds.iter().map(|(key, _)| key).collect(),
            _ => Vec::new(),
        };
        let of = |key: &String| {
            let number = self.varied.iter().position(|varied| varied.key == *key)?;
            let bounds = self.varied[number].wider()?;
            let mut calibration = self.clone();
            calibration.varied[number] = self.varied[number].between(bounds);
            let key = key.clone();
            Some(Candidate::of(
                calibration,
                vec![Remedy::Bounds { key, bounds }],
            ))
        };
        keys.into_iter().filter_map(of).collect()
    }

    /// The usual numbers of `damper` that do not yet vary in `varied`.
    fn usual(damper: &Keyed, varied: &[Varied]) -> Vec<Varied> {
        let usual: &[&str] = match damper.number(REDUCED[0]) {
            Ok(_) => &REDUCED,
            Err(_) => &PHYSICAL,
        };
        let is_new = |key: &&&str| varied.iter().all(|varied| varied.key != **key);
        let new = usual.iter().filter(is_new);
        new.filter_map(|key| Varied::new(damper, key, None, None).ok())
            .collect()
    }

    /// With the usual numbers beside those that vary.
    fn with_more_numbers(&self) -> Option<Candidate> {
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

    /// From each other preset. One reduced damper stands for all where its usual numbers vary, beside the same that never saturates.
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

    /// From another preset, with the same numbers where it has them and with its usual ones where not.
    fn started_from_preset(&self, name: &str) -> Option<Candidate> {
        let damper = Keyed::new(name, &*load(name, &[]).ok()?).ok()?;
        if damper.name() == self.damper.name() {
            return None;
        }
        let (rig, own): (Vec<&Varied>, Vec<&Varied>) =
            self.varied.iter().partition(|varied| varied.is_of_rig());
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
    fn of(calibration: Calibration, advice: Advice) -> Self {
        Self {
            advice,
            calibration,
            added: Vec::new(),
        }
    }

    /// The same for a reduced damper that never saturates, which is linear.
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
        linear.calibration.damper = Keyed::new(self.calibration.damper.name(), &damper).ok()?;
        linear.calibration.varied.retain(|varied| varied.key != key);
        linear.name_added();
        linear.advice.push(Remedy::Set {
            key: key.into(),
            value,
        });
        Some(linear)
    }

    /// Puts the numbers that are added into the advice.
    fn name_added(&mut self) {
        for remedy in &mut self.advice {
            match remedy {
                Remedy::VaryAlso(keys) | Remedy::OtherDamper { vary: keys, .. } => {
                    keys.clone_from(&self.added);
                }
                _ => {}
            }
        }
    }

    /// How unlikely it is as the cause, the lower the better; `None` where it does not explain the recordings.
    fn rank(&self, is_cancelled: &(dyn Fn() -> bool + Sync)) -> Option<f64> {
        let calibration = &self.calibration;
        calibration.refuse_impossible().ok()?;
        let model: Model<'_> = calibration.model(is_cancelled);
        let fit = model.quick_fit()?;
        let share = model.worst_misfit(&fit.places).ok()??.share;
        if share > calibration.assumed.most_missed {
            return None;
        }
        let starts = calibration.varied.iter().zip(&fit.places);
        let distance: f64 = starts
            .map(|(varied, place)| (varied.place(varied.start) - place).abs())
            .sum();
        let distance = distance / calibration.varied.len() as f64;
        let changes = self.advice.len() + self.added.len();
        Some(share + A_CHANGE * changes as f64 + A_SEARCH * distance)
    }

    /// The advice if it leads to a result, without numbers that were added in vain.
    fn confirmed(mut self, is_cancelled: &(dyn Fn() -> bool + Sync)) -> Option<Advice> {
        self.calibration.starts = 1;
        match self.calibration.attempt(&|_| {}, is_cancelled) {
            Ok(_) => return Some(self.advice),
            Err(CalibrationError::Undetermined { numbers }) => {
                let is_vain = |key: &String| numbers.iter().any(|(vain, _)| vain == key);
                if self.added.is_empty() || !numbers.iter().all(|(key, _)| self.added.contains(key))
                {
                    return None;
                }
                self.added.retain(|key| !is_vain(key));
                self.calibration
                    .varied
                    .retain(|varied| !is_vain(&varied.key));
            }
            Err(_) => return None,
        }
        if self.added.is_empty() {
            return None;
        }
        self.name_added();
        self.calibration.attempt(&|_| {}, is_cancelled).ok()?;
        Some(self.advice)
    }
}
