//! What is compared: the forces of a damper with these numbers, and those of the tests.

use dashpot_core::CheckedParameters;
use nalgebra::DMatrix;

use super::CalibrationError;
use super::indices::IndexTest;
use super::loops::LoopTest;
use super::rig::{FORCE_OFFSET, HeldRig, SKEW};
use super::varied::Varied;
use dashpot_files::damper::Keyed;
use dashpot_testbench::bench_test;

/// Change for a derivative, of what is tolerated: some percent of a force, beside the hundredth of a percent that a built table misses.
const CHANGE: f64 = 0.3;

/// A damper, the numbers of it that vary, and the tests.
pub(super) struct Model<'a> {
    pub(super) damper: Keyed,
    pub(super) varied: Vec<Varied>,
    /// The rig's numbers where they are not varied.
    pub(super) rig: HeldRig,
    pub(super) loops: Vec<LoopTest>,
    pub(super) indices: Vec<IndexTest>,
    /// The step of all loops (s): the damper is built once for all of them.
    pub(super) step_s: f64,
    /// What one sample of each loop scatters by (N), so that the samples count as if they were independent.
    pub(super) scatter_n: Vec<f64>,
    /// Whether nobody wants the result any more: then nothing is compared.
    pub(super) is_cancelled: &'a (dyn Fn() -> bool + Sync),
}

impl Model<'_> {
    /// The damper with the varied numbers at `places`.
    ///
    /// # Errors
    /// Numbers that no damper has together.
    pub(super) fn damper_at(&self, places: &[f64]) -> Result<CheckedParameters, CalibrationError> {
        self.damper_with(places, &[])
    }

    /// The same with `more` numbers at their keys.
    ///
    /// # Errors
    /// As [`Model::damper_at`].
    pub(super) fn damper_with(
        &self,
        places: &[f64],
        more: &[(&str, f64)],
    ) -> Result<CheckedParameters, CalibrationError> {
        let values = self.values(places);
        let numbers: Vec<(&str, f64)> = self
            .varied
            .iter()
            .zip(values)
            .filter(|(varied, _)| !varied.is_of_rig())
            .map(|(varied, value)| (varied.key.as_str(), value))
            .chain(more.iter().copied())
            .collect();
        Ok(self.damper.with(&numbers)?)
    }

    /// The varied numbers at `places`.
    pub(super) fn values(&self, places: &[f64]) -> Vec<f64> {
        let values = self.varied.iter().zip(places);
        values.map(|(varied, place)| varied.at(*place)).collect()
    }

    /// The number at `key` where it is varied, else `held`.
    fn varied_or(&self, places: &[f64], key: &str, held: f64) -> f64 {
        let mut values = self.varied.iter().zip(places);
        let found = values.find(|(varied, _)| varied.key == key);
        found.map_or(held, |(varied, place)| varied.at(*place))
    }

    /// What the force sensor shows at no force (N).
    pub(super) fn force_offset_n(&self, places: &[f64]) -> f64 {
        self.varied_or(places, FORCE_OFFSET, self.rig.force_offset_n)
    }

    /// What the sensor shows of the model's forces at the samples that count (N), loop by loop.
    ///
    /// # Errors
    /// Numbers that no damper has together; forces that are unwanted.
    pub(super) fn forces_n(&self, places: &[f64]) -> Result<Vec<Vec<f64>>, CalibrationError> {
        self.forces_of(&self.damper_at(places)?, places)
    }

    /// The same of `damper`.
    fn forces_of(
        &self,
        damper: &CheckedParameters,
        places: &[f64],
    ) -> Result<Vec<Vec<f64>>, CalibrationError> {
        if (self.is_cancelled)() {
            return Err(CalibrationError::Cancelled);
        }
        let built = damper.build::<f64>(self.step_s)?;
        let later = self.varied_or(places, SKEW, self.rig.skew_s) / self.step_s;
        let offset_n = self.force_offset_n(places);
        let forces = self.loops.iter().map(|test| {
            // The force knows motion only, so every motion is about zero, wherever the sensor has its own.
            let middle = test.displacement_offset_m;
            let x = &test.displacements_m;
            let mut state = built.at_rest(x[0] - middle);
            let forces: Vec<f64> = x
                .iter()
                .map(|x| built.step(&mut state, *x - middle) + offset_n)
                .collect();
            test.at_counted(&forces, later)
        });
        Ok(forces.collect())
    }

    /// What the tests have and the model lacks, each over what it scatters by: loops, then indices.
    ///
    /// # Errors
    /// As [`Model::forces_n`]; a damper whose force does not become periodic.
    pub(super) fn deviations(&self, places: &[f64]) -> Result<Vec<f64>, CalibrationError> {
        self.deviations_of(&self.damper_at(places)?, places)
    }

    /// The same of `damper`.
    ///
    /// # Errors
    /// As [`Model::deviations`].
    pub(super) fn deviations_of(
        &self,
        damper: &CheckedParameters,
        places: &[f64],
    ) -> Result<Vec<f64>, CalibrationError> {
        let forces = self.forces_of(damper, places)?;
        let mut deviations = Vec::with_capacity(self.count());
        for ((test, scatter), forces) in self.loops.iter().zip(&self.scatter_n).zip(&forces) {
            let measured = test.counted_forces_n().iter();
            deviations.extend(measured.zip(forces).map(|(f, model)| (model - f) / scatter));
        }
        if !self.indices.is_empty() {
            for test in &self.indices {
                let cycle =
                    bench_test::run_cancellable(damper, test.motion(), self.step_s, self.is_cancelled)?;
                deviations.extend(test.deviations(&cycle.indices()));
            }
        }
        Ok(deviations)
    }

    /// Which numbers have priors, how far they are from them at `places`, in standard deviations, and that over the place.
    pub(super) fn off_priors(&self, places: &[f64]) -> impl Iterator<Item = (usize, f64, f64)> {
        let numbers = self.varied.iter().zip(places).enumerate();
        numbers.filter_map(|(number, (varied, place))| {
            let (deviation, slope) = varied.off_prior(varied.at(*place))?;
            Some((number, deviation, slope))
        })
    }

    /// How many deviations there are.
    fn count(&self) -> usize {
        let loops = self.loops.iter().map(|test| test.counted.len());
        let indices = self.indices.iter().map(IndexTest::count);
        loops.chain(indices).sum()
    }

    /// The deviations over the places of the numbers `of`, by central differences.
    ///
    /// # Errors
    /// As [`Model::deviations`].
    pub(super) fn slopes(
        &self,
        places: &[f64],
        of: &[usize],
    ) -> Result<DMatrix<f64>, CalibrationError> {
        let mut slopes = DMatrix::zeros(self.count(), of.len());
        for (column, number) in of.iter().enumerate() {
            let moved = |by: f64| {
                let mut moved = places.to_vec();
                moved[*number] = (moved[*number] + by).clamp(0.0, 1.0);
                moved
            };
            let varied = &self.varied[*number];
            let change = CHANGE * varied.tolerance(varied.at(places[*number]));
            let (below, above) = (moved(-change), moved(change));
            let between = above[*number] - below[*number];
            let (above, below) = (self.deviations(&above)?, self.deviations(&below)?);
            for (row, (above, below)) in above.iter().zip(&below).enumerate() {
                slopes[(row, column)] = (above - below) / between;
            }
        }
        Ok(slopes)
    }
}
