//! Lines against certified and hand-computed numbers.

use dashpot_testbench::trend::fit::{Line, Point};

/// `y`, `x` of the linear regression Norris of the NIST Statistical Reference Datasets.
const NORRIS: [(f64, f64); 36] = [
    (0.1, 0.2),
    (338.8, 337.4),
    (118.1, 118.2),
    (888.0, 884.6),
    (9.2, 10.1),
    (228.1, 226.5),
    (668.5, 666.3),
    (998.5, 996.3),
    (449.1, 448.6),
    (778.9, 777.0),
    (559.2, 558.2),
    (0.3, 0.4),
    (0.1, 0.6),
    (778.1, 775.5),
    (668.8, 666.9),
    (339.3, 338.0),
    (448.9, 447.5),
    (10.8, 11.6),
    (557.7, 556.0),
    (228.3, 228.1),
    (998.0, 995.8),
    (888.8, 887.6),
    (119.6, 120.2),
    (0.3, 0.3),
    (0.6, 0.3),
    (557.6, 556.8),
    (339.3, 339.1),
    (888.0, 887.2),
    (998.5, 999.0),
    (778.9, 779.0),
    (10.2, 11.1),
    (117.6, 118.3),
    (228.9, 229.2),
    (668.4, 669.1),
    (449.2, 448.9),
    (0.2, 0.5),
];

fn close(found: f64, expected: f64, relative: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= relative * expected.abs(),
        "{found} is not {expected}"
    );
}

/// With readings whose own deviation is negligible, the scatter is the residual deviation and the line that of ordinary
/// least squares.
#[test]
fn equal_readings_give_the_certified_line_of_least_squares() {
    let points = NORRIS.map(|(y, x)| Point { x, y, sd: 1e-6 });
    let line = Line::fit(&points).unwrap();
    close(line.slope, 1.00211681802045, 1e-10);
    close(
        line.value - line.slope * line.centre,
        -0.262323073774029,
        1e-8,
    );
    close(line.scatter, 0.884796396144373, 1e-9);
    close(line.slope_variance.sqrt(), 0.429796848199937e-3, 1e-9);
    let intercept = line.at(0.0);
    // Student's quantile for 34 degrees of freedom.
    close(line.quantile, 2.0322445, 1e-7);
    close(
        intercept.high - intercept.value,
        2.0322445 * 0.232818234301152,
        1e-7,
    );
    assert!(line.has_changed() && line.p_value() < 1e-30);
}

/// Computed by hand: weights 1, 1/4 and 1.
#[test]
fn readings_weigh_by_their_variance() {
    let points = [(0.0, 0.0, 1.0), (1.0, 1.0, 2.0), (2.0, 1.0, 1.0)];
    let points = points.map(|(x, y, sd)| Point { x, y, sd });
    let line = Line::fit(&points).unwrap();
    close(line.centre, 1.0, 1e-15);
    close(line.value, 1.25 / 2.25, 1e-15);
    close(line.slope, 0.5, 1e-15);
    close(line.value_variance, 1.0 / 2.25, 1e-15);
    close(line.slope_variance, 0.5, 1e-15);
    // The chi-square of 1/9 on one degree of freedom shows no scatter, so the readings' own deviations are believed.
    assert_eq!(line.scatter, 0.0);
    close(line.quantile, 12.706205, 1e-7);
    // P(|t| > 0.5 / sqrt(0.5)) of the Cauchy distribution is 1 - 2/pi atan(t).
    let p = 1.0 - 2.0 / std::f64::consts::PI * 0.5f64.sqrt().atan();
    close(line.p_value(), p, 1e-9);
}

/// Paule and Mandel's condition: the squared residuals over their variances sum to the degrees of freedom.
#[test]
fn the_scatter_explains_the_residuals_of_unequal_readings() {
    let deviations = [0.5, 0.1, 0.3, 0.2, 0.4, 0.1];
    let values = [1.0, 3.1, 1.9, 4.5, 3.0, 5.9];
    let points: Vec<Point> = deviations
        .iter()
        .zip(values)
        .enumerate()
        .map(|(x, (sd, y))| Point {
            x: x as f64,
            y,
            sd: *sd,
        })
        .collect();
    let line = Line::fit(&points).unwrap();
    assert!(line.scatter > 0.5, "{line:?}");
    let square = |point: &Point| {
        let residual = point.y - line.at(point.x).value;
        residual * residual / (point.sd * point.sd + line.scatter * line.scatter)
    };
    close(points.iter().map(square).sum(), 4.0, 1e-9);
}

#[test]
fn there_is_no_line_through_too_little() {
    let point = |x, sd| Point { x, y: 1.0, sd };
    assert_eq!(Line::fit(&[]), None);
    assert_eq!(Line::fit(&[point(0.0, 1.0), point(1.0, 1.0)]), None);
    assert_eq!(Line::fit(&[point(2.0, 1.0); 5]), None);
    for bad in [0.0, f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(
            Line::fit(&[point(0.0, 1.0), point(1.0, 1.0), point(2.0, bad)]),
            None
        );
    }
    // Equal values have no scatter and no change.
    let line = Line::fit(&[point(0.0, 0.1), point(1.0, 0.1), point(2.0, 0.1)]).unwrap();
    assert_eq!((line.slope, line.scatter, line.p_value()), (0.0, 0.0, 1.0));
    assert!(!line.has_changed());
}
