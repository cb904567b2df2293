//! Least-squares fit from several starting points.

use fastrand::Rng;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::model::Model;
use super::varied::{angle_at, coordinate_at, coordinate_slope};

/// A search ends when the relative change of the sum of squares, or of the angles, is at most this.
const TOLERANCE: f64 = 1e-7;

/// Spread of the starting points about the first, in normalised coordinates.
const SPREAD: f64 = 0.15;

/// Result of a search.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    /// Normalised coordinates of all parameters.
    pub(super) coordinates: Vec<f64>,
    /// Sum of squares of all deviations, including those from priors.
    pub(super) chi_square: f64,
}

/// Search over the `free` parameters; the others are held.
struct Search<'a> {
    model: &'a Model<'a>,
    free: &'a [usize],
    coordinates: Vec<f64>,
    angles: DVector<f64>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Search<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, angles: &DVector<f64>) {
        self.angles.copy_from(angles);
        for (parameter, angle) in self.free.iter().zip(angles.iter()) {
            self.coordinates[*parameter] = coordinate_at(*angle);
        }
    }

    fn params(&self) -> DVector<f64> {
        self.angles.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let mut deviations = self.model.deviations(&self.coordinates).ok()?;
        let priors = self.model.prior_terms(&self.coordinates);
        deviations.extend(priors.map(|prior| prior.deviation));
        Some(DVector::from_vec(deviations))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let of_tests = self.model.slopes(&self.coordinates, self.free).ok()?;
        let priors: Vec<_> = self.model.prior_terms(&self.coordinates).collect();
        let rows = of_tests.nrows();
        let mut slopes = DMatrix::zeros(rows + priors.len(), of_tests.ncols());
        for (mut column, of_tests) in slopes.column_iter_mut().zip(of_tests.column_iter()) {
            column
                .iter_mut()
                .zip(of_tests.iter())
                .for_each(|(slope, of_tests)| *slope = *of_tests);
        }
        for (row, prior) in priors.into_iter().enumerate() {
            if let Some(column) = self.free.iter().position(|free| *free == prior.parameter) {
                slopes[(rows + row, column)] = prior.slope;
            }
        }
        for (column, angle) in self.angles.iter().enumerate() {
            slopes
                .column_mut(column)
                .scale_mut(coordinate_slope(*angle));
        }
        Some(slopes)
    }
}

impl Model<'_> {
    /// Fits the `free` parameters, starting at `coordinates`; `None` if the search reached an invalid damper.
    pub(super) fn fit(&self, coordinates: &[f64], free: &[usize]) -> Option<Fit> {
        self.fit_within(coordinates, free, TOLERANCE, 20)
    }

    /// Runs a coarse fit of all parameters from the start, to compare causes: with a tolerance of 1e-3 and few steps.
    pub(super) fn quick_fit(&self) -> Option<Fit> {
        let start = self
            .varied
            .iter()
            .map(|varied| varied.coordinate(varied.start));
        let all: Vec<usize> = (0..self.varied.len()).collect();
        self.fit_within(&start.collect::<Vec<_>>(), &all, 1e-3, 2)
    }

    /// Fits to a relative tolerance, with at most `patience` evaluations per parameter.
    fn fit_within(
        &self,
        coordinates: &[f64],
        free: &[usize],
        tolerance: f64,
        patience: usize,
    ) -> Option<Fit> {
        let angles = free
            .iter()
            .map(|parameter| angle_at(coordinates[*parameter]));
        let mut coordinates = coordinates.to_vec();
        let angles = DVector::from_iterator(free.len(), angles);
        for (parameter, angle) in free.iter().zip(angles.iter()) {
            coordinates[*parameter] = coordinate_at(*angle);
        }
        let search = Search {
            model: self,
            free,
            coordinates,
            angles,
        };
        let method = LevenbergMarquardt::new()
            .with_ftol(tolerance)
            .with_xtol(tolerance)
            .with_gtol(tolerance)
            .with_patience(patience);
        let (search, report) = method.minimize(search);
        let chi_square = 2.0 * report.objective_function;
        chi_square.is_finite().then_some(Fit {
            coordinates: search.coordinates,
            chi_square,
        })
    }

    /// Fits from the start and from `starts - 1` random points about it; returns the fits in order of rising sum of
    /// squares.
    ///
    /// The result is reproducible. Calls `ended` after each fit.
    pub(super) fn fits(&self, starts: usize, ended: &(dyn Fn() + Sync)) -> Vec<Fit> {
        let first: Vec<f64> = self
            .varied
            .iter()
            .map(|varied| varied.coordinate(varied.start))
            .collect();
        let mut rng = Rng::with_seed(0xda5_4901);
        let mut coordinates = vec![first.clone()];
        while coordinates.len() < starts.max(1) {
            let about = first.iter().map(|coordinate| {
                // The sum of four uniform numbers is nearly normal.
                let sum: f64 = (0..4).map(|_| rng.f64() - 0.5).sum();
                (coordinate + SPREAD * sum * 3_f64.sqrt()).clamp(0.02, 0.98)
            });
            coordinates.push(about.collect());
        }
        let all: Vec<usize> = (0..self.varied.len()).collect();
        let fits = dashpot_workers::map(&coordinates, |coordinates| {
            let fit = self.fit(coordinates, &all);
            ended();
            Ok::<_, ()>(fit)
        });
        let mut fits: Vec<Fit> = fits.unwrap_or_default().into_iter().flatten().collect();
        fits.sort_by(|a, b| a.chi_square.total_cmp(&b.chi_square));
        fits
    }
}
