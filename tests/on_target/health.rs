//! Tests of the health estimator on emulated processors: its results have the bits of this machine, and no tick exceeds
//! its bound.

use std::io::Write;
use std::path::Path;

use dashpot::in_turn::{InTurn, RETRY_LIMITS, images};
use dashpot::target::{first_line, symbol_address};
use dashpot::{damper, document};
use dashpot_core::Damper;
use dashpot_core::health::{HealthSettings, HealthStatus};
use dashpot_core::link::Refusal;
use dashpot_experiment::watch::{SAMPLES, Watch};
use dashpot_host_link::{Client, HealthSample, LinkError};
use dashpot_testbench::excitation::Excitation;
use dashpot_testbench::health::{Noise, watch};
use serde_json::Value;
use tempfile::NamedTempFile;
use xtask::processor::{CORTEX_M4F, CORTEX_M7, CORTEX_M33, Processor};
use xtask::target_toolchain::TargetToolchain;
use xtask::tools::{ARM_GCC, QEMU, have, have_target};

const DOCUMENT: &str = "docs/health.md";
/// Time of an instruction under `-icount shift=10` (s).
const INSTRUCTION_S: f64 = 1024e-9;

/// A processor with its bounds.
struct Bound {
    processor: Processor,
    /// Maximum instructions of a tick, including the fetch of the sample.
    instructions: f64,
    /// Maximum for `dashpot_health_tick`, which checks its pointers first; dashpot.h states it.
    in_c: f64,
}

const BOUNDS: [Bound; 3] = [
    Bound {
        processor: CORTEX_M7,
        instructions: 270.0,
        in_c: 300.0,
    },
    Bound {
        processor: CORTEX_M33,
        instructions: 270.0,
        in_c: 310.0,
    },
    Bound {
        processor: CORTEX_M4F,
        instructions: 450.0,
        in_c: 450.0,
    },
];

/// Instructions of a tick of one damper, and bytes of the estimator.
struct Cost {
    mean: f64,
    most: f64,
    in_c: f64,
    model_bytes: f64,
    health_bytes: f64,
}

/// Displacement and force of a damper while the ride runs forwards and backwards, with noise of 2 %, and values that no
/// sensor should deliver.
fn samples(preset: &str) -> Vec<[u8; 8]> {
    let damper: Damper<f64> = damper(preset, &[]).build(1e-3).unwrap();
    let ride = Excitation::Ride.displacements_m(1e-3);
    let to_and_fro = ride.iter().chain(ride.iter().rev()).copied();
    let motion: Vec<f64> = to_and_fro.cycle().take(SAMPLES).collect();
    let mut state = damper.at_rest(0.0);
    let forces: Vec<f64> = motion.iter().map(|x| damper.step(&mut state, *x)).collect();
    let (mut motion, mut forces) =
        Noise::from_rms(0.02, &motion, &forces).add_to(&motion, &forces, 7);
    motion[15_000] = f64::NAN;
    forces[16_000] = f64::INFINITY;
    forces[17_000] = 1e9;
    motion[18_000] += 1.0;
    // These values contradict each other, until the estimate restarts.
    (20_000..20_400).for_each(|tick| {
        motion[tick] = 1.5e-3 * (tick - 20_000) as f64;
        forces[tick] = 1500.0;
    });
    let pairs = motion.iter().zip(&forces);
    pairs
        .map(|(x, f)| {
            let ([x0, x1, x2, x3], [f0, f1, f2, f3]) =
                ((*x as f32).to_le_bytes(), (*f as f32).to_le_bytes());
            [x0, x1, x2, x3, f0, f1, f2, f3]
        })
        .collect()
}

/// Runs the estimator of a preset on a processor, and compares its bits with those of this machine.
fn cost(image: &Path, processor: &Processor, preset: &str) -> Cost {
    let settings = HealthSettings::new(60e-6, 60.0);
    let checked = damper(preset, &[]).check().unwrap();
    let model = checked.health_model(&settings, 1e-3).unwrap();
    let model_image = model.to_image();
    let samples = samples(preset);
    let watch = Watch {
        model: &model_image,
        samples: &samples,
    };
    let mut file = NamedTempFile::new().unwrap();
    file.write_all(&watch.to_bytes().collect::<Vec<u8>>())
        .unwrap();
    let address = symbol_address(image, "__sheap");
    let path = file.path().display();
    let loader = format!("loader,file={path},addr={address:#x},force-raw=on");
    let line = first_line(image, processor, 10, &["-device", &loader]);
    let printed: Value =
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("`{line}`: {error}"));
    let number = |key: &str| printed[key].as_f64().unwrap();
    let instructions =
        |ticks: f64| (ticks - number("call")) / (INSTRUCTION_S * number("clock_hz")) + 1.0;
    let here = watch.run(&model, |health, model, [x, force]| {
        health.tick(model, *x, *force);
    });
    assert_eq!(
        printed["digest"],
        format!("{:016x}", here.value()),
        "{preset} on {}: the estimates differ from those of this machine",
        processor.title
    );
    Cost {
        mean: instructions(number("sum") / samples.len() as f64),
        most: instructions(number("most")),
        in_c: instructions(number("c_most")),
        model_bytes: number("model_bytes"),
        health_bytes: number("health_bytes"),
    }
}

#[test]
fn a_tick_keeps_its_bound_and_the_bits_of_this_machine() {
    let what = "the health estimator on emulated processors";
    if !have(&[QEMU, ARM_GCC], what) {
        return;
    }
    let presets = ["paper", "in-service", "reduced-vertical", "reduced-lateral"];
    let mut rows = presets.map(|preset| format!("| `{preset}` |"));
    let (mut head, mut rule, mut bytes) = (String::from("|"), String::from("|---|"), String::new());
    for Bound {
        processor,
        instructions,
        in_c,
    } in BOUNDS
    {
        let Some(toolchain) = have_target(processor.target, what) else {
            return;
        };
        let images = xtask::firmware::build(&toolchain, &processor);
        let images = images.unwrap_or_else(|error| panic!("{error}"));
        for (row, preset) in rows.iter_mut().zip(presets) {
            let cost = cost(&images.join("health-cost"), &processor, preset);
            let place = format!("{preset} on {}", processor.title);
            println!(
                "{place}: mean {:.1}, most {:.0}, in C {:.0} instructions",
                cost.mean, cost.most, cost.in_c
            );
            assert!(cost.most.round() <= instructions, "{place}: {}", cost.most);
            assert!(cost.in_c.round() <= in_c, "{place}: {} in C", cost.in_c);
            *row += &format!(" {:.0} | {:.0} | {:.0} |", cost.mean, cost.most, cost.in_c);
            bytes = format!(
                "\nThe constants take {} bytes, the changing state {} bytes.\n",
                cost.model_bytes, cost.health_bytes
            );
        }
        head += &format!(" {}: mean | most | in C: most |", processor.title);
        rule += "---|---|---|";
    }
    let compiler = TargetToolchain::find(CORTEX_M7.target).and_then(|found| found.version());
    let compiler = compiler.unwrap_or_else(|error| panic!("{error}"));
    let table = format!("| {compiler} {head}\n{rule}\n{}\n{bytes}", rows.join("\n"));
    // Another compiler must keep the bound, but its figures may differ.
    if document::blessing() || document::part(DOCUMENT, "cost").contains(&compiler) {
        document::compare_part(DOCUMENT, "cost", &table);
    }
}

/// The firmware's reading from samples sent over the link, including values that no sensor should deliver.
#[test]
fn a_reading_over_the_link_has_the_bits_of_the_desk() {
    let Some(images) = images() else {
        return;
    };
    let link = InTurn::start(&images.join("dashpot-firmware"), &[], None);
    let mut client = Client::new(link, RETRY_LIMITS, 12);
    client.hello().unwrap();
    let checked = damper("in-service", &[]).check().unwrap();
    let model = checked
        .health_model(&HealthSettings::new(60e-6, 60.0), 1e-3)
        .unwrap();
    let slot = 11;
    let none = client.health(slot);
    assert!(matches!(none, Err(LinkError::Refused(Refusal::NoHealth))));
    client.load_health(slot, &model).unwrap();
    let samples = samples("in-service").into_iter().take(21_000);
    let samples: Vec<HealthSample> = samples
        .map(|[x0, x1, x2, x3, f0, f1, f2, f3]| HealthSample {
            displacement_m: f32::from_le_bytes([x0, x1, x2, x3]),
            force_n: f32::from_le_bytes([f0, f1, f2, f3]),
        })
        .collect();
    let history = watch(
        &model,
        samples
            .iter()
            .map(|sample| (f64::from(sample.displacement_m), f64::from(sample.force_n))),
        7.0,
    );
    for (part, expected) in samples.chunks(7000).zip(&history.readings) {
        client.measure(slot, part).unwrap();
        assert_eq!(client.health(slot).unwrap(), expected.reading);
    }
    let last = history.readings[2].reading;
    assert!(
        last.rejected > 0 && last.status.contains(HealthStatus::RESTARTED),
        "{last:?}"
    );
    assert_eq!(client.clear_health(slot).unwrap(), last);
    let others = client.health(0);
    assert!(matches!(others, Err(LinkError::Refused(Refusal::NoHealth))));
}
