//! Measured profiles: reads the files of profile gauges and simulation programs, checks, trims and smooths them.
//!
//! - [`Columns`](Format::Columns): two columns `y_mm`, `z_mm`, with `y` to the field side and `z` down.
//! - [`MiniProf`](Format::MiniProf): `.whl`, `.ban`. A wheel has `X` from the back of the flange to the field side and
//!   `Y` down; a rail has the same axes or both reversed.
//! - [`Simpack`](Format::Simpack): `.prw`, `.prr`. After the file's own shifts, rotations and mirrors, `y` points to
//!   the field side and `z` down.
//! - [`Gensys`](Format::Gensys): `.wheel`, `.rail`. `z` points down. A wheel has `y` to the track centre; for a rail
//!   the side must be stated.
//!
//! Points are in order along the curve, from either end; `y` need not rise. Points that cannot be in contact are
//! removed, and [`Reading`] counts them; see [`MAX_FOLD_MM`] and [`REACH_MM`].

mod columns;
mod error;
mod format;
mod gensys;
mod miniprof;
mod mirror;
mod order;
mod orientation;
mod reading;
mod row;
mod simpack;
mod touchable;

use std::ffi::OsStr;
use std::path::Path;

pub use error::ProfileError;
pub use format::{Format, UnknownFormat};
pub use mirror::{Mirror, UnknownMirror};
pub use reading::{Options, Reading};

use super::{Body, Profile};
use mirror::OrientedRows;

/// Minimum number of points of a profile: one every 2 mm over a rail head.
pub const MIN_POINTS: usize = 30;
/// Maximum distance between neighbouring points, mm. A chord of 5 mm cuts 0.24 mm off a rail corner of R 13.
pub const MAX_GAP_MM: f64 = 5.0;
/// Allowed widths of a profile, mm: from a strip of a rail head to a wheel with its rim.
pub const WIDTHS_MM: [f64; 2] = [10.0, 1000.0];
/// Maximum width of a fold or burr that is removed, mm: several times the noise of a profile gauge. Behind a wider fold
/// the shape of the surface is unknown.
pub const MAX_FOLD_MM: f64 = 0.3;
/// Maximum vertical distance of a point from the top of a rail or the tip of a flange, mm. From the tip of the highest
/// flanges, the tread is 36 mm away and the end of a chamfer 9 mm further.
pub const REACH_MM: f64 = 45.0;
/// Default wavelength whose amplitude the smoothing halves, m. From readings every 0.5 mm, rounded to 0.01 mm, it gives
/// positions within 0.005 mm and curvatures within 2 per m RMS.
pub const DEFAULT_SMOOTHING_M: f64 = 0.004;

/// Reads the profile of `body` from the `text` of a file.
///
/// The profile gets the name of the file, without folder and extension. The origin of a wheel is its tread datum. `#`
/// starts a comment in files of columns and of GENSYS, `!` or `%` in files of SIMPACK.
///
/// # Errors
/// The text does not have its format; a number is not within -1000 to 1000; there are fewer than [`MIN_POINTS`] points;
/// the profile is not within [`WIDTHS_MM`] wide, as if its lengths were in another unit; neighbours are more than
/// [`MAX_GAP_MM`] apart; points are out of order; a fold is wider than [`MAX_FOLD_MM`]; the profile is upside down or
/// mirrored; a GENSYS rail has no [`Options::mirror`]; the smoothing length is negative.
///
/// ```
/// use dashpot_rail::profile::{Body, measured};
/// let mut text = String::from("y_mm,z_mm\n");
/// for y_mm in -36..=36 {
///     let depth_mm = f64::from(y_mm).powi(4) * 2e-5;
///     text += &format!("{y_mm},{depth_mm:.2}\n");
/// }
/// // Below the head, where no wheel reaches.
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
    let OrientedRows { mut rows, turned } = match format {
        Format::Columns => columns::read(text, options.mirror),
        Format::MiniProf => miniprof::read(text, body, options.mirror),
        Format::Simpack => simpack::read(text, body, options.mirror),
        Format::Gensys => gensys::read(text, body, options.mirror),
    }?;
    if rows.len() < MIN_POINTS {
        return Err(ProfileError::TooFewPoints { found: rows.len() });
    }
    let width_mm = order::width_mm(&rows);
    if !(WIDTHS_MM[0]..=WIDTHS_MM[1]).contains(&width_mm) {
        return Err(ProfileError::Unit {
            width_mm,
            allowed_mm: WIDTHS_MM,
        });
    }
    let is_reversed = rows[0].y_mm > rows[rows.len() - 1].y_mm;
    if is_reversed {
        rows.reverse();
    }
    let part_in_reach = orientation::check(body, &rows)
        .and_then(|()| touchable::touchable(body, &rows))
        .map_err(|error| {
            // Points without order violate other checks too.
            if is_reversed {
                rows.reverse();
            }
            order::jump(&rows).unwrap_or(error)
        })?;
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
