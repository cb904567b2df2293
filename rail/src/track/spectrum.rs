//! Published spectra of track irregularities.

use super::error::TrackError;

/// One-sided power spectral density of one channel as a function of the wave number `W` in rad/m.
///
/// `S(W) = g W^2 / ((W^2 + p1^2) (W^2 + p2^2) (W^2 + p3^2))`. Its integral over a band is the mean square in the band.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Density {
    /// `g`, rad^3/m.
    pub gain_rad3_per_m: f64,
    /// `p1` to `p3`, rad/m; zero for factors that the published formula does not have.
    pub corners_rad_per_m: [f64; 3],
}

impl Density {
    /// Returns the density with the gain `g` and the corners `p1` to `p3`.
    pub const fn new(gain_rad3_per_m: f64, corners_rad_per_m: [f64; 3]) -> Self {
        Self {
            gain_rad3_per_m,
            corners_rad_per_m,
        }
    }

    /// Returns `S` at a wave number in rad/m, in `m^2/(rad/m)`.
    pub fn at(&self, wave_number_rad_per_m: f64) -> f64 {
        let square = wave_number_rad_per_m * wave_number_rad_per_m;
        let factors = self
            .corners_rad_per_m
            .map(|corner| square + corner * corner);
        self.gain_rad3_per_m * square / (factors[0] * factors[1] * factors[2])
    }
}

/// Densities of the four channels.
///
/// American spectra in their simplified form (Garg and Dukkipati 1984), with `k = 0.25` and `Wc`, `Ws` in rad/m:
///
/// - vertical `k Av Wc^2 / (W^2 (W^2 + Wc^2))`, lateral the same with `Aa`;
/// - cross level and gauge `4 k Av Wc^2 / ((W^2 + Wc^2) (W^2 + Ws^2))`.
///
/// German spectra (as given by Claus and Schiehlen 1998), with half the distance between the rails `b = 0.75 m`:
///
/// - vertical `Av Wc^2 / ((W^2 + Wr^2) (W^2 + Wc^2))`, lateral the same with `Aa`;
/// - gauge `Ag Wc^2 W^2 / ((W^2 + Wr^2) (W^2 + Wc^2) (W^2 + Ws^2))`;
/// - cross level the same with `Av`, times `(2 b)^2 / b^2 = 4`, because the published density is that of the angle,
///   which is the cross level divided by `2 b`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Spectrum {
    /// Vertical profile.
    pub vertical: Density,
    /// Alignment.
    pub lateral: Density,
    /// Cross level.
    pub cross_level: Density,
    /// Gauge.
    pub gauge: Density,
}

/// Parameters of a class of American track.
struct FraClass {
    /// Roughness constant `Av` of the vertical profile, cm^2 rad/m.
    vertical: f64,
    /// Roughness constant `Aa` of the alignment, cm^2 rad/m.
    lateral: f64,
    /// Corner wave number `Ws`, rad/m.
    corner: f64,
}

impl FraClass {
    const fn new(vertical: f64, lateral: f64, corner: f64) -> Self {
        Self {
            vertical,
            lateral,
            corner,
        }
    }
}

/// Classes 1 to 6. `Aa` and `Ws` of the classes 1 to 4 could not be verified against the publication.
const FRA: [FraClass; 6] = [
    FraClass::new(1.2107, 3.3634, 0.6046),
    FraClass::new(1.0181, 1.2107, 0.9308),
    FraClass::new(0.6816, 0.4128, 0.8520),
    FraClass::new(0.5376, 0.3027, 1.1312),
    FraClass::new(0.2095, 0.0762, 0.8209),
    FraClass::new(0.0339, 0.0339, 0.4380),
];
/// Corner wave number `Wc` of the American spectra, rad/m.
const FRA_CORNER: f64 = 0.8245;
/// Factor `k` of the American spectra.
const FRA_FACTOR: f64 = 0.25;
/// Corner wave numbers `Wr`, `Wc` and `Ws` of the German spectra, rad/m.
const GERMAN_CORNERS: [f64; 3] = [0.0206, 0.8246, 0.4380];

impl Spectrum {
    /// Returns the spectrum with these densities.
    pub const fn new(
        vertical: Density,
        lateral: Density,
        cross_level: Density,
        gauge: Density,
    ) -> Self {
        Self {
            vertical,
            lateral,
            cross_level,
            gauge,
        }
    }

    /// Returns the spectrum of American track of a class from 1 (worst) to 6 (best).
    ///
    /// # Errors
    /// Any other class.
    pub fn fra(class: u8) -> Result<Self, TrackError> {
        let index = usize::from(class).wrapping_sub(1);
        let &FraClass {
            vertical,
            lateral,
            corner,
        } = FRA.get(index).ok_or(TrackError::Class { class })?;
        let gain = |roughness_cm2| FRA_FACTOR * roughness_cm2 * 1e-4 * FRA_CORNER * FRA_CORNER;
        let mean = |roughness_cm2| Density {
            gain_rad3_per_m: gain(roughness_cm2),
            corners_rad_per_m: [0.0, 0.0, FRA_CORNER],
        };
        let difference = Density {
            gain_rad3_per_m: 4.0 * gain(vertical),
            corners_rad_per_m: [0.0, FRA_CORNER, corner],
        };
        Ok(Self {
            vertical: mean(vertical),
            lateral: mean(lateral),
            cross_level: difference,
            gauge: difference,
        })
    }

    /// Returns the spectrum of German track with low disturbance.
    pub fn german_low() -> Self {
        Self::german(4.032e-7, 2.119e-7, 5.32e-8)
    }

    /// Returns the spectrum of German track with high disturbance.
    pub fn german_high() -> Self {
        Self::german(1.08e-6, 6.125e-7, 1.032e-7)
    }

    /// German spectrum with the roughness constants `Av`, `Aa` and `Ag` in m^2 rad/m.
    fn german(vertical: f64, lateral: f64, gauge: f64) -> Self {
        let [wr, wc, ws] = GERMAN_CORNERS;
        let density = |roughness: f64, corners_rad_per_m| Density {
            gain_rad3_per_m: roughness * wc * wc,
            corners_rad_per_m,
        };
        Self {
            vertical: density(vertical, [0.0, wr, wc]),
            lateral: density(lateral, [0.0, wr, wc]),
            cross_level: density(4.0 * vertical, [wr, wc, ws]),
            gauge: density(gauge, [wr, wc, ws]),
        }
    }

    /// Densities in the order vertical, lateral, cross level, gauge.
    pub(super) fn densities(&self) -> [&Density; 4] {
        [
            &self.vertical,
            &self.lateral,
            &self.cross_level,
            &self.gauge,
        ]
    }
}
