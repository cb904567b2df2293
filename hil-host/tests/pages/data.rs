//! The button "data" saves the numbers of a plot as CSV, under the page's security policy.

use std::fs;
use std::time::{Duration, Instant};

use crate::browser::{Browser, HANGS};
use crate::shown::{HEALTH, VEHICLE};

/// Clicks the button of the plot with this index and returns the name of the saved file and its text.
fn saved(browser: &Browser, page: &str, plot: usize) -> (String, String) {
    let folder = browser.saving();
    browser.open(page, 1280);
    browser.find(&format!(
        "document.querySelectorAll('.data')[{plot}].id = 'wanted';"
    ));
    browser.click("#wanted");
    let started = Instant::now();
    loop {
        let files = fs::read_dir(&folder)
            .unwrap()
            .map(|file| file.unwrap().path());
        let mut whole = files.filter(|path| path.extension().is_some_and(|ending| ending == "csv"));
        if let Some(path) = whole.next() {
            let text = fs::read_to_string(&path).unwrap();
            if !text.is_empty() {
                let name = path.file_name().unwrap().to_str().unwrap().to_owned();
                fs::remove_file(path).unwrap();
                let refused = browser.log("browser");
                assert!(refused.is_empty(), "{refused:?}");
                return (name, text);
            }
        }
        assert!(started.elapsed() < HANGS, "nothing saved");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn the_numbers_of_a_plot_are_saved_with_their_labels() {
    let Some(browser) = Browser::start("saved numbers") else {
        return;
    };
    // Accelerations and displacements are the first eight plots. Left and right have the same times.
    let (name, text) = saved(&browser, &VEHICLE, 8);
    assert_eq!(name, "wheel-loads-wheelset-1.csv");
    let mut lines = text.lines();
    let header = "\"time, s\",\"left: Q, kN\",\"right: Q, kN\",\"time, s\",\"standstill: Q, kN\"";
    assert_eq!(lines.next(), Some(header));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert!(rows.len() > 4000, "{}", rows.len());
    assert!(rows.iter().all(|row| row.len() == 5));
    assert_eq!(rows[0][0], "0.001");
    let load: f64 = rows[0][1].parse().unwrap();
    let standstill: f64 = rows[0][4].parse().unwrap();
    assert!(
        (load - standstill).abs() < 2.0 && standstill > 90.0,
        "{load} {standstill}"
    );
    // The line at standstill has two points.
    assert_eq!(rows[2][3..], ["", ""]);
}

#[test]
fn curves_share_their_abscissas_and_a_band_has_two_columns() {
    let Some(browser) = Browser::start("saved numbers") else {
        return;
    };
    let (name, text) = saved(&browser, &HEALTH, 1);
    assert_eq!(name, "estimates-stiffness-mn-m.csv");
    let header = text.lines().next().unwrap();
    assert!(
        header.starts_with(
            "\"time, s\",\"curve 1: stiffness, MN/m, low\",\"curve 1: stiffness, MN/m, high\",\
             \"estimate: stiffness, MN/m\",\"time, s\",\"baseline: stiffness, MN/m\""
        ),
        "{header}"
    );
}
