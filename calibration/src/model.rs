//! Compares the forces of a damper with those of the tests.

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::Element;
use nalgebra::DMatrix;

use super::CalibrationError;
use super::indices::IndexTest;
use super::keys::{FORCE_OFFSET, SKEW, TEMPERATURE};
use super::loops::LoopTest;
use super::rig::HeldRig;
use super::varied::Varied;
use dashpot_files::damper::KeyedParameters;
use dashpot_testbench::bench_test;

/// Step of the central differences, as a share of the tolerance. It changes a force by some percent, far more than the
/// error of a built damper's tables, which is 0.01 %.
const DIFFERENCE: f64 = 0.3;

/// A damper, its varied parameters and the tests.
pub(super) struct Model<'a> {
    pub(super) damper: KeyedParameters,
    pub(super) varied: Vec<Varied>,
    /// Rig parameters that are not varied.
    pub(super) rig: HeldRig,
    pub(super) loops: Vec<LoopTest>,
    pub(super) indices: Vec<IndexTest>,
    /// Step of all loops (s), so that the damper is built once for all of them.
    pub(super) step_s: f64,
    /// Scatter of one sample of each loop (N), enlarged so that correlated samples can count as independent.
    pub(super) scatter_n: Vec<f64>,
    /// Returns true if the caller cancelled the calibration.
    pub(super) is_cancelled: &'a (dyn Fn() -> bool + Sync),
}

/// Deviation of a parameter from its prior.
pub(super) struct PriorTerm {
    /// Index of the parameter.
    pub(super) parameter: usize,
    /// Distance from the mean, in standard deviations.
    pub(super) deviation: f64,
    /// Derivative of the deviation with respect to the coordinate.
    pub(super) slope: f64,
}

impl Model<'_> {
    /// Returns the damper with the varied parameters at `coordinates`.
    ///
    /// # Errors
    /// Returns an error for an invalid combination of parameters.
    pub(super) fn damper_at(
        &self,
        coordinates: &[f64],
    ) -> Result<CheckedParameters, CalibrationError> {
        self.damper_with(coordinates, &[])
    }

    /// Returns the same damper with `more` parameters set by key.
    ///
    /// # Errors
    /// Same errors as [`Model::damper_at`].
    pub(super) fn damper_with(
        &self,
        coordinates: &[f64],
        more: &[(&str, f64)],
    ) -> Result<CheckedParameters, CalibrationError> {
        let values = self.values(coordinates);
        let parameters: Vec<(&str, f64)> = self
            .varied
            .iter()
            .zip(values)
            .filter(|(varied, _)| !varied.is_rig_parameter() && varied.test().is_none())
            .map(|(varied, value)| (varied.key.as_str(), value))
            .chain(more.iter().copied())
            .collect();
        Ok(self.damper.with(&parameters)?)
    }

    /// Returns the values of the varied parameters at `coordinates`.
    pub(super) fn values(&self, coordinates: &[f64]) -> Vec<f64> {
        let values = self.varied.iter().zip(coordinates);
        values
            .map(|(varied, coordinate)| varied.value_at(*coordinate))
            .collect()
    }

    /// Returns the parameter `base` of a test (from 1) if it is varied, for this test or for all, otherwise `held`.
    fn varied_or(&self, coordinates: &[f64], base: &str, test: usize, held: f64) -> f64 {
        let values = self.varied.iter().zip(coordinates);
        let mut values = values.filter(|(varied, _)| {
            varied.base() == base && varied.test().is_none_or(|own| own == test)
        });
        let found = values.next();
        found.map_or(held, |(varied, coordinate)| varied.value_at(*coordinate))
    }

    /// Returns what the force sensor reads at zero force in a test (N); tests count from 1.
    pub(super) fn force_offset_n(&self, coordinates: &[f64], test: usize) -> f64 {
        self.varied_or(coordinates, FORCE_OFFSET, test, self.rig.force_offset_n)
    }

    /// Returns the parameters of the damper that a test (from 1) has for itself: varied ones and its temperature.
    fn own_parameters(
        &self,
        damper: &CheckedParameters,
        coordinates: &[f64],
        test: usize,
    ) -> Vec<(&str, f64)> {
        let values = self.varied.iter().zip(coordinates);
        let own =
            values.filter(|(varied, _)| varied.test() == Some(test) && !varied.is_rig_parameter());
        let mut own: Vec<(&str, f64)> = own
            .map(|(varied, coordinate)| (varied.base(), varied.value_at(*coordinate)))
            .collect();
        let is_own = own.iter().any(|(key, _)| *key == TEMPERATURE);
        let given = self.loops[test - 1].temperature_c.filter(|_| !is_own);
        if let (Some(given_c), Element::Physical(changed), Ok(nominal_c)) =
            (given, &damper.element, self.damper.number(TEMPERATURE))
        {
            // A change of the damper's temperature, as an assumption that may be wrong, changes that of every test.
            own.push((TEMPERATURE, given_c + changed.oil.temperature_c - nominal_c));
        }
        own
    }

    /// Returns the model's forces as the sensor would show them at the samples that count (N), by loop.
    ///
    /// # Errors
    /// Returns an error for an invalid combination of parameters, or if the caller cancelled the calibration.
    pub(super) fn forces_n(&self, coordinates: &[f64]) -> Result<Vec<Vec<f64>>, CalibrationError> {
        self.forces_of(&self.damper_at(coordinates)?, coordinates)
    }

    /// Same as [`Model::forces_n`], but for the damper `damper`.
    fn forces_of(
        &self,
        damper: &CheckedParameters,
        coordinates: &[f64],
    ) -> Result<Vec<Vec<f64>>, CalibrationError> {
        if (self.is_cancelled)() {
            return Err(CalibrationError::Cancelled);
        }
        let mut built = Vec::new();
        let forces = self.loops.iter().zip(1..).map(|(test, number)| {
            let own = self.own_parameters(damper, coordinates, number);
            if !built.iter().any(|(other, _)| *other == own) {
                let changed = match own.is_empty() {
                    true => damper.build::<f64>(self.step_s)?,
                    false => KeyedParameters::new(self.damper.name(), damper)?
                        .with(&own)?
                        .build::<f64>(self.step_s)?,
                };
                built.push((own.clone(), changed));
            }
            let found = built.iter().find(|(other, _)| *other == own);
            let Some((_, built)) = found else {
                return Ok(Vec::new());
            };
            let skew_s = self.varied_or(coordinates, SKEW, number, self.rig.skew_s);
            let offset_n = self.force_offset_n(coordinates, number);
            // The force depends only on how the displacement changes, so every motion is centred on zero, whatever the
            // sensor offset.
            let middle = test.displacement_offset_m;
            let x = &test.displacements_m;
            let mut state = built.at_rest(x[0] - middle);
            let forces: Vec<f64> = x
                .iter()
                .map(|x| built.step(&mut state, *x - middle) + offset_n)
                .collect();
            Ok(test.at_counted(&forces, skew_s / self.step_s))
        });
        forces.collect()
    }

    /// Returns model minus test, in standard deviations: samples of the loops, then indices.
    ///
    /// # Errors
    /// Same errors as [`Model::forces_n`]; also an error for a force that does not become periodic.
    pub(super) fn deviations(&self, coordinates: &[f64]) -> Result<Vec<f64>, CalibrationError> {
        self.deviations_of(&self.damper_at(coordinates)?, coordinates)
    }

    /// Same as [`Model::deviations`], but for the damper `damper`.
    ///
    /// # Errors
    /// Same errors as [`Model::deviations`].
    pub(super) fn deviations_of(
        &self,
        damper: &CheckedParameters,
        coordinates: &[f64],
    ) -> Result<Vec<f64>, CalibrationError> {
        let forces = self.forces_of(damper, coordinates)?;
        let mut deviations = Vec::with_capacity(self.count());
        for ((test, scatter), forces) in self.loops.iter().zip(&self.scatter_n).zip(&forces) {
            let measured = test.counted_forces_n().iter();
            deviations.extend(measured.zip(forces).map(|(f, model)| (model - f) / scatter));
        }
        if !self.indices.is_empty() {
            for test in &self.indices {
                let cycle = bench_test::run_cancellable(
                    damper,
                    test.motion(),
                    self.step_s,
                    self.is_cancelled,
                )?;
                deviations.extend(test.deviations(&cycle.indices()));
            }
        }
        Ok(deviations)
    }

    /// Returns one term per parameter with a prior.
    pub(super) fn prior_terms(&self, coordinates: &[f64]) -> impl Iterator<Item = PriorTerm> {
        let parameters = self.varied.iter().zip(coordinates).enumerate();
        parameters.filter_map(|(parameter, (varied, coordinate))| {
            let prior = varied.prior?;
            let value = varied.value_at(*coordinate);
            Some(PriorTerm {
                parameter,
                deviation: (value - prior.mean) / prior.standard_deviation,
                slope: varied.slope(value) / prior.standard_deviation,
            })
        })
    }

    /// Returns the number of deviations.
    fn count(&self) -> usize {
        let loops = self.loops.iter().map(|test| test.counted.len());
        let indices = self.indices.iter().map(IndexTest::count);
        loops.chain(indices).sum()
    }

    /// Returns the derivatives of the deviations with respect to the coordinates `columns`, by central differences.
    ///
    /// # Errors
    /// Same errors as [`Model::deviations`].
    pub(super) fn slopes(
        &self,
        coordinates: &[f64],
        columns: &[usize],
    ) -> Result<DMatrix<f64>, CalibrationError> {
        let mut slopes = DMatrix::zeros(self.count(), columns.len());
        for (column, parameter) in columns.iter().enumerate() {
            let moved = |by: f64| {
                let mut moved = coordinates.to_vec();
                moved[*parameter] = (moved[*parameter] + by).clamp(0.0, 1.0);
                moved
            };
            let varied = &self.varied[*parameter];
            let change = DIFFERENCE * varied.tolerance(varied.value_at(coordinates[*parameter]));
            let (below, above) = (moved(-change), moved(change));
            let between = above[*parameter] - below[*parameter];
            let (above, below) = (self.deviations(&above)?, self.deviations(&below)?);
            for (row, (above, below)) in above.iter().zip(&below).enumerate() {
                slopes[(row, column)] = (above - below) / between;
            }
        }
        Ok(slopes)
    }
}
