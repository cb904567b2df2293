//! Measured profiles: the files of profile gauges and of simulation programs, checked, cut and smoothed.
//!
//! | [`Format`] | files | axes of the file |
//! |---|---|---|
//! | [`Columns`](Format::Columns) | two columns `y_mm`, `z_mm` | `y` to the field side, `z` down |
//! | [`MiniProf`](Format::MiniProf) | `.whl`, `.ban` | wheel: `X` from the flange back to the field side, `Y` down; rail: the same, or both turned round |
//! | [`Simpack`](Format::Simpack) | `.prw`, `.prr` | after the file's own shifts, turns and mirrors: `y` to the field side, `z` down |
//! | [`Gensys`](Format::Gensys) | `.wheel`, `.rail` | `z` down; wheel: `y` to the track centre; rail: must be stated |
//!
//! Points follow one another along the curve, from either end; `y` need not rise. What a wheel or rail cannot touch
//! with is left out, and [`Reading`] counts it: see [`MAX_FOLD_MM`] and [`REACH_MM`].

mod columns;
mod error;
mod format;
mod gensys;
mod miniprof;
mod orientation;
mod reading;
mod row;
mod simpack;
mod touchable;

use std::ffi::OsStr;
use std::path::Path;

pub use error::ProfileError;
pub use format::{Format, UnknownFormat};
pub use reading::{Mirror, Options, Reading, UnknownMirror};

use super::{Body, Profile};
use reading::Laid;

/// Smallest number of points of a usable profile: one each 2 mm over a rail head.
pub const MIN_POINTS: usize = 30;
/// Greatest distance of neighbouring points, mm; over 5 mm a rail corner of R 13 would lose 0.24 mm.
pub const MAX_GAP_MM: f64 = 5.0;
/// Greatest width of a fold or burr that is levelled, mm: some times the noise of a profile gauge. Behind a wider one
/// the shape of the surface is not known.
pub const MAX_FOLD_MM: f64 = 0.3;
/// Farthest that a point is used from the top of a rail or the tip of a flange, mm in depth: the highest flanges have
/// 36 mm, and a chamfer ends 9 mm above the tread.
pub const REACH_MM: f64 = 45.0;
/// Default wavelength whose amplitude the smoothing halves, m: readings rounded to 0.01 mm each
/// 0.5 mm then give positions within 0.005 mm and curvatures within 2 per m RMS.
pub const DEFAULT_SMOOTHING_M: f64 = 0.004;

/// Reads the profile of `body` from the `text` of a file.
///
/// The profile is called as the file, without folder and extension. A wheel's origin is its tread datum.
/// `#` starts a comment in columns and GENSYS files, `!` in SIMPACK files.
///
/// # Errors
/// A text that is not of its format, a number beyond -1000 to 1000, fewer than [`MIN_POINTS`] points, neighbours further
/// apart than [`MAX_GAP_MM`], a fold wider than [`MAX_FOLD_MM`], a profile upside down or mirrored, a GENSYS rail
/// without [`Options::mirror`], a negative smoothing length.
///
/// ```
/// use dashpot_rail::profile::{Body, measured};
/// let mut text = String::from("y_mm,z_mm\n");
/// for y_mm in -36..=36 {
///     let depth_mm = f64::from(y_mm).powi(4) * 2e-5;
///     text += &format!("{y_mm},{depth_mm:.2}\n");
/// }
/// // Under the head: no wheel reaches there.
/// text += "35,36\n34,38\n";
/// let options = measured::Options::default();
/// let (rail, reading) = measured::parse("worn.csv", &text, Body::Rail, &options)?;
/// assert!((rail.at(0.020).z_m - 3.2e-3).abs() < 2e-5);
/// assert_eq!((reading.points, reading.overhanging), (75, 2));
///
/// let error = measured::parse("bad.csv", "0,0\n1,x\n", Body::Rail, &options).unwrap_err();
/// assert_eq!((error.line(), error.column()), (Some(2), Some("z_mm")));
/// # Ok::<(), measured::ProfileError>(())
/// ```
pub fn parse(
    file_name: &str,
    text: &str,
    body: Body,
    options: &Options,
) -> Result<(Profile, Reading), ProfileError> {
    let path = Path::new(file_name);
    let text = text.trim_start_matches('\u{feff}');
    let extension = path.extension().and_then(OsStr::to_str);
    let format = options
        .format
        .unwrap_or_else(|| Format::detect(text, extension));
    let Laid { mut rows, turned } = match format {
        Format::Columns => columns::read(text, options.mirror),
        Format::MiniProf => miniprof::read(text, body, options.mirror),
        Format::Simpack => simpack::read(text, body, options.mirror),
        Format::Gensys => gensys::read(text, body, options.mirror),
    }?;
    if rows.len() < MIN_POINTS {
        return Err(ProfileError::TooFewPoints { found: rows.len() });
    }
    if rows[0].y_mm > rows[rows.len() - 1].y_mm {
        rows.reverse();
    }
    orientation::check(body, &rows)?;
    let part_in_reach = touchable::touchable(body, &rows)?;
    if part_in_reach.points_mm.len() < MIN_POINTS {
        return Err(ProfileError::TooFewPoints {
            found: part_in_reach.points_mm.len(),
        });
    }
    let points_m: Vec<[f64; 2]> = part_in_reach
        .points_mm
        .iter()
        .map(|[y, z]| [y * 1e-3, z * 1e-3])
        .collect();
    let name = path.file_stem().and_then(OsStr::to_str).unwrap_or_default();
    let profile =
        Profile::between_vertical_ends(name, &points_m, options.smoothing_m, MAX_FOLD_MM * 1e-3)?;
    let reading = Reading {
        format,
        turned,
        points: rows.len(),
        overhanging: part_in_reach.overhanging,
        folded: part_in_reach.folded,
        widest_fold_mm: part_in_reach.widest_fold_mm,
    };
    Ok((profile, reading))
}
