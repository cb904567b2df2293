//! The search for the least squares, from several starts.

use fastrand::Rng;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::model::Model;
use super::varied::{angle_of, place_of, place_slope};

/// Relative change of the sum of squares, and of the angles, at which a search ends.
const TOLERANCE: f64 = 1e-7;

/// Spread of the starts about the first, as places.
const SPREAD: f64 = 0.15;

/// Where a search ended.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    /// Places of all numbers.
    pub(super) places: Vec<f64>,
    /// Sum of the squares of all deviations, those from priors among them.
    pub(super) chi_square: f64,
}

/// A search for the places of the numbers `free`, the others held.
struct Search<'a> {
    model: &'a Model<'a>,
    free: &'a [usize],
    places: Vec<f64>,
    angles: DVector<f64>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Search<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, angles: &DVector<f64>) {
        self.angles.copy_from(angles);
        for (number, angle) in self.free.iter().zip(angles.iter()) {
            self.places[*number] = place_of(*angle);
        }
    }

    fn params(&self) -> DVector<f64> {
        self.angles.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let mut deviations = self.model.deviations(&self.places).ok()?;
        deviations.extend(
            self.model
                .off_priors(&self.places)
                .map(|(_, deviation, _)| deviation),
        );
        Some(DVector::from_vec(deviations))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let of_tests = self.model.slopes(&self.places, self.free).ok()?;
        let priors: Vec<_> = self.model.off_priors(&self.places).collect();
        let rows = of_tests.nrows();
        let mut slopes = DMatrix::zeros(rows + priors.len(), of_tests.ncols());
        for (mut column, of_tests) in slopes.column_iter_mut().zip(of_tests.column_iter()) {
            column
                .iter_mut()
                .zip(of_tests.iter())
                .for_each(|(slope, of_tests)| *slope = *of_tests);
        }
        for (row, (number, _, slope)) in priors.into_iter().enumerate() {
            if let Some(column) = self.free.iter().position(|free| *free == number) {
                slopes[(rows + row, column)] = slope;
            }
        }
        for (column, angle) in self.angles.iter().enumerate() {
            slopes.column_mut(column).scale_mut(place_slope(*angle));
        }
        Some(slopes)
    }
}

impl Model<'_> {
    /// The least squares from `places` on, over the numbers `free`; `None` where the search came to numbers that no damper has.
    pub(super) fn fit(&self, places: &[f64], free: &[usize]) -> Option<Fit> {
        self.fit_within(places, free, (TOLERANCE, 20))
    }

    /// A coarse fit of all numbers from the start on, to compare causes: to a thousandth of the squares, in a few steps.
    pub(super) fn quick_fit(&self) -> Option<Fit> {
        let start = self.varied.iter().map(|varied| varied.place(varied.start));
        let all: Vec<usize> = (0..self.varied.len()).collect();
        self.fit_within(&start.collect::<Vec<_>>(), &all, (1e-3, 2))
    }

    /// The least squares to a relative tolerance, in so many evaluations for each number.
    fn fit_within(
        &self,
        places: &[f64],
        free: &[usize],
        (tolerance, patience): (f64, usize),
    ) -> Option<Fit> {
        let angles = free.iter().map(|number| angle_of(places[*number]));
        let mut places = places.to_vec();
        let angles = DVector::from_iterator(free.len(), angles);
        for (number, angle) in free.iter().zip(angles.iter()) {
            places[*number] = place_of(*angle);
        }
        let search = Search {
            model: self,
            free,
            places,
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
            places: search.places,
            chi_square,
        })
    }

    /// The fits from the numbers as they are and from `starts - 1` places about them, those of the least sum of squares first; always the
    /// same for the same tests. Each is told to `ended`.
    pub(super) fn fits(&self, starts: usize, ended: &(dyn Fn() + Sync)) -> Vec<Fit> {
        let first: Vec<f64> = self
            .varied
            .iter()
            .map(|varied| varied.place(varied.start))
            .collect();
        let mut rng = Rng::with_seed(0xda5_4901);
        let mut places = vec![first.clone()];
        while places.len() < starts.max(1) {
            let about = first.iter().map(|place| {
                // The sum of four is near to normal.
                let sum: f64 = (0..4).map(|_| rng.f64() - 0.5).sum();
                (place + SPREAD * sum * 3_f64.sqrt()).clamp(0.02, 0.98)
            });
            places.push(about.collect());
        }
        let all: Vec<usize> = (0..self.varied.len()).collect();
        let fits = dashpot_workers::map(&places, |places| {
            let fit = self.fit(places, &all);
            ended();
            Ok::<_, ()>(fit)
        });
        let mut fits: Vec<Fit> = fits.unwrap_or_default().into_iter().flatten().collect();
        fits.sort_by(|a, b| a.chi_square.total_cmp(&b.chi_square));
        fits
    }
}
