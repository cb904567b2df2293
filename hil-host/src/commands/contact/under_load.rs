//! Text report on a wheelset under load: forces on wheels, and patches.

use std::io::{self, Write};

use dashpot_study::loaded_wheelset::{LoadedShift, Running};

use super::load::shortest;

/// Prints the wheels and patches at each shift.
pub(super) fn print(
    out: &mut dyn Write,
    running: &Running,
    shifts: &[LoadedShift],
) -> io::Result<()> {
    let [load_kn, speed_km_h, yaw_mrad] = [
        running.load_n * 1e-3,
        running.speed_m_per_s * 3.6,
        running.yaw_rad * 1e3,
    ]
    .map(shortest);
    writeln!(
        out,
        "\nwheelset under load: {load_kn} kN per wheel, {speed_km_h} km/h, yaw {yaw_mrad} mrad, friction {}, neither \
         driven nor braked",
        running.friction
    )?;
    writeln!(
        out,
        "(Y: lateral force of the wheel on the rail, positive to the field side; X: force of the rail on the wheel, \
         forward)\n  \
         shift mm   wheel     Q kN     Y kN     Y/Q     X kN  rolling radius mm"
    )?;
    for shift in shifts {
        let at_mm = shift.lateral_shift_m * 1e3;
        if shift.right.is_none() {
            writeln!(out, "  {at_mm:8.2}   no equilibrium under this load")?;
        }
        for (side, wheel) in shift.wheels() {
            writeln!(
                out,
                "  {at_mm:8.2}   {}  {:7.2}  {:7.2}  {:6.3}  {:7.2}  {:17.3}",
                name(side),
                wheel.vertical_force_n * 1e-3,
                unsigned_zero(wheel.lateral_force_n * 1e-3, 2),
                unsigned_zero(wheel.derailment_coefficient, 3),
                unsigned_zero(wheel.longitudinal_force_n * 1e-3, 2),
                wheel.rolling_radius_m * 1e3,
            )?;
        }
    }
    writeln!(
        out,
        "\npatches (y: on the wheel from the tread datum; xi, eta, spin: creepages along, across and about the normal; \
         Fx, Fy, M: creep\nforces and moment on the wheel in the same directions; lateral quantities positive to the \
         field side)\n  \
         shift mm   wheel  load kN    y mm  angle deg  length mm  width mm  peak MPa   xi 1e-3  eta 1e-3  spin 1/m    \
         Fx kN    Fy kN    M N m"
    )?;
    for shift in shifts {
        for (side, wheel) in shift.wheels() {
            for patch in &wheel.patches {
                writeln!(
                    out,
                    "  {:8.2}   {}  {:7.2}  {:6.2}  {:9.2}  {:9.2}  {:8.2}  {:8.0}  {:8.3}  {:8.3}  {:8.3}  {:7.2}  \
                     {:7.2}  {:7.1}",
                    shift.lateral_shift_m * 1e3,
                    name(side),
                    patch.load_n * 1e-3,
                    patch.wheel_y_m * 1e3,
                    patch.contact_angle_rad.to_degrees(),
                    2e3 * patch.semi_axis_rolling_m,
                    2e3 * patch.semi_axis_across_m,
                    patch.peak_pressure_pa * 1e-6,
                    unsigned_zero(patch.longitudinal_creepage * 1e3, 3),
                    unsigned_zero(patch.lateral_creepage * 1e3, 3),
                    unsigned_zero(patch.spin_creepage_per_m, 3),
                    unsigned_zero(patch.longitudinal_creep_force_n * 1e-3, 2),
                    unsigned_zero(patch.lateral_creep_force_n * 1e-3, 2),
                    unsigned_zero(patch.spin_moment_n_m, 1),
                )?;
            }
        }
    }
    writeln!(
        out,
        "\nestimates: wheel and rail are elastic half-spaces, so pressures ignore yielding, and patches as wide as the \
         radii in the flange root\nare less certain; length and width are those of the ellipse with the area and width \
         of the patch; the creep forces are those of\nthis ellipse by exact rolling-contact theory, with creepages at \
         the mean position of the patch; no moment of the suspension acts."
    )
}

fn name(side: i8) -> &'static str {
    if side < 0 { " left" } else { "right" }
}

/// `number`, or zero if it rounds to zero, so that no `-0.00` is printed.
fn unsigned_zero(number: f64, decimals: i32) -> f64 {
    if number.abs() < 0.5 * 10_f64.powi(-decimals) {
        0.0
    } else {
        number
    }
}
