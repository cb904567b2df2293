//! Friction that differs between the rails or along the track.

use super::ContactOptions;
use super::error::ContactError;

/// Bounds of a friction coefficient.
const FRICTION: [f64; 2] = [0.0, 2.0];

/// Returns the friction coefficients along the track, `[distance, left, right]`, and checks them. `friction` is the
/// coefficient of the case. Empty if both rails have it everywhere; one point if only the rails differ.
pub(super) fn friction_over_distance(
    options: &ContactOptions,
    friction: f64,
) -> Result<Vec<[f64; 3]>, ContactError> {
    let sides = [
        ("left_friction", options.left_friction),
        ("right_friction", options.right_friction),
    ];
    for (key, value) in sides {
        if let Some(value) = value {
            check_friction(key, value)?;
            if options.friction_over_distance.is_some() {
                let reason = "given with friction_over_distance, allowed: one of the two";
                return Err(ContactError::other(key, reason));
            }
        }
    }
    let [left, right] = sides.map(|(_, value)| value);
    let points = match &options.friction_over_distance {
        Some(points) => points.clone(),
        None if left.is_some() || right.is_some() => {
            vec![[0.0, left.unwrap_or(friction), right.unwrap_or(friction)]]
        }
        None => Vec::new(),
    };
    let key = "friction_over_distance";
    for [_, left, right] in &points {
        check_friction(key, *left)?;
        check_friction(key, *right)?;
    }
    if !points.is_empty() && friction <= 0.0 {
        let key = sides
            .iter()
            .find(|(_, value)| value.is_some())
            .map_or(key, |(key, _)| key);
        let reason = format!(
            "the friction of the case is {friction}, allowed: above 0, because friction on a rail is relative to it"
        );
        return Err(ContactError::other(key, reason));
    }
    Ok(points)
}

fn check_friction(key: &'static str, value: f64) -> Result<(), ContactError> {
    let [min, max] = FRICTION;
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(ContactError::other(
        key,
        format!("{value}, allowed: {min} to {max}"),
    ))
}
