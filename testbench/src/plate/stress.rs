//! Stress at the disc surfaces of a bent stack.

use serde::Serialize;

use super::{Bending, Curvature, Stack};

/// Stress per pressure (1) at the surface of a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceStress {
    /// Radial stress.
    pub radial: f64,
    /// Tangential stress.
    pub tangential: f64,
    /// Shear stress.
    pub shear: f64,
}

impl SurfaceStress {
    /// Returns the von Mises equivalent stress.
    pub fn von_mises(&self) -> f64 {
        let (r, t, s) = (self.radial, self.tangential, self.shear);
        (r * r - r * t + t * t + 3.0 * s * s).sqrt()
    }
}

/// Maximum stress of a stack.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LargestStress {
    /// Von Mises equivalent stress per pressure (1).
    pub von_mises_per_pressure: f64,
    /// Radius of the point (m).
    pub radius_m: f64,
    /// Angle of the point from the centre of a boss (rad).
    pub angle_rad: f64,
    /// Numbers of the discs with this stress, counted from 1 in the order of the file.
    pub discs: Vec<usize>,
}

impl Stack {
    /// Returns the stress per pressure at the surface of the most stressed disc.
    ///
    /// The radial stress is `E z/(1 - nu^2) (k_r + nu k_t)`, where z is half the thickness. Sliding discs share the
    /// curvature, so the stress of each is proportional to its own thickness.
    pub fn surface_stress(&self, curvature: Curvature) -> SurfaceStress {
        let nu = self.poisson_ratio;
        let half = 0.5 * self.bent_thickness_m();
        let plane = self.elastic_modulus_pa * half / (1.0 - nu * nu);
        SurfaceStress {
            radial: plane * (curvature.radial + nu * curvature.tangential),
            tangential: plane * (curvature.tangential + nu * curvature.radial),
            shear: plane * (1.0 - nu) * curvature.twist,
        }
    }

    /// Returns the maximum stress over the stack, evaluated at the nodes and midway between them.
    pub fn largest_stress(&self, bending: &Bending) -> LargestStress {
        let nodes: Vec<f64> = bending.radii_m().collect();
        let middles = nodes.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let radii: Vec<f64> = nodes.iter().copied().chain(middles).collect();
        let mut largest = LargestStress {
            von_mises_per_pressure: 0.0,
            radius_m: self.clamp_radius_m(),
            angle_rad: 0.0,
            discs: self.most_stressed_discs(),
        };
        for angle_rad in bending.angles_rad(bending.angle_steps()) {
            for &radius_m in &radii {
                let stress = self.surface_stress(bending.curvature(radius_m, angle_rad));
                let von_mises_per_pressure = stress.von_mises();
                if von_mises_per_pressure > largest.von_mises_per_pressure {
                    largest = LargestStress {
                        von_mises_per_pressure,
                        radius_m,
                        angle_rad,
                        ..largest
                    };
                }
            }
        }
        largest
    }
}
