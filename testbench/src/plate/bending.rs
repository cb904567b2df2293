//! Deflection and curvature of a stack under pressure.

use std::f64::consts::PI;

use super::harmonic::{Derivatives, Harmonic};
use super::{PlateError, PressureArea, Stack};

/// How finely a plate is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Elements from clamp to edge, at least; each corner of the pressure has a node.
    pub elements: usize,
    /// Harmonics of the number of bosses.
    pub harmonics: u32,
}

impl Default for Resolution {
    /// Lifts within 1e-6 and stresses within 1e-3 of those of a division twice as fine.
    fn default() -> Self {
        Self {
            elements: 96,
            harmonics: 32,
        }
    }
}

/// Curvatures per pressure at a point (1/(m Pa)).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Curvature {
    /// Radial, `w''`.
    pub radial: f64,
    /// Tangential, `w'/r + w_tt/r^2`.
    pub tangential: f64,
    /// Twist, `(w_t/r)'`.
    pub twist: f64,
}

/// A stack bent by pressure; everything in it is per pressure, since thin plates are linear.
#[derive(Clone, Debug)]
pub struct Bending {
    /// Node radii over the free radius.
    nodes: Vec<f64>,
    harmonics: Vec<Harmonic>,
    bosses: u32,
    clamp_radius_m: f64,
    free_radius_m: f64,
    /// r_w^4/D (m/Pa).
    scale: f64,
}

impl Stack {
    /// The stack under pressure on `area`.
    ///
    /// # Errors
    /// An area that does not lie on the stack's free part.
    pub fn bend(&self, area: &PressureArea, resolution: Resolution) -> Result<Bending, PlateError> {
        let harmonics = if area.is_round() {
            0
        } else {
            resolution.harmonics
        };
        self.bend_by(area, resolution.elements, harmonics)
    }

    /// Mean edge lift per pressure on `area` (m/Pa): the harmonic of order zero alone.
    ///
    /// # Errors
    /// As [`Stack::bend`].
    pub fn mean_edge_lift_m_per_pa(
        &self,
        area: &PressureArea,
        resolution: Resolution,
    ) -> Result<f64, PlateError> {
        let bending = self.bend_by(area, resolution.elements, 0)?;
        Ok(bending.mean_edge_lift_m_per_pa())
    }

    /// Correction factor Ce of `area`: mean edge lift over that under uniform pressure.
    ///
    /// # Errors
    /// As [`Stack::bend`].
    pub fn correction_factor(
        &self,
        area: &PressureArea,
        resolution: Resolution,
    ) -> Result<f64, PlateError> {
        let lift = self.mean_edge_lift_m_per_pa(area, resolution)?;
        Ok(lift / self.uniform_edge_lift_m_per_pa())
    }

    fn bend_by(
        &self,
        area: &PressureArea,
        elements: usize,
        harmonics: u32,
    ) -> Result<Bending, PlateError> {
        let (clamp_m, free_m) = (self.clamp_radius_m(), self.free_radius_m());
        area.check(clamp_m, free_m)?;
        let nodes = nodes(
            clamp_m / free_m,
            area.corners_m().map(|r| r / free_m),
            elements,
        );
        let harmonics = (0..=harmonics)
            .map(|k| {
                let order = f64::from(k * area.count());
                Harmonic::solve(&nodes, order, self.poisson_ratio, |q| {
                    area.harmonic(k, q * free_m)
                })
            })
            .collect::<Option<_>>()
            .ok_or(PlateError::Singular { clamp_m, free_m })?;
        Ok(Bending {
            nodes,
            harmonics,
            bosses: area.count(),
            clamp_radius_m: clamp_m,
            free_radius_m: free_m,
            scale: free_m.powi(4) / self.bending_stiffness_n_m(),
        })
    }
}

/// Nodes from `clamp` to 1 with one at each of `corners`, some `elements` in all. Each is in the same ratio to the one before
/// between corners: curvature changes with the logarithm of the radius.
fn nodes(clamp: f64, corners: [f64; 4], elements: usize) -> Vec<f64> {
    let longest = -clamp.ln() / elements.max(1) as f64;
    let mut ends = [clamp, corners[0], corners[1], corners[2], corners[3], 1.0];
    ends.sort_by(f64::total_cmp);
    let mut nodes = vec![clamp];
    let mut start = clamp;
    for end in ends {
        // Shorter than this is rounding: no element is between.
        if end - start > 1e-9 {
            let end = end.min(1.0);
            let ratio = (end / start).ln();
            let parts = (ratio / longest - 1e-6).ceil().max(1.0) as u32;
            let between =
                (1..parts).map(|i| start * (ratio * f64::from(i) / f64::from(parts)).exp());
            nodes.extend(between);
            nodes.push(end);
            start = end;
        }
    }
    nodes
}

impl Bending {
    /// Radii of the nodes (m).
    pub fn radii_m(&self) -> impl Iterator<Item = f64> {
        self.nodes.iter().map(|q| q * self.free_radius_m)
    }

    /// Half the angle from boss to boss (rad): the plate repeats itself mirrored beyond.
    pub fn half_pitch_rad(&self) -> f64 {
        PI / f64::from(self.bosses)
    }

    /// Whether the deflection is the same all round.
    pub fn is_round(&self) -> bool {
        self.harmonics.len() == 1
    }

    /// Deflection per pressure at a radius (m), held within the plate, and an angle from a boss's middle (m/Pa).
    pub fn deflection_m_per_pa(&self, radius_m: f64, angle_rad: f64) -> f64 {
        let (element, q) = self.place(radius_m);
        let sum: f64 = self
            .at(element, q)
            .map(|(order, at)| at.value * (order * angle_rad).cos())
            .sum();
        self.scale * sum
    }

    /// Curvatures per pressure, as [`Bending::deflection_m_per_pa`].
    pub fn curvature(&self, radius_m: f64, angle_rad: f64) -> Curvature {
        let (element, q) = self.place(radius_m);
        let mut sum = Curvature::default();
        for (m, at) in self.at(element, q) {
            let (sine, cosine) = (m * angle_rad).sin_cos();
            sum.radial += at.second * cosine;
            sum.tangential += (at.first / q - m * m * at.value / (q * q)) * cosine;
            sum.twist -= m * (at.first / q - at.value / (q * q)) * sine;
        }
        let scale = self.scale / (self.free_radius_m * self.free_radius_m);
        Curvature {
            radial: scale * sum.radial,
            tangential: scale * sum.tangential,
            twist: scale * sum.twist,
        }
    }

    /// Edge lift per pressure, mean over the circumference (m/Pa): what the flow through the edge follows.
    pub fn mean_edge_lift_m_per_pa(&self) -> f64 {
        self.scale * self.harmonics.first().map_or(0.0, Harmonic::at_edge)
    }

    /// Least and greatest edge lift per pressure over the circumference (m/Pa).
    pub fn edge_lift_range_m_per_pa(&self) -> [f64; 2] {
        let lifts = self.angles_rad(self.angle_steps()).map(|angle| {
            let orders = self.harmonics.iter();
            let sum: f64 = orders
                .map(|harmonic| harmonic.at_edge() * (harmonic.order * angle).cos())
                .sum();
            self.scale * sum
        });
        lifts.fold([f64::MAX, f64::MIN], |[least, greatest], lift| {
            [least.min(lift), greatest.max(lift)]
        })
    }

    /// Angles (rad) from a boss's middle to halfway to the next in so many steps; the middle alone where all are equal.
    pub fn angles_rad(&self, steps: u32) -> impl Iterator<Item = f64> + use<> {
        let half = self.half_pitch_rad();
        let steps = if self.is_round() { 0 } else { steps };
        (0..=steps).map(move |i| half * f64::from(i) / f64::from(steps.max(1)))
    }

    /// Steps that the highest harmonic takes four of in half a wave.
    pub(super) fn angle_steps(&self) -> u32 {
        4 * self.harmonics.len() as u32
    }

    fn at(&self, element: usize, q: f64) -> impl Iterator<Item = (f64, Derivatives)> {
        let harmonics = self.harmonics.iter();
        harmonics.map(move |harmonic| (harmonic.order, harmonic.at(&self.nodes, element, q)))
    }

    /// The element that has a radius, and the radius over the free one.
    fn place(&self, radius_m: f64) -> (usize, f64) {
        let clamp = self.clamp_radius_m / self.free_radius_m;
        let q = (radius_m / self.free_radius_m).clamp(clamp, 1.0);
        let after = self.nodes.partition_point(|node| *node <= q);
        (after.clamp(1, self.nodes.len() - 1) - 1, q)
    }
}
