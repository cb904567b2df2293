//! Against a solver independent of this project.

use dashpot_rail::creep::{Creepage, KalkerTable, LoadedContact};
use dashpot_reference::rolling_contact::RollingContact;

const GRID: &str = include_str!("../../../rail/data/creep_exact_grid.csv");

#[test]
fn another_solver() {
    let kalker = KalkerTable::new(0.28).unwrap();
    let mut contacts: Vec<(f64, RollingContact)> = vec![];
    let mut stats = [[0.0f64; 5]; 4];
    for line in GRID.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit())) {
        let v: Vec<f64> = line.split(',').map(|s| s.parse().unwrap()).collect();
        let (r, a, b, n, mu) = (v[0], v[1], v[2], v[3], v[4]);
        if !contacts.iter().any(|c| c.0 == r) { contacts.push((r, RollingContact::new(r, v[6]).unwrap())); }
        let solver = &contacts.iter().find(|c| c.0 == r).unwrap().1;
        let contact = LoadedContact { load_n: n, a_m: a, b_m: b, shear_modulus_pa: v[5], friction: mu, kalker: kalker.at(r) };
        let f = solver.creep_forces(&contact, &Creepage { longitudinal: v[7], lateral: v[8], spin_per_m: v[9] }).unwrap();
        let f2 = dashpot_reference::rolling_contact::full_sliding(r, [v[7], v[8], v[9] * (a * b).sqrt()]);
        let e = (f.longitudinal_n - v[10]).hypot(f.lateral_n - v[11]) / (mu * n);
        let em = (f.moment_n_m - v[12]).abs() / (mu * n * (a * b).sqrt());
        let sliding = mu * n / (v[5] * a * b * contact.kalker.c11);
        let k = (v[9] * (a * b).sqrt() / sliding * 2.0).round() as usize;
        if v[7].hypot(v[8]) > 2.9 * sliding { let c = (f.longitudinal_n/(mu*n) - f2[0]).hypot(f.lateral_n/(mu*n) - f2[1]); let d = (v[10]/(mu*n) - f2[0]).hypot(v[11]/(mu*n) - f2[1]); println!("large {r} k {k} {:.5} {:.5}: ours-slid {c:.4} grid-slid {d:.4}, ours-grid {e:.4}", v[7], v[8]); }
        let st = &mut stats[k.min(3)];
        st[0] += e * e; st[1] = st[1].max(e); st[2] += em * em; st[3] = st[3].max(em); st[4] += 1.0;
        if e > 0.02 { println!("{e:.4} {line} {f:?}"); }
    }
    for s in stats { println!("rms {:.4} worst {:.4}  M {:.4} {:.4}", (s[0] / s[4]).sqrt(), s[1], (s[2] / s[4]).sqrt(), s[3]); }
}
