//! Limits of wheel forces.

/// Returns Nadal's limit of `Y/Q`, at which a wheel climbs: `(tan d - mu)/(1 + mu tan d)` with the flange angle `d`
/// (Nadal 1896).
///
/// ```
/// let limit = dashpot_rail::indices::nadal_limit(70_f64.to_radians(), 0.36);
/// assert!((limit - 1.1995).abs() < 1e-3);
/// ```
pub fn nadal_limit(flange_angle_rad: f64, friction: f64) -> f64 {
    let tan = flange_angle_rad.tan();
    (tan - friction) / (1.0 + friction * tan)
}

/// Returns the limit of the lateral force of a wheelset on the track, averaged over 2 m, N: `10 kN + P/3` with the axle
/// load `P` (Prud'homme 1967). For track of poor quality use 0.85 times this value.
///
/// ```
/// assert_eq!(dashpot_rail::indices::prudhomme_limit_n(201e3), 77e3);
/// ```
pub fn prudhomme_limit_n(axle_load_n: f64) -> f64 {
    10e3 + axle_load_n / 3.0
}

/// Returns the wheel unloading `(Q0 - Q)/Q0` for the load `Q` and the load at standstill `Q0`, N: 1 for a lifted wheel,
/// negative for a wheel that carries more than at standstill.
///
/// ```
/// assert_eq!(dashpot_rail::indices::wheel_unloading(100e3, 40e3), 0.6);
/// ```
pub fn wheel_unloading(static_load_n: f64, load_n: f64) -> f64 {
    (static_load_n - load_n) / static_load_n
}
