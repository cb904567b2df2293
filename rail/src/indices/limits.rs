//! Limits of wheel forces.

/// Returns Nadal's limit of `Y/Q`, at which a wheel climbs: `(tan d - mu)/(1 + mu tan d)` with the flange angle `d`
/// (Nadal 1896).
///
/// ```
/// let limit = dashpot_rail::indices::nadal_limit(70_f64.to_radians(), 0.36);
/// assert!((limit - 1.1995).abs() < 1e-3);
/// ```
pub fn nadal_limit(flange_angle_rad: f64, friction: f64) -> f64 {
    let tan = libm::tan(flange_angle_rad);
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

/// Returns the limit of a wheel's load in motion, filtered at 20 Hz, N: `90 kN + Q0` with the load `Q0` at standstill,
/// at most 200 kN up to 160 km/h, 190 kN up to 200 km/h, 180 kN up to 250 km/h, 170 kN up to 300 km/h, 160 kN above
/// (UIC 518 and EN 14363).
///
/// ```
/// use dashpot_rail::indices::wheel_load_limit_n;
/// assert_eq!(wheel_load_limit_n(55e3, 160.0 / 3.6), 145e3);
/// assert_eq!(wheel_load_limit_n(105e3, 180.0 / 3.6), 190e3);
/// ```
pub fn wheel_load_limit_n(static_load_n: f64, speed_m_per_s: f64) -> f64 {
    // A speed that was converted from km/h is slightly off.
    let speed_km_h = 3.6 * speed_m_per_s - 1e-6;
    let most_n = match speed_km_h {
        speed if speed <= 160.0 => 200e3,
        speed if speed <= 200.0 => 190e3,
        speed if speed <= 250.0 => 180e3,
        speed if speed <= 300.0 => 170e3,
        _ => 160e3,
    };
    (90e3 + static_load_n).min(most_n)
}
