//! Exact results for S1002 on UIC 60, computed with an independent solver.

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel};

/// Cases of an independent solver of the three-dimensional half-space, under 100 kN and 30 kN.
pub const LOADS: [&str; 2] = [
    include_str!("../../data/contact_exact_100kn.csv"),
    include_str!("../../data/contact_exact_30kn.csv"),
];

/// S1002 of 0.625 m radius on UIC 60, with the steel of the exact cases.
pub fn geometry() -> ContactGeometry {
    let installation = Installation::default().with_wheel_radius_m(0.625);
    let steel = Steel::default()
        .with_young_modulus_pa(2.0 * 82e9 * 1.28)
        .with_poisson_ratio(0.28);
    ContactGeometry::new(Pair::standard(installation).unwrap(), steel).unwrap()
}

/// One case: shift of the wheel, depth of its datum, and results. Forces act on the rail.
pub struct Case {
    pub lateral_m: f64,
    pub depth_m: f64,
    pub normal_n: f64,
    pub position_m: f64,
    pub peak_pressure_pa: f64,
    pub force_n: [f64; 3],
    pub spin_moment_n_m: f64,
}

pub fn cases(text: &str) -> Vec<Case> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let columns = [
        "y_mm",
        "z_ws_mm",
        "fn_n",
        "ycp_mm",
        "pmax_mpa",
        "fx_rail_n",
        "fy_rail_n",
        "fz_rail_n",
        "mn_patch_nmm",
    ];
    let columns = columns.map(|name| names.iter().position(|other| *other == name).unwrap());
    let case = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let [y, z, normal, position, peak, fx, fy, fz, moment] =
            columns.map(|k| fields[k].parse::<f64>().unwrap());
        Case {
            lateral_m: 1e-3 * y,
            depth_m: 1e-3 * z,
            normal_n: normal,
            position_m: 1e-3 * position,
            peak_pressure_pa: 1e6 * peak,
            force_n: [fx, fy, fz],
            spin_moment_n_m: 1e-3 * moment,
        }
    };
    lines.map(case).collect()
}
