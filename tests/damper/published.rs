//! Compares every number of Tables 1 to 5 of the source paper with ours: writes and checks docs/validation.md.

use std::fmt::Write;

use dashpot::bench_test::{Harmonic, Indices, settled_cycle};
use dashpot::{damper, document};
use dashpot_core::parameters::{Element, Hydraulics, Valve};
use dashpot_core::shim::{Disc, Pack};

/// Rows of a published table without the header.
fn rows(file: &str) -> Vec<Vec<String>> {
    let text = document::read(&format!("data/published/{file}"));
    text.lines()
        .skip(1)
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

fn number(cell: &str) -> f64 {
    cell.parse()
        .unwrap_or_else(|_| panic!("`{cell}` is not a number"))
}

fn hydraulics() -> Hydraulics {
    match damper("paper", &[]).element {
        Element::Physical(hydraulics) => hydraulics,
        _ => panic!("the preset `paper` is physical"),
    }
}

fn pack(valve: &Valve) -> Pack {
    Pack::new("valve", valve).expect("the preset has packs")
}

/// Compliance at the edge under uniform pressure from the theory of Table 1 (m/Pa).
fn theory(valve: &Valve) -> f64 {
    pack(valve).compliance_m_per_pa(valve.free_radius_m)
}

/// Compliance of the same discs, bonded to one plate of their total thickness (m/Pa).
fn bonded(valve: &Valve) -> f64 {
    let thickness: f64 = valve.shims_m.iter().sum();
    pack(valve)
        .disc()
        .deflection_coefficient(valve.free_radius_m)
        / thickness.powi(3)
}

fn given(valve: &Valve) -> f64 {
    valve
        .edge_compliance_m_per_pa
        .expect("the preset gives compliances")
}

/// Value that the preset uses for a symbol of Table 1.
fn of_preset(symbol: &str, valves: &dashpot_core::parameters::Valves) -> f64 {
    let (extension, compression, foot) = (
        &valves.piston_extension,
        &valves.piston_compression,
        &valves.foot_compression,
    );
    match symbol {
        "E" => extension.elastic_modulus_pa,
        "nu" => extension.poisson_ratio,
        "h1" => compression.shims_m[0],
        "h2" => extension.shims_m[0],
        "h3" => extension.shims_m[3],
        "h4" => foot.shims_m[0],
        "rn12" => compression.clamp_radius_m,
        "rn23" => extension.clamp_radius_m,
        "rn4" => foot.clamp_radius_m,
        "rw12" => compression.free_radius_m,
        "rw23" => extension.free_radius_m,
        "rw4" => foot.free_radius_m,
        other => panic!("Table 1 has a symbol `{other}` that nothing uses"),
    }
}

fn table_1(page: &mut String, valves: &dashpot_core::parameters::Valves) {
    *page += "## Table 1: shims\n\n\
        These are the inputs of the theory; the preset `paper` uses these values.\n\n\
        | symbol | meaning | published | preset | unit |\n|---|---|---|---|---|\n";
    for row in rows("table1_shims.csv") {
        let ours = of_preset(&row[0], valves);
        assert_eq!(
            ours,
            number(&row[1]),
            "preset and Table 1 differ in {}",
            row[0]
        );
        writeln!(
            page,
            "| {} | {} | {} | {ours:.2e} | {} |",
            row[0], row[3], row[1], row[2]
        )
        .unwrap();
    }
    *page += "\nResulting deflection coefficients:\n\n\
        | disc | Cw(r_w), model page [m^6/N] | ours [m^6/N] |\n|---|---|---|\n";
    for (name, clamp, free, stated) in [
        ("16/29 mm", 16e-3, 29e-3, 2.1427e-19),
        ("5/11 mm", 5e-3, 11e-3, 9.6981e-21),
    ] {
        let disc = Disc::new("disc", clamp, free, 2.0e11, 0.3).expect("a disc");
        let ours = disc.deflection_coefficient(free);
        writeln!(page, "| {name} | {stated:e} | {ours:.4e} |").unwrap();
    }
    page.push('\n');
}

fn deflections(page: &mut String, title: &str, file: &str, valve: &Valve) {
    let (theory, compliance, factor) = (
        theory(valve),
        given(valve),
        valve.equivalent_pressure_factor,
    );
    write!(
        page,
        "## {title}\n\nEdge deflection [mm]. *Theory*: the frictionless stack of Table 1 under uniform pressure. \
         *Preset*: the\ncompliance {compliance:.3e} m/Pa and Ce = {factor} that `paper` takes from this table.\n\n\
         | P [MPa] | uniform, published | uniform, FEA published | uniform, theory | theory/published | uniform, \
         preset \
         | preset/published | real, FEA published | real, preset | preset/published | Ce published | Ce preset |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|\n"
    )
    .unwrap();
    for row in rows(file) {
        let pressure = number(&row[0]) * 1e6;
        let (uniform, real) = (number(&row[1]), number(&row[3]));
        let ours = compliance * pressure * 1e3;
        let ours_real = ours * factor;
        writeln!(
            page,
            "| {} | {} | {} | {:.4} | {:.1} | {ours:.6} | {:.4} | {} | {ours_real:.6} | {:.4} | {} | {factor:.4} |",
            row[0],
            row[1],
            row[2],
            theory * pressure * 1e3,
            theory * pressure * 1e3 / uniform,
            ours / uniform,
            row[3],
            ours_real / real,
            row[4],
        )
        .unwrap();
        // The preset reproduces the published table to the printed digits.
        assert!(
            (ours / uniform - 1.0).abs() < 3e-3,
            "{file} at {pressure} Pa"
        );
        assert!(
            (ours_real / real - 1.0).abs() < 3e-3,
            "{file} at {pressure} Pa"
        );
    }
    page.push('\n');
}

fn first_erratum(page: &mut String, valves: &dashpot_core::parameters::Valves) {
    *page += "## Erratum 1: Tables 2 to 4 do not follow from Table 1\n\n\
        Edge compliance under uniform pressure [mm/MPa]: the paper's theory with its Table 1, compared with the \
        printed values of\n\
        Tables 2 to 4. The theory agrees with Roark's case 2l (`tests/damper/disc.rs`), so the tables must be based \
        on other shims,\n\
        another load or another unit; neither sliding nor bonded discs reproduce them. The preset uses the printed \
        compliances\n\
        because they lead to damper forces of the right size; `edge_compliance_m_per_pa` is a parameter for that \
        reason.\n\n\
        | valve | sliding discs | bonded discs | printed | sliding/printed | bonded/printed \
        |\n|---|---|---|---|---|---|\n";
    // The ratios that docs/model.md states, to its digits.
    for (name, valve, stated) in [
        ("piston extension", &valves.piston_extension, 33.0),
        ("piston compression", &valves.piston_compression, 41.0),
        ("foot compression", &valves.foot_compression, 30.0),
    ] {
        let (sliding, bonded, printed) = (theory(valve), bonded(valve), given(valve));
        assert!((sliding / printed - stated).abs() < 0.5, "{name}");
        writeln!(
            page,
            "| {name} | {:.4} | {:.5} | {:.6} | {:.1} | {:.2} |",
            sliding * 1e9,
            bonded * 1e9,
            printed * 1e9,
            sliding / printed,
            bonded / printed
        )
        .unwrap();
    }
    page.push('\n');
}

/// Index of Table 5 by its published name, in the published unit.
fn index(name: &str, indices: &Indices) -> f64 {
    match name {
        "damping coefficient" => indices.damping_coefficient_n_s_per_m() * 1e-3,
        "maximum extension force" => indices.max_extension_force_n,
        "maximum compression force" => indices.max_compression_force_n,
        "asymmetry rate" => 100.0 * indices.asymmetry_rate(),
        "energy per cycle" => indices.energy_per_cycle_j,
        other => panic!("Table 5 has an index `{other}` that nothing computes"),
    }
}

fn table_5(page: &mut String) {
    let motion = Harmonic {
        amplitude_m: 24.875e-3,
        frequency_hz: 0.64,
    };
    let indices = settled_cycle(&damper("paper", &[]), motion, 1e-4);
    *page += "## Table 5: nominal characteristic\n\n\
        The motion is +-24.875 mm at 0.64 Hz (0.1 m/s); ours is the preset `paper`, f64, 10 kHz, the fifth cycle. The \
        damping\n\
        coefficient is the mean of the two maximum forces over the maximum velocity; the paper does not define it, \
        and its two\n\
        columns fit no definition we tried to better than 0.2 and 1 %. The asymmetry rate is `(F_ext - F_comp)/(F_ext \
        + F_comp)`.\n\n\
        | index | unit | published simulation | published test | published error | ours | ours/test \
        |\n|---|---|---|---|---|---|---|\n";
    for row in rows("table5_nominal_characteristic.csv") {
        let ours = index(&row[0], &indices);
        writeln!(
            page,
            "| {} | {} | {} | {} | {} % | {ours:.2} | {:.3} |",
            row[0],
            row[1],
            row[2],
            row[3],
            row[4],
            ours / number(&row[3])
        )
        .unwrap();
        // The printed error must follow from the printed columns.
        let printed = number(&row[4]);
        let error = 100.0 * (number(&row[2]) / number(&row[3]) - 1.0).abs();
        assert!((error - printed).abs() < 0.011, "{}: {error}", row[0]);
    }
    let factor = indices.energy_factor(motion.amplitude_m);
    let rows = rows("table5_nominal_characteristic.csv");
    let published = |column: usize| {
        let force = 0.5 * (number(&rows[1][column]) + number(&rows[2][column]));
        number(&rows[4][column]) / (std::f64::consts::PI * force * motion.amplitude_m)
    };
    write!(
        page,
        "\n## Erratum 2: Eq. 31 with Tables 2 to 4 does not reproduce Table 5\n\n\
         The force in compression, where two valves act on the larger piston area, is {:.0} % above the test; the \
         force in\n\
         extension is {:.0} % below it. The energy factor `E/(pi F x0)` is {:.3} in the published simulation, {:.3} \
         in the test\n\
         and {factor:.3} here. A factor above 1 requires a digressive curve, but Eq. 31 with orifice and shims alone \
         is\n\
         progressive over this range. At 0.3 m/s Eq. 31 gives 36 kN; the axis of the paper's Fig. 9 ends at 25 kN.\n\
         No value of the preset is tuned to hide this.\n",
        100.0 * (indices.max_compression_force_n / number(&rows[2][3]) - 1.0),
        100.0 * (1.0 - indices.max_extension_force_n / number(&rows[1][3])),
        published(2),
        published(3),
    )
    .unwrap();
    // These are the conditions that the erratum states.
    assert!(indices.asymmetry_rate() < -0.1 && published(2) > 1.02);
}

#[test]
fn every_published_number_is_compared() {
    let hydraulics = hydraulics();
    let valves = &hydraulics.valves;
    let mut page = String::from(
        "# Validation: comparison with the published numbers\n\n\
         `tests/damper/published.rs` generates this page from `data/published/` and fails if the page differs\n\
         (`DASHPOT_BLESS=1 cargo test -p dashpot --test damper published` writes it). See `data/published/README.md` \
         for the source.\n\n",
    );
    table_1(&mut page, valves);
    let tables = [
        (
            "Table 2: piston extension valve",
            "table2_piston_extension.csv",
            &valves.piston_extension,
        ),
        (
            "Table 3: piston compression valve",
            "table3_piston_compression.csv",
            &valves.piston_compression,
        ),
        (
            "Table 4: compression valve in the foot",
            "table4_foot_compression.csv",
            &valves.foot_compression,
        ),
    ];
    for (title, file, valve) in tables {
        deflections(&mut page, title, file, valve);
    }
    first_erratum(&mut page, valves);
    table_5(&mut page);
    document::compare("docs/validation.md", &page);
}
