//! Panels of a page, from the numbers in it: limits, one scale, and colours that a grey print tells apart.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;

use crate::shown::{CURVE, STUDY, all};

/// Title and data of each panel.
fn panels(page: &str) -> Vec<(String, Value)> {
    let parts = page.split("<div class=\"head\"><b>").skip(1);
    let panel = |part: &str| {
        let (title, rest) = part.split_once("</b>").unwrap();
        let (_, data) = rest
            .split_once("<script type=\"application/json\">")
            .unwrap();
        let (data, _) = data.split_once("</script>").unwrap();
        (title.to_owned(), serde_json::from_str(data).unwrap())
    };
    parts.map(panel).collect()
}

/// Panels of a quantity, one for each of six wheelsets.
fn of_wheelsets<'a>(panels: &'a [(String, Value)], y: &str) -> Vec<&'a Value> {
    let found = panels.iter().filter(|(_, panel)| panel["y"]["label"] == y);
    let (titles, found): (Vec<_>, Vec<_>) = found.map(|(title, panel)| (title, panel)).unzip();
    let expected = (0..found.len()).map(|number| format!("wheelset {}", number % 6 + 1));
    assert!(titles.into_iter().eq(&expected.collect::<Vec<_>>()), "{y}");
    found
}

/// Ordinates of the curve with this name; of several, the last.
fn ordinates(panel: &Value, name: &str) -> Vec<f32> {
    let mut curves = panel["curves"].as_array().unwrap().iter().rev();
    let curve = curves.find(|curve| curve["name"] == name);
    let curve = curve.unwrap_or_else(|| panic!("no {name}: {}", panel["y"]));
    let place = curve["columns"][1].as_u64().unwrap() as usize;
    let bytes = BASE64_STANDARD.decode(panel["columns"][place].as_str().unwrap());
    let bytes = bytes.unwrap();
    let numbers = bytes.chunks_exact(4);
    numbers
        .map(|four| f32::from_le_bytes(four.try_into().unwrap()))
        .collect()
}

#[test]
fn limits_of_the_report_are_drawn() {
    let [page, report] = &*CURVE;
    let report: Value = serde_json::from_str(report).unwrap();
    let indices = &report["indices"];
    let panels = panels(page);
    let level = |panel: &Value, name: &str, expected: f64| {
        let drawn = ordinates(panel, name);
        assert_eq!(drawn.len(), 2, "{name}");
        for value in drawn {
            assert!(
                (f64::from(value) / expected - 1.0).abs() < 1e-6,
                "{name}: {value} {expected}"
            );
        }
    };
    // Without and with the filter; limits apply to filtered values.
    let derailment = of_wheelsets(&panels, "Y/Q");
    assert_eq!(derailment.len(), 12);
    let nadal = indices["nadal"]["limit"].as_f64().unwrap();
    for panel in &derailment[6..] {
        level(panel, "Nadal's limit", nadal);
    }
    let loads = of_wheelsets(&panels, "Q, kN");
    let forces = of_wheelsets(&panels, "lateral force, kN");
    assert_eq!((loads.len(), forces.len()), (12, 6));
    for (number, wheelset) in indices["wheelsets"].as_array().unwrap().iter().enumerate() {
        let of_wheel = |name: &str| 1e-3 * wheelset["wheels"][0][name].as_f64().unwrap();
        level(loads[number], "standstill", of_wheel("load_static_n"));
        level(loads[number + 6], "limit", of_wheel("load_limit_n"));
        let limit = 1e-3 * wheelset["lateral_force_limit_n"].as_f64().unwrap();
        level(forces[number], "Prud'homme's limit", limit);
        level(forces[number], "", -limit);
    }
}

#[test]
fn panels_of_wheelsets_have_one_scale_and_each_side_has_its_colour() {
    let panels = panels(&CURVE[0]);
    for y in [
        "lateral, mm; yaw, mrad",
        "Q, kN",
        "lateral force, kN",
        "position, mm",
        "Y/Q",
    ] {
        for figure in of_wheelsets(&panels, y).chunks(6) {
            assert!(
                figure
                    .iter()
                    .all(|panel| panel["y"]["range"] == figure[0]["y"]["range"])
            );
        }
    }
    for side in ["left", "right"] {
        let curves = panels
            .iter()
            .flat_map(|(_, panel)| panel["curves"].as_array().unwrap());
        let curves = curves.filter(|curve| curve["name"] == side);
        let mut colours: Vec<_> = curves.map(|curve| curve["colours"].to_string()).collect();
        assert!(colours.len() > 20, "{side}: {}", colours.len());
        colours.dedup();
        assert_eq!(colours.len(), 1, "{side}: {colours:?}");
    }
}

#[test]
fn the_track_under_the_vehicle_is_drawn_in_a_curve() {
    let panels = panels(&CURVE[0]);
    let of = |title: &str| &panels.iter().find(|(found, _)| found == title).unwrap().1;
    let curvature = ordinates(of("curvature, 1/km"), "");
    let cant = ordinates(of("cant, mm"), "");
    // In the transition to a curve of 300 m, which is 3.33/km.
    assert_eq!(curvature[0], 0.0);
    let last = curvature[curvature.len() - 1];
    assert!(last > 1.0 && last < 3.4, "{last}");
    assert_eq!((cant[0], curvature.len()), (0.0, cant.len()));
    assert!(cant[cant.len() - 1] > 20.0);
}

/// Relative luminance of a colour like `#1565c0` (WCAG 2).
fn luminance(colour: &Value) -> f64 {
    let colour = colour.as_str().unwrap();
    let linear = |at: usize| {
        let part = u8::from_str_radix(&colour[at..at + 2], 16).unwrap();
        match f64::from(part) / 255.0 {
            part if part <= 0.04045 => part / 12.92,
            part => ((part + 0.055) / 1.055).powf(2.4),
        }
    };
    0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5)
}

#[test]
fn a_grey_print_tells_named_curves_apart() {
    for (name, page, ..) in all() {
        for (title, panel) in panels(page) {
            let curves = panel["curves"].as_array().unwrap().iter();
            let named: Vec<_> = curves.filter(|curve| curve["name"] != "").collect();
            for (number, one) in named.iter().enumerate() {
                for other in &named[..number] {
                    let [a, b] = [one, other].map(|curve| luminance(&curve["colours"][0]));
                    let contrast = (a.max(b) + 0.05) / (a.min(b) + 0.05);
                    assert!(
                        contrast > 1.15 || one["stroke"] != other["stroke"],
                        "{name}, {title}: {} and {}: {contrast:.2}",
                        one["name"],
                        other["name"]
                    );
                }
            }
        }
    }
}

#[test]
fn a_sweep_over_two_axes_has_a_heat_map_in_words() {
    let page = &*STUDY;
    for part in [
        "<caption>greatest lateral force, kN</caption>",
        "<th scope=\"colgroup\" colspan=\"3\">speed, km/h</th>",
        "<th scope=\"col\">clearance 2a, mm</th>",
        "<th scope=\"row\">5</th>",
        "speed = 170 km/h",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let (_, map) = page.split_once("<table class=\"heat\">").unwrap();
    let (map, _) = map.split_once("</table>").unwrap();
    assert_eq!(map.matches("<td class=\"heat-").count(), 6);
    let (body, _) = page.split_once("<!-- uPlot").unwrap();
    assert!(!body.contains("lateral_force_greatest_n"));
}
