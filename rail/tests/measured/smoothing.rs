//! Smoothing recovers a profile from the rounded readings of a gauge.

use dashpot_rail::profile::s1002;

use crate::common::{text, wheel, wheel_readings};

#[test]
fn the_file_of_a_gauge_gives_the_profile() {
    let (profile, _) = wheel(&text(&wheel_readings())).unwrap();
    let truth = s1002::profile();
    let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
    for i in -350..550 {
        let s = f64::from(i) * 0.1;
        let z = profile.at(s * 1e-3).z_m * 1e3;
        worst = worst.max((z - s1002::depth_mm(s)).abs());
        if (-20.0..30.0).contains(&s) {
            let off = profile.at(s * 1e-3).curvature_per_m - truth.at(s * 1e-3).curvature_per_m;
            squares += off * off;
            count += 1.0;
        }
    }
    let curvature = f64::sqrt(squares / count);
    println!("rounded to 0.01 mm: {worst:.4} mm, curvature {curvature:.2} per m RMS");
    assert!(worst < 0.005, "{worst} mm");
    assert!(curvature < 2.0, "{curvature} per m");
    let mut rows = wheel_readings();
    rows.reverse();
    let (reversed, _) = wheel(&text(&rows)).unwrap();
    assert_eq!(reversed.points(), profile.points());
}
