//! The cursor of loops is an instant, and all loops show the same one.

use crate::browser::Browser;
use crate::shown::DEMONSTRATION;

/// The first values shown by the two panels of loops of a ride, plots three and four.
const VALUES: &str = "[3, 4].map(plot => \
 document.querySelectorAll('.panel')[plot].querySelector('.value').textContent)";

fn check(width: u32) {
    let Some(browser) = Browser::start("the cursor of loops") else {
        return;
    };
    browser.open(&DEMONSTRATION, width);
    // The lower left corner: the maximum compression force.
    browser.point(4, [0.1, 0.9]);
    browser.wait_for(&format!("{VALUES}.every(value => value !== '')"));
    let values = browser.find(&format!("return {VALUES}"));
    let forces = [0, 1].map(|panel| {
        let values_text = values[panel].as_str().unwrap().replace('−', "-");
        let (_, force) = values_text.split_once("; ").unwrap();
        force.parse::<f64>().unwrap()
    });
    // Velocities start one tick after displacements.
    assert!(
        forces[1] < -8.0 && (forces[0] - forces[1]).abs() < 0.4,
        "{width}: {values}"
    );
    let others = "[0, 1, 2].map(plot => \
     document.querySelectorAll('.panel')[plot].querySelector('.value').textContent).join('')";
    assert_eq!(browser.find(&format!("return {others}")), "");
}

#[test]
fn loops_show_one_instant_on_a_desk() {
    check(1280);
}

#[test]
fn loops_show_one_instant_on_a_phone() {
    check(390);
}
