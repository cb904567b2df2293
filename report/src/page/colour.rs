//! Colours of curves on light and dark screens.

use std::fmt;

use plotters::style::RGBColor;

/// Red, green and blue, each from 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Colour([u8; 3]);

impl From<RGBColor> for Colour {
    fn from(RGBColor(red, green, blue): RGBColor) -> Self {
        Self([red, green, blue])
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [red, green, blue] = self.0;
        write!(formatter, "#{red:02x}{green:02x}{blue:02x}")
    }
}

impl Colour {
    /// Returns the same hue with inverted lightness, so that the contrast on black equals that on white.
    pub(super) fn on_dark(self) -> Self {
        let parts = self.0.map(|part| f64::from(part) / 255.0);
        let max = parts.into_iter().fold(0.0, f64::max);
        let min = parts.into_iter().fold(1.0, f64::min);
        // In HSL, the lightness is the mean of the largest and the smallest component, and the chroma is their
        // difference. The lightness limits the chroma.
        let lightness = 0.5 * (max + min);
        let inverted = 0.95 - 0.72 * lightness;
        let max_chroma = |lightness: f64| 1.0 - (2.0 * lightness - 1.0).abs();
        let chroma_factor = 0.9 * max_chroma(inverted) / max_chroma(lightness).max(1e-9);
        Self(parts.map(|part| {
            let part = inverted + chroma_factor * (part - lightness);
            (255.0 * part.clamp(0.0, 1.0)).round() as u8
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(Colour(parts): Colour) -> u8 {
        let [max, min] = [parts.iter().max(), parts.iter().min()];
        max.copied().unwrap_or(0) / 2 + min.copied().unwrap_or(0) / 2
    }

    #[test]
    fn on_dark_inverts_lightness_and_keeps_the_order_of_the_parts() {
        let (blue, grey) = (Colour([21, 101, 192]), Colour([160, 168, 176]));
        let (bright, dim) = (blue.on_dark(), grey.on_dark());
        assert!(lightness(blue) < lightness(grey) && lightness(bright) > lightness(dim));
        for Colour([red, green, blue]) in [bright, dim] {
            assert!(red < green && green < blue);
        }
    }

    #[test]
    fn on_dark_swaps_black_and_white() {
        let [black, white] = [[0; 3], [255; 3]].map(|parts| Colour(parts).on_dark());
        for Colour([red, green, blue]) in [black, white] {
            assert!(red == green && green == blue);
        }
        assert!(lightness(black) > 200 && lightness(white) < 70);
    }
}
