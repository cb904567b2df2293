//! Cells along the surface of a profile, in which wear is added up.

use dashpot_rail::profile::Profile;

/// Width of a cell along the surface, m.
pub const CELL_M: f64 = 0.5e-3;

/// Cells of equal width along the surface of a profile, from its first sample on.
#[derive(Debug, Clone, PartialEq)]
pub struct WearGrid {
    /// Lateral position and distance along the surface of each sample of the profile, m.
    samples_m: Vec<[f64; 2]>,
    /// Lateral position and depth at the middle of each cell, m.
    middles_m: Vec<[f64; 2]>,
}

impl WearGrid {
    /// Divides a profile into cells of [`CELL_M`]; the last one may reach beyond its end.
    ///
    /// ```
    /// use dashpot_rail::profile::s1002;
    /// use dashpot_wear::WearGrid;
    /// let grid = WearGrid::new(&s1002::profile());
    /// // The tread datum is about 92 mm along the surface from the back of the flange.
    /// assert!((grid.arc_m(0.0) - 0.0919).abs() < 1e-3);
    /// ```
    pub fn new(profile: &Profile) -> Self {
        let samples_m = arcs(profile);
        let length_m = samples_m.last().map_or(0.0, |last| last[1]);
        let cells = (length_m / CELL_M).ceil().max(1.0) as usize;
        let middle = |cell: usize| {
            let y_m = lateral(&samples_m, (cell as f64 + 0.5) * CELL_M);
            [y_m, profile.at(y_m).z_m]
        };
        Self {
            middles_m: (0..cells).map(middle).collect(),
            samples_m,
        }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.middles_m.len()
    }

    /// Lateral position and depth of the middle of a cell in the axes of the profile, m.
    pub fn middle_m(&self, cell: usize) -> [f64; 2] {
        self.middles_m[cell]
    }

    /// Distance along the surface from the first sample at a lateral position, m; beyond the profile, that of its end.
    #[inline]
    pub fn arc_m(&self, y_m: f64) -> f64 {
        interpolated(&self.samples_m, y_m, [0, 1])
    }

    /// Adds `amount` to the cells from `start_m` to `end_m` along the surface, evenly. The end cells take what lies
    /// beyond the profile.
    #[inline]
    pub(crate) fn spread(&self, cells: &mut [f64], [start_m, end_m]: [f64; 2], amount: f64) {
        let last = cells.len() - 1;
        let [start, end] = [start_m / CELL_M, end_m / CELL_M];
        let width = end - start;
        if !(width > 0.0 && width.is_finite()) {
            cells[cell_of(start, last)] += amount;
            return;
        }
        let per_cell = amount / width;
        let first = cell_of(start, last);
        for (cell, sum) in cells
            .iter_mut()
            .enumerate()
            .take(cell_of(end, last) + 1)
            .skip(first)
        {
            let from = if cell == 0 {
                start
            } else {
                start.max(cell as f64)
            };
            let to = if cell == last {
                end
            } else {
                end.min(cell as f64 + 1.0)
            };
            *sum += per_cell * (to - from).max(0.0);
        }
    }
}

/// The cell at a position in cells.
#[inline]
fn cell_of(position: f64, last: usize) -> usize {
    (position.max(0.0) as usize).min(last)
}

/// Lateral position and distance along the surface of each sample of a profile, m.
pub(crate) fn arcs(profile: &Profile) -> Vec<[f64; 2]> {
    let points = profile.points();
    let mut arc_m = 0.0;
    let mut arcs = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        if let Some(before) = i.checked_sub(1).map(|i| &points[i]) {
            arc_m += libm::hypot(point.y_m - before.y_m, point.z_m - before.z_m);
        }
        arcs.push([point.y_m, arc_m]);
    }
    arcs
}

/// Lateral position at a distance along the surface, m.
fn lateral(samples: &[[f64; 2]], arc_m: f64) -> f64 {
    interpolated(samples, arc_m, [1, 0])
}

/// Linear interpolation of column `to` over the rising column `from`; the nearest end beyond.
#[inline]
fn interpolated(samples: &[[f64; 2]], at: f64, [from, to]: [usize; 2]) -> f64 {
    let i = samples
        .partition_point(|sample| sample[from] <= at)
        .clamp(1, samples.len() - 1);
    let (p, q) = (samples[i - 1], samples[i]);
    let t = ((at - p[from]) / (q[from] - p[from])).clamp(0.0, 1.0);
    p[to] + t * (q[to] - p[to])
}
