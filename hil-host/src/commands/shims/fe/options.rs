//! Options of `dashpot shims --fe`.

use crate::commands::failure::{Failure, Outcome};
use dashpot_testbench::plate::{Bosses, PressureArea, Profile, RoundBosses, Stack, Stacking};
use dashpot_testbench::shim_valves::{VALVE_LOCATIONS, ValveLocation};

/// Largest pressure and stress that is asked for (Pa).
const LARGEST_PA: f64 = 1e12;

/// A valve by its name on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum ValveName {
    /// Piston valve that works in extension.
    PistonExtension,
    /// Piston valve that works in compression.
    PistonCompression,
    /// Foot valve that works in compression.
    FootCompression,
}

impl ValveName {
    /// Where the valve is.
    pub(super) fn location(self) -> &'static ValveLocation {
        &VALVE_LOCATIONS[match self {
            Self::PistonExtension => 0,
            Self::PistonCompression => 1,
            Self::FootCompression => 2,
        }]
    }
}

/// The shims as plates.
#[derive(Debug, Clone, Default, clap::Args)]
#[command(next_help_heading = "Shims as plates (--fe)")]
pub struct PlateArguments {
    /// Solve the stacks as thin plates under pressure that need not be uniform: correction factor Ce, deflection, largest stress.
    #[arg(long)]
    pub fe: bool,
    /// The discs are one instead of sliding on each other.
    #[arg(long, requires = "fe")]
    pub bonded: bool,
    /// Pressures to tell lift and stress at, Pa, besides that of the damper's force limit; those of the published tables unless
    /// given.
    #[arg(long, value_name = "PA,..", requires = "fe", value_delimiter = ',', value_parser = positive, allow_negative_numbers = true)]
    pub pressure_pa: Vec<f64>,
    /// Stress the shims may have, Pa: the pressure at which it is reached is told.
    #[arg(long, value_name = "PA", requires = "fe", value_parser = positive, allow_negative_numbers = true)]
    pub allowable_stress_pa: Option<f64>,
    /// The valve that the options below describe the pressure area of; without them it is of an assumed kind, fitted to Ce.
    #[arg(long, requires = "fe", value_enum)]
    pub valve: Option<ValveName>,
    /// Radii between which the pressure is full, m [default: clamp and edge].
    #[arg(long, value_name = "FROM,TO", requires = "valve", value_parser = two_radii, allow_negative_numbers = true)]
    pub loaded_radii_m: Option<[f64; 2]>,
    /// Radii at which it has decayed to nothing, m.
    #[arg(long, value_name = "FROM,TO", requires = "loaded_radii_m", value_parser = two_radii, allow_negative_numbers = true)]
    pub decay_radii_m: Option<[f64; 2]>,
    /// Exponent of the decay: 1 linear, 2 quadratic [default: 2].
    #[arg(
        long,
        value_name = "N",
        requires = "valve",
        allow_negative_numbers = true
    )]
    pub decay_exponent: Option<f64>,
    /// Number of bosses over the circumference, which the pressure is on alone.
    #[arg(
        long,
        value_name = "N",
        requires = "valve",
        allow_negative_numbers = true
    )]
    pub bosses: Option<u32>,
    /// Bosses are sectors that take this share of the circumference.
    #[arg(
        long,
        value_name = "SHARE",
        requires = "bosses",
        conflicts_with = "boss_radius_m",
        allow_negative_numbers = true
    )]
    pub boss_share: Option<f64>,
    /// Bosses are round, of this radius, m; the pressure decays from the hole to it.
    #[arg(long, value_name = "M", requires_all = ["bosses", "pitch_radius_m"], conflicts_with = "loaded_radii_m", allow_negative_numbers = true)]
    pub boss_radius_m: Option<f64>,
    /// Radius of a round boss's hole, where the pressure is full, m [default: the boss radius].
    #[arg(
        long,
        value_name = "M",
        requires = "boss_radius_m",
        allow_negative_numbers = true
    )]
    pub hole_radius_m: Option<f64>,
    /// Radius of the circle on which round bosses have their middles, m.
    #[arg(
        long,
        value_name = "M",
        requires = "boss_radius_m",
        allow_negative_numbers = true
    )]
    pub pitch_radius_m: Option<f64>,
}

impl PlateArguments {
    /// How the discs are stacked.
    pub(super) fn stacking(&self) -> Stacking {
        if self.bonded {
            Stacking::Bonded
        } else {
            Stacking::Sliding
        }
    }

    /// The pressure area that the options describe on a stack, if they do.
    ///
    /// # Errors
    /// Options that are no area together.
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
                    "--bosses goes with --boss-share, or with --boss-radius-m and --pitch-radius-m",
                ));
            }
        };
        area.check(clamp, free)?;
        Ok(Some(area))
    }

    fn no_area(&self) -> Outcome<Option<PressureArea>> {
        if self.decay_exponent.is_some() {
            return Err(Failure::wrong_use(
                "--decay-exponent goes with --loaded-radii-m or --bosses",
            ));
        }
        Ok(None)
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(value) if 0.0 < value && value <= LARGEST_PA => Ok(value),
        _ => Err(format!("allowed: above 0 and at most {LARGEST_PA:e} Pa")),
    }
}

fn two_radii(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|x| x.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[from, to]) => Ok([from, to]),
        _ => Err("allowed: two radii in m with a comma between, such as 0.019,0.026".into()),
    }
}
