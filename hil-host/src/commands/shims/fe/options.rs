//! Options of `dashpot shims --fe`.

use crate::commands::failure::{Failure, Outcome};
use dashpot_testbench::plate::{Bosses, PressureArea, Profile, RoundBosses, Stack, Stacking};
use dashpot_testbench::shim_valves::{VALVE_LOCATIONS, ValveLocation};

/// Largest accepted pressure and stress (Pa).
const MAX_PA: f64 = 1e12;

/// Name of a valve on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum ValveName {
    /// Piston valve, extension.
    PistonExtension,
    /// Piston valve, compression.
    PistonCompression,
    /// Foot valve, compression.
    FootCompression,
}

impl ValveName {
    /// Returns the location of the valve.
    pub(super) fn location(self) -> &'static ValveLocation {
        &VALVE_LOCATIONS[match self {
            Self::PistonExtension => 0,
            Self::PistonCompression => 1,
            Self::FootCompression => 2,
        }]
    }
}

/// Options of the plate analysis.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct PlateArguments {
    /// Solve the stacks as thin plates, also under non-uniform pressure: correction factor Ce, deflection, maximum
    /// stress.
    #[arg(long)]
    pub fe: bool,
    /// Assume bonded discs instead of discs that slide on each other.
    #[arg(long, requires = "fe")]
    pub bonded: bool,
    /// Pressures for lift and stress, Pa; the pressure at the damper's force limit is always added [default: those of
    /// the published tables].
    #[arg(
        long,
        value_name = "PA,..",
        requires = "fe",
        value_delimiter = ',',
        value_parser = positive,
        allow_negative_numbers = true
    )]
    pub pressure_pa: Vec<f64>,
    /// Allowable stress of the shims, Pa; the pressure at which it is reached is printed.
    #[arg(long, value_name = "PA", requires = "fe", value_parser = positive, allow_negative_numbers = true)]
    pub allowable_stress_pa: Option<f64>,
    /// Valve whose pressure area the following options describe [default: areas of an assumed kind, fitted to Ce].
    #[arg(long, requires = "fe", value_enum)]
    pub valve: Option<ValveName>,
    /// Inner and outer radius of the area under full pressure, m [default: clamp and edge].
    #[arg(
        long,
        value_name = "FROM,TO",
        requires = "valve",
        value_parser = two_radii,
        allow_negative_numbers = true
    )]
    pub loaded_radii_m: Option<[f64; 2]>,
    /// Inner and outer radius at which the pressure has decayed to zero, m.
    #[arg(
        long,
        value_name = "FROM,TO",
        requires = "loaded_radii_m",
        value_parser = two_radii,
        allow_negative_numbers = true
    )]
    pub decay_radii_m: Option<[f64; 2]>,
    /// Exponent of the decay: 1 linear, 2 quadratic [default: 2].
    #[arg(
        long,
        value_name = "N",
        requires = "valve",
        allow_negative_numbers = true
    )]
    pub decay_exponent: Option<f64>,
    /// Number of bosses around the circumference; pressure acts only on bosses.
    #[arg(
        long,
        value_name = "N",
        requires = "valve",
        allow_negative_numbers = true
    )]
    pub bosses: Option<u32>,
    /// Share of the circumference covered by sector bosses.
    #[arg(
        long,
        value_name = "SHARE",
        requires = "bosses",
        conflicts_with = "boss_radius_m",
        allow_negative_numbers = true
    )]
    pub boss_share: Option<f64>,
    /// Radius of round bosses, m; the pressure decays from the hole to this radius.
    #[arg(
        long,
        value_name = "M",
        requires_all = ["bosses", "pitch_radius_m"],
        conflicts_with = "loaded_radii_m",
        allow_negative_numbers = true
    )]
    pub boss_radius_m: Option<f64>,
    /// Radius of the hole in a round boss, up to which the pressure is full, m [default: the boss radius].
    #[arg(
        long,
        value_name = "M",
        requires = "boss_radius_m",
        allow_negative_numbers = true
    )]
    pub hole_radius_m: Option<f64>,
    /// Radius of the circle through the centres of round bosses, m.
    #[arg(
        long,
        value_name = "M",
        requires = "boss_radius_m",
        allow_negative_numbers = true
    )]
    pub pitch_radius_m: Option<f64>,
}

impl PlateArguments {
    /// Returns the stacking of the discs.
    pub(super) fn stacking(&self) -> Stacking {
        if self.bonded {
            Stacking::Bonded
        } else {
            Stacking::Sliding
        }
    }

    /// Returns the pressure area described by the options; `None` if they describe none.
    ///
    /// # Errors
    /// The options do not form a valid area.
    pub(super) fn area(&self, stack: &Stack) -> Outcome<Option<PressureArea>> {
        let (clamp, free) = (stack.clamp_radius_m(), stack.free_radius_m());
        let exponent = self.decay_exponent.unwrap_or(2.0);
        let full_m = self.loaded_radii_m.unwrap_or([clamp, free]);
        let profile = Profile {
            full_m,
            ends_m: self.decay_radii_m.unwrap_or(full_m),
            exponent,
        };
        let area = match (self.bosses, self.boss_share, self.boss_radius_m) {
            (None, ..) if self.loaded_radii_m.is_some() => PressureArea::Ring(profile),
            (None, ..) => return self.no_area(),
            (Some(count), Some(share), _) => PressureArea::Sectors(Bosses {
                count,
                share,
                profile,
            }),
            (Some(count), None, Some(boss_radius_m)) => PressureArea::Round(RoundBosses {
                count,
                pitch_radius_m: self.pitch_radius_m.unwrap_or(0.0),
                hole_radius_m: self.hole_radius_m.unwrap_or(boss_radius_m),
                boss_radius_m,
                exponent,
            }),
            (Some(_), None, None) => {
                return Err(Failure::wrong_use(
                    "--bosses requires --boss-share, or --boss-radius-m and --pitch-radius-m",
                ));
            }
        };
        area.check(clamp, free)?;
        Ok(Some(area))
    }

    fn no_area(&self) -> Outcome<Option<PressureArea>> {
        if self.decay_exponent.is_some() {
            return Err(Failure::wrong_use(
                "--decay-exponent requires --loaded-radii-m or --bosses",
            ));
        }
        Ok(None)
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(value) if 0.0 < value && value <= MAX_PA => Ok(value),
        _ => Err(format!("allowed: above 0 and at most {MAX_PA:e} Pa")),
    }
}

fn two_radii(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|x| x.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[from, to]) => Ok([from, to]),
        _ => Err("allowed: two radii in m separated by a comma, such as 0.019,0.026".into()),
    }
}
