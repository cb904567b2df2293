#![allow(missing_docs)]
use dashpot_rail::contact::*;
use dashpot_rail::creep::*;
use std::hint::black_box;
use std::sync::Arc;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: usize = a[1].parse().unwrap();
    let four = a[2].as_str();
    let pair = Pair::standard(Installation::default()).unwrap();
    let g = ContactGeometry::new(pair, Steel::default()).unwrap();
    let t = Arc::new(Tables::cached(std::path::Path::new("/tmp/tabs"), g).tables);
    let c = WheelsetContact::new(t, KalkerBook::new(), Friction::default()).unwrap();
    let mut motion = Motion {
        speed_m_per_s: 27.8,
        rotation_rad_per_s: 27.8 / 0.625,
        yaw_rad: 0.008,
        ..Motion::default()
    };
    let mut rails = [RailDisplacement::default(); 2];
    match four {
        "four" => {
            motion.vertical_m = -0.75e-3;
            [rails[0].lateral_m, rails[1].lateral_m] = [6.68e-3, -6.68e-3];
        }
        "three" => {
            (motion.lateral_m, motion.vertical_m, motion.roll_rad) = (6.4e-3, -0.15e-3, -0.65e-3)
        }
        "two" => motion.vertical_m = 0.27e-3,
        _ => motion.vertical_m = -20e-3,
    }
    let mut f = WheelsetForces::default();
    if n == 0 {
        for v in -100..40 {
            motion.vertical_m = 1e-5 * v as f64;
            c.update(&motion, &rails, &mut f);
            println!(
                "{} {:?}",
                motion.vertical_m,
                f.wheels.map(|w| (
                    w.status,
                    w.loaded_patches().count(),
                    w.force_n[2],
                    w.patches.map(|p| p.load_n as i32)
                ))
            );
        }
        return;
    }
    for _ in 0..n {
        c.update(black_box(&motion), black_box(&rails), &mut f);
        black_box(&f);
    }
    println!(
        "{:?}",
        f.wheels
            .map(|w| (w.status, w.loaded_patches().count(), w.force_n[2]))
    );
}
