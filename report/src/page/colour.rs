//! A curve's colour on white, and what takes its place on a dark screen.

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
    /// The same hue with its lightness turned over: what stands out on white stands out on black.
    pub(super) fn on_dark(self) -> Self {
        let parts = self.0.map(|part| f64::from(part) / 255.0);
        let most = parts.into_iter().fold(0.0, f64::max);
        let least = parts.into_iter().fold(1.0, f64::min);
        // Lightness is the mean of the most and the least part, chroma their difference; it is at most what the
        // lightness leaves room for.
        let lightness = 0.5 * (most + least);
        let turned = 0.95 - 0.72 * lightness;
        let room = |lightness: f64| 1.0 - (2.0 * lightness - 1.0).abs();
        let stretch = 0.9 * room(turned) / room(lightness).max(1e-9);
        Self(parts.map(|part| {
            let part = turned + stretch * (part - lightness);
            (255.0 * part.clamp(0.0, 1.0)).round() as u8
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(Colour(parts): Colour) -> u8 {
        let [most, least] = [parts.iter().max(), parts.iter().min()];
        most.copied().unwrap_or(0) / 2 + least.copied().unwrap_or(0) / 2
    }

    #[test]
    fn a_dark_screen_turns_lightness_over_and_keeps_the_order_of_the_parts() {
        let (blue, grey) = (Colour([21, 101, 192]), Colour([160, 168, 176]));
        let (bright, dim) = (blue.on_dark(), grey.on_dark());
        assert!(lightness(blue) < lightness(grey) && lightness(bright) > lightness(dim));
        for Colour([red, green, blue]) in [bright, dim] {
            assert!(red < green && green < blue);
        }
    }

    #[test]
    fn black_and_white_stay_grey_and_change_places() {
        let [black, white] = [[0; 3], [255; 3]].map(|parts| Colour(parts).on_dark());
        for Colour([red, green, blue]) in [black, white] {
            assert!(red == green && green == blue);
        }
        assert!(lightness(black) > 200 && lightness(white) < 70);
    }
}
