//! Starting values of the stages' iterations.

/// Weights of the earlier stages in the prediction of each stage.
pub(super) struct Predictor {
    weights: Vec<Vec<f64>>,
}

impl Predictor {
    /// Builds the weights of the polynomials through at most `predicting` stages before each stage (Lagrange).
    pub(super) fn new(times: &[f64], predicting: usize) -> Self {
        let weights = |stage: usize| {
            let earlier = &times[stage.saturating_sub(predicting)..stage];
            let weight = |of: &f64| {
                let others = earlier.iter().filter(|other| *other != of);
                others
                    .map(|other| (times[stage] - other) / (of - other))
                    .product()
            };
            earlier.iter().map(weight).collect()
        };
        Self {
            weights: (0..times.len()).map(weights).collect(),
        }
    }

    /// Writes the predicted increment of the stage that follows the `earlier` ones.
    pub(super) fn predict(&self, earlier: &[Vec<f64>], increment: &mut [f64]) {
        increment.fill(0.0);
        let weights = &self.weights[earlier.len()];
        let predicting = &earlier[earlier.len() - weights.len()..];
        for (earlier, weight) in predicting.iter().zip(weights) {
            super::add_multiple(increment, *weight, earlier);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_predicted_from_three_stages() {
        let parabola = |t: f64| vec![1.0 - 2.0 * t + 3.0 * t * t];
        let times = [0.0, 0.9, 0.5, 1.0];
        let earlier: Vec<_> = times[..3].iter().map(|time| parabola(*time)).collect();
        let predicted = |predicting| {
            let mut predicted = [f64::NAN];
            Predictor::new(&times, predicting).predict(&earlier, &mut predicted);
            predicted[0]
        };
        assert!((predicted(3) - 2.0).abs() < 1e-14);
        // The line through the last two stages.
        let line = 0.75 + (1.63 - 0.75) / 0.4 * 0.5;
        assert!((predicted(2) - line).abs() < 1e-14);
    }
}
