//! Differences between the outline kept with the rows and the outline of the same cases today.

use super::outline::{AxisOutline, Outline, SweepOutline};
use super::parts::DIGEST;

/// Describes each difference; `rows` and `now` have the same sweeps, seeds and values.
pub fn differences(rows: &Outline, now: &Outline) -> Vec<String> {
    let sweeps = rows.sweeps.iter().zip(&now.sweeps);
    let sweeps = sweeps.flat_map(|(rows, now)| {
        let in_sweep = |text: String| format!("sweep {}: {text}", rows.name);
        of_sweep(rows, now).into_iter().map(in_sweep)
    });
    let mut all: Vec<String> = sweeps.collect();
    // The same file in several sweeps differs in each of them.
    all.dedup_by(|a, b| a == b);
    all
}

fn of_sweep(rows: &SweepOutline, now: &SweepOutline) -> Vec<String> {
    let parts = rows.parts.iter().filter_map(|(name, value)| {
        let today = now.parts.get(name).map(String::as_str).unwrap_or_default();
        match value == today {
            true => None,
            false if value.starts_with(DIGEST) => Some(format!("{name} differs")),
            false => Some(format!("{name} was {value}, is now {today}")),
        }
    });
    let mut all: Vec<String> = parts.collect();
    // A change of the whole case is also one of each value.
    let axes = rows.axes.iter().zip(&now.axes);
    let axes = axes.filter_map(|(rows, now)| of_axis(rows, now, all.is_empty()));
    let axes: Vec<String> = axes.collect();
    all.extend(axes);
    all
}

fn of_axis(rows: &AxisOutline, now: &AxisOutline, with_cases: bool) -> Option<String> {
    let parameter = &rows.parameter;
    if rows.set != now.set {
        let [set, today] = [rows, now].map(|axis| axis.set.join(", "));
        return Some(format!("set of {parameter} was `{set}`, is now `{today}`"));
    }
    let mut values = rows.values.iter().zip(rows.cases.iter().zip(&now.cases));
    let (value, _) = values.find(|(_, (case, today))| with_cases && case != today)?;
    Some(format!("what {parameter} = {value} stands for differs"))
}

#[cfg(test)]
mod tests {
    use super::differences;
    use crate::sweep::extension::Outline;
    use crate::sweep::study::Study;
    use dashpot_files::study::StudyParameters;

    fn outline(duration_s: &str, set: &str, damper: &str) -> Outline {
        let text = format!(
            r#"name = "x"
            observed = ["derailment_rms"]
            [[sweep]]
            name = "worn"
            track = "straight"
            speed_km_h = 120
            duration_s = {duration_s}
            dampers = {{ {damper} }}
            vary = [{{ parameter = "worn_damper", values = ["none", "rear vertical damper 4"], set = ["{set}"] }}]"#
        );
        let parameters = StudyParameters::parse("study", &text).unwrap();
        Outline::of(&Study::new(parameters).unwrap()).unwrap()
    }

    #[test]
    fn each_difference_is_named() {
        let set = "mount.stiffness_n_per_m=1e5";
        let rows = outline("1.5", set, "");
        assert!(differences(&rows, &rows).is_empty());
        let now = outline("2", set, "vertical = \"in-service\"");
        assert_eq!(
            differences(&rows, &now),
            [
                "sweep worn: duration_s was 1.5, is now 2.0",
                "sweep worn: vehicle differs"
            ]
        );
        let now = outline("1.5", "mount.stiffness_n_per_m=2e5", "");
        let text = format!(
            "sweep worn: set of worn_damper was `{set}`, is now `mount.stiffness_n_per_m=2e5`"
        );
        assert_eq!(differences(&rows, &now), [text]);
    }
}
