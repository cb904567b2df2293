//! How far the lengths of the strips go in one step.

/// Bounds of a length after a step, as fractions of the length before.
const BOUNDS: [f64; 2] = [0.5, 2.0];

/// The last step of the lengths, from which the next one learns how far to go (Anderson 1965).
#[derive(Debug, Clone, Default)]
pub(super) struct Steps {
    loaded: Vec<usize>,
    lengths_m: Vec<f64>,
    steps_m: Vec<f64>,
    spare: Vec<f64>,
}

impl Steps {
    /// Forgets the last step.
    pub fn forget(&mut self) {
        self.loaded.clear();
    }

    /// An empty vector for the next steps.
    pub fn cleared(&mut self) -> Vec<f64> {
        let mut steps = std::mem::take(&mut self.spare);
        steps.clear();
        steps
    }

    /// Moves the lengths of the `loaded` strips by `part` of `steps` and on along the last change. The secant through
    /// the last two steps estimates where they vanish.
    pub fn accelerated(
        &mut self,
        loaded: &[usize],
        steps: Vec<f64>,
        part: f64,
        lengths_m: &mut [f64],
    ) {
        let mut slope = 0.0;
        if self.loaded == loaded {
            let (mut product, mut square) = (0.0, 0.0);
            for (step, before) in steps.iter().zip(&self.steps_m) {
                let change = step - before;
                product += step * change;
                square += change * change;
            }
            if square > 0.0 {
                slope = product / square;
            }
        } else {
            self.loaded.clear();
            self.loaded.extend_from_slice(loaded);
            self.lengths_m.resize(loaded.len(), 0.0);
            self.steps_m.resize(loaded.len(), 0.0);
        }
        for (k, (&i, step)) in loaded.iter().zip(&steps).enumerate() {
            let here = lengths_m[i];
            let change = here - self.lengths_m[k] + part * (step - self.steps_m[k]);
            let next = here + part * step - slope * change;
            lengths_m[i] = next.clamp(BOUNDS[0] * here, BOUNDS[1] * here);
            self.lengths_m[k] = here;
        }
        self.spare = std::mem::replace(&mut self.steps_m, steps);
    }
}
