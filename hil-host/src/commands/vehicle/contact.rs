//! Wheels, rails and friction of a run, as its report states them.

use serde::Serialize;

use dashpot_files::case::Case;

/// Wheels, rails and friction of a run.
#[derive(Serialize)]
pub(super) struct ContactReport {
    /// Profiles of each wheelset.
    wheels: Vec<WheelsetProfiles>,
    left_rail: String,
    right_rail: String,
    rail_inclination: f64,
    gauge_m: f64,
    gauge_depth_m: f64,
    back_to_back_m: f64,
    back_to_datum_m: f64,
    /// `[distance, gauge]`, m; empty if the gauge does not change.
    gauge_over_distance: Vec<[f64; 2]>,
    /// Static friction coefficient where `friction_over_distance` is empty.
    friction: f64,
    /// `[distance, left, right]`; one point if the friction differs only between the rails.
    friction_over_distance: Vec<[f64; 3]>,
    residual_friction_ratio: f64,
    friction_decay_speed_m_per_s: f64,
}

#[derive(Serialize)]
struct WheelsetProfiles {
    wheelset: String,
    left: String,
    right: String,
}

impl ContactReport {
    pub(super) fn new(case: &Case) -> Self {
        let contact = &case.contact;
        let wheelsets = case.vehicle.wheelsets.iter().enumerate();
        let wheels = wheelsets.map(|(number, wheelset)| {
            let [left, right] = [0, 1].map(|side| contact.wheel(number, side).name().to_owned());
            WheelsetProfiles {
                wheelset: wheelset.name.clone(),
                left,
                right,
            }
        });
        let [left_rail, right_rail] = [0, 1].map(|side| contact.rail(side).name().to_owned());
        Self {
            wheels: wheels.collect(),
            left_rail,
            right_rail,
            rail_inclination: contact.rail_inclination,
            gauge_m: contact.gauge_m,
            gauge_depth_m: contact.gauge_depth_m,
            back_to_back_m: contact.back_to_back_m,
            back_to_datum_m: contact.back_to_datum_m,
            gauge_over_distance: contact.gauge_over_distance.clone(),
            friction: case.friction,
            friction_over_distance: contact.friction_over_distance.clone(),
            residual_friction_ratio: contact.residual_friction_ratio,
            friction_decay_speed_m_per_s: contact.friction_decay_speed_m_per_s,
        }
    }

    /// Returns each subject with its text.
    pub(super) fn lines(&self) -> [(&'static str, String); 4] {
        [
            ("wheels", self.wheels()),
            ("rails", self.rails()),
            ("gauge", self.gauge()),
            ("friction", self.friction()),
        ]
    }

    fn wheels(&self) -> String {
        let profiles = |wheelset: &WheelsetProfiles| match wheelset.left == wheelset.right {
            true => wheelset.left.clone(),
            false => format!("{} left, {} right", wheelset.left, wheelset.right),
        };
        let mut distinct: Vec<(String, Vec<&str>)> = Vec::new();
        for wheelset in &self.wheels {
            let text = profiles(wheelset);
            match distinct.iter_mut().find(|(known, _)| *known == text) {
                Some((_, names)) => names.push(&wheelset.wheelset),
                None => distinct.push((text, vec![&wheelset.wheelset])),
            }
        }
        let text = match &distinct[..] {
            [(text, _)] => text.clone(),
            several => {
                let each = several.iter();
                let each = each.map(|(text, names)| format!("{text}: {}", names.join(", ")));
                each.collect::<Vec<_>>().join("; ")
            }
        };
        format!("{text}; {:.1} mm back to back", 1e3 * self.back_to_back_m)
    }

    fn rails(&self) -> String {
        let inclination = match self.rail_inclination {
            0.0 => "not inclined".to_owned(),
            ratio => format!("inclined 1:{}", rounded(1.0 / ratio, 2)),
        };
        match self.left_rail == self.right_rail {
            true => format!("{}, {inclination}", self.left_rail),
            false => format!(
                "{} left, {} right, {inclination}",
                self.left_rail, self.right_rail
            ),
        }
    }

    fn gauge(&self) -> String {
        let depth_mm = rounded(1e3 * self.gauge_depth_m, 2);
        let nominal = format!(
            "{:.2} mm, {depth_mm} mm below the top of the rails",
            1e3 * self.gauge_m
        );
        match extent(self.gauge_over_distance.iter().map(|[_, gauge_m]| *gauge_m)) {
            Some([least_m, greatest_m]) => format!(
                "{:.2} to {:.2} mm along the track; profiles laid at {nominal}",
                1e3 * least_m,
                1e3 * greatest_m
            ),
            None => nominal,
        }
    }

    fn friction(&self) -> String {
        let points = &self.friction_over_distance[..];
        let at_rest = match points {
            [] => self.friction.to_string(),
            [[_, left, right]] => format!("{left} left, {right} right"),
            several => {
                let side = |side: usize| {
                    let values = several.iter().map(|[_, left, right]| [*left, *right][side]);
                    let [least, greatest] = extent(values).unwrap_or_default();
                    format!("{least} to {greatest}")
                };
                format!("{} left, {} right along the track", side(0), side(1))
            }
        };
        if self.residual_friction_ratio >= 1.0 {
            return at_rest;
        }
        format!(
            "{at_rest}, falling with slip to {} % (decay speed {} m/s)",
            rounded(1e2 * self.residual_friction_ratio, 2),
            self.friction_decay_speed_m_per_s
        )
    }
}

/// Smallest and largest number; `None` if there are none.
fn extent(numbers: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    numbers.fold(None, |extent, number| match extent {
        None => Some([number; 2]),
        Some([least, greatest]) => Some([least.min(number), greatest.max(number)]),
    })
}

/// Rounds to a number of decimals, without trailing zeros.
fn rounded(number: f64, decimals: usize) -> f64 {
    let text = format!("{number:.decimals$}");
    text.parse().unwrap_or(number)
}
