//! Tests of the health estimator on an emulated Cortex-M7: its results have the bits of this machine, and no tick
//! exceeds its bound.

use std::io::Write;

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
use xtask::processor::CORTEX_M7;
use xtask::target_toolchain::TargetToolchain;

const DOCUMENT: &str = "docs/health.md";
/// Time of an instruction under `-icount shift=10` (s).
const INSTRUCTION_S: f64 = 1024e-9;
/// Maximum instructions of a tick, including the fetch of the sample.
const MAX_INSTRUCTIONS: f64 = 270.0;
/// Maximum for `dashpot_health_tick`, which checks its pointers first; dashpot.h states it.
const MAX_INSTRUCTIONS_IN_C: f64 = 300.0;

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

#[test]
fn a_tick_keeps_its_bound_and_the_bits_of_this_machine() {
    let Some(images) = images() else {
        return;
    };
    let image = images.join("health-cost");
    let mut table = String::new();
    for preset in ["paper", "in-service", "reduced-vertical", "reduced-lateral"] {
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
        let address = symbol_address(&image, "__sheap");
        let path = file.path().display();
        let loader = format!("loader,file={path},addr={address:#x},force-raw=on");
        let line = first_line(&image, &CORTEX_M7, 10, &["-device", &loader]);
        let printed: Value =
            serde_json::from_str(&line).unwrap_or_else(|error| panic!("`{line}`: {error}"));
        let number = |key: &str| printed[key].as_f64().unwrap();
        let instructions =
            |ticks: f64| (ticks - number("call")) / (INSTRUCTION_S * number("clock_hz")) + 1.0;
        let mean = instructions(number("sum") / samples.len() as f64);
        let (least, most) = (instructions(number("least")), instructions(number("most")));
        let c_most = instructions(number("c_most"));
        assert!(
            c_most.round() <= MAX_INSTRUCTIONS_IN_C,
            "{preset}: {c_most} in C"
        );
        println!("{preset}: {least:.0} to {most:.0}, mean {mean:.1} instructions");
        assert!(most.round() <= MAX_INSTRUCTIONS, "{preset}: {most}");
        let here = watch.run(&model, |health, model, [x, force]| {
            health.tick(model, *x, *force);
        });
        assert_eq!(
            printed["digest"],
            format!("{:016x}", here.value()),
            "{preset}: the estimates differ from those of this machine"
        );
        table += &format!("| `{preset}` | {mean:.0} | {most:.0} | {c_most:.0} |\n");
        if preset == "reduced-lateral" {
            let (model, health) = (number("model_bytes"), number("health_bytes"));
            table += &format!(
                "\nThe constants take {model} bytes, the changing state {health} bytes.\n"
            );
        }
    }
    let compiler = TargetToolchain::find(CORTEX_M7.target).and_then(|found| found.version());
    let compiler = compiler.unwrap_or_else(|error| panic!("{error}"));
    let table =
        format!("| {compiler} | instructions, mean | most | C: most |\n|---|---|---|---|\n{table}");
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
