//! Tests of the firmware under QEMU: its forces have the host's bits through every fault, and the cost of a tick is
//! within its budget.

use std::fmt::Write as _;
use std::io::Write as _;

use dashpot::in_turn::{InTurn, MAX_ANSWERS, RETRY_LIMITS, images};
use dashpot::target::{first_line, symbol_address};
use dashpot::{damper, document};
use dashpot_core::Damper;
use dashpot_core::health::HealthSettings;
use dashpot_core::link::{Counters, LossOfLink, Reals, Refusal, Request, Response, SafeOutput};
use dashpot_host_link::{
    Bank, Client, FaultRates, FaultyLink, LinkError, Pace, Report, Session, SessionError,
};
use dashpot_testbench::excitation::Excitation;
use object::{Object, ObjectSection, ObjectSymbol};
use tempfile::NamedTempFile;
use xtask::processor::CORTEX_M7;
use xtask::target_toolchain::TargetToolchain;

const LINK: &str = "docs/link.md";
const FIRMWARE: &str = "docs/firmware.md";

/// Instructions allowed for a tick on a 400 MHz core at one per cycle: 3 % at 1 kHz.
const BUDGET_1_KHZ: f64 = 0.03 * 400e6 / 1e3;
/// Maximum instructions of a slice of a load, as stated in docs/link.md.
const MAX_SLICE: f64 = 2082.0;
/// The same for 25 % at 10 kHz.
const BUDGET_10_KHZ: f64 = 0.25 * 400e6 / 10e3;

fn run(image: &str, rates: &str, resets: &'static [u32], ticks: usize) -> Option<Report> {
    let image = images()?.join(image);
    let rates: FaultRates = rates.parse().unwrap();
    let link = FaultyLink::new(InTurn::start(&image, resets, None), rates, 5).unwrap();
    let mut session = Session::open(Client::new(link, RETRY_LIMITS, 1)).unwrap();
    let ride = Excitation::Ride.displacements_m(1e-3);
    let mut ride = ride.into_iter().take(ticks);
    let damper = damper("in-service", &["mount.clearance_m=1e-3"]);
    let motion = || Ok::<_, SessionError>(ride.next().map(|x| x as f32));
    let dampers = [damper.build(1e-3).unwrap()];
    let report = session.run(&dampers, motion, &mut Pace::default(), |_| Ok(()));
    Some(report.unwrap())
}

#[test]
fn the_target_has_the_hosts_bits() {
    let Some(report) = run("dashpot-firmware", "drop=0", &[], 2000) else {
        return;
    };
    assert_eq!(
        (report.ticks, report.mismatches, report.state_mismatches),
        (2000, 0, 0)
    );
    assert_eq!(report.target.dampers, 12);
    let instructions = report.instructions.unwrap();
    println!("{instructions:?}");
    assert!(instructions.mean > 12.0 * 50.0 && instructions.max < BUDGET_10_KHZ);
}

#[test]
fn the_target_has_the_hosts_bits_through_every_fault() {
    let faults = "drop=0.01,corrupt=0.02,delay=0.01,duplicate=0.02,reorder=0.01";
    // The resets occur during the steps, during the reload that follows, and late in the run.
    for image in ["dashpot-firmware", "served"] {
        let Some(report) = run(image, faults, &[300, 310, 500], 600) else {
            return;
        };
        assert_eq!(
            (report.ticks, report.mismatches, report.state_mismatches),
            (600, 0, 0),
            "{image}"
        );
        assert!(report.recoveries >= 2, "{image}: {report:?}");
        assert!(report.link_faults.repeated_requests > 0, "{image}");
    }
}

#[test]
fn dampers_that_are_stepped_one_tick_at_a_time_have_the_hosts_bits() {
    let Some(images) = images() else {
        return;
    };
    // After a reset during the steps, two dampers outside a vehicle continue as before.
    let link = InTurn::start(&images.join("dashpot-firmware"), &[150], None);
    let session = Session::open(Client::new(link, RETRY_LIMITS, 4)).unwrap();
    let dampers: [Damper<f32>; 2] =
        ["reduced-lateral", "in-service"].map(|name| damper(name, &[]).build(1e-3).unwrap());
    let mut bank = Bank::start(session, &dampers).unwrap();
    let mut states = [0, 1].map(|slot: usize| dampers[slot].at_rest(0.0));
    for x in Excitation::Ride.displacements_m(1e-3).iter().take(300) {
        let displacements_m = [*x as f32, -*x as f32];
        let found_n = bank.step(&displacements_m).unwrap();
        for slot in [0, 1] {
            let expected_n = dampers[slot].step(&mut states[slot], displacements_m[slot]);
            assert_eq!(found_n[slot].to_bits(), expected_n.to_bits());
        }
    }
    let report = bank.finish().unwrap();
    assert_eq!((report.ticks, report.mismatches), (300, 0));
    assert!(report.recoveries > 0, "{report:?}");
}

#[test]
fn the_free_running_target_loses_the_link_and_outputs_zero() {
    let Some(images) = images() else {
        return;
    };
    let link = InTurn::start(&images.join("dashpot-firmware"), &[], None);
    let mut client = Client::new(link, RETRY_LIMITS, 9);
    client.hello().unwrap();
    let lose_after = |after_ticks| {
        Request::LossOfLink(LossOfLink {
            after_ticks,
            output: SafeOutput::RampToZero { ticks: 10 },
        })
    };
    // With this limit the link is not lost, however slow this host is.
    client.request(&lose_after(u32::MAX)).unwrap();
    let all = |x: f32| -> Reals { (0..12).map(|_| x).collect() };
    let run = Request::Run {
        displacements_m: all(0.0),
    };
    client.request(&run).unwrap();
    // The dampers move back and forth with every answer, so that forces occur; the target counts its own ticks.
    let (mut tick, mut x, mut moved) = (0, 0.0, false);
    for answer in 0..MAX_ANSWERS {
        if tick >= 100 && moved {
            break;
        }
        x += if answer % 100 < 50 { 0.2e-3 } else { -0.2e-3 };
        let displace = Request::Displace {
            displacements_m: all(x),
        };
        let Ok(Response::Forces(forces)) = client.request(&displace) else {
            panic!("no forces after tick {tick}");
        };
        assert!(forces.tick >= tick);
        tick = forces.tick;
        moved |= forces.forces_n.iter().any(|force| *force > 100.0);
    }
    assert!(tick >= 100 && moved, "{tick}");
    // Requests for counters carry no displacement, so the link is lost.
    client.request(&lose_after(200)).unwrap();
    let mut counters = Counters::default();
    for _ in 0..MAX_ANSWERS {
        let Ok(Response::Counters(now)) = client.request(&Request::Counters) else {
            panic!("no counters");
        };
        counters = now;
        if counters.link_losses > 0 {
            break;
        }
    }
    assert_eq!((counters.link_losses, counters.overruns), (1, 0));
    let displace = Request::Displace {
        displacements_m: all(x),
    };
    let refused = client.request(&displace);
    assert!(matches!(
        refused,
        Err(LinkError::Refused(Refusal::LinkLost))
    ));
    let Ok(Response::Forces(forces)) = client.request(&run) else {
        panic!("no forces");
    };
    assert_eq!((forces.tick, &forces.forces_n), (0, &all(0.0)));
    assert_eq!(client.request(&Request::Stop).unwrap(), Response::Done);
}

#[test]
fn a_tick_with_everything_the_link_takes_keeps_the_budget() {
    let Some(images) = images() else {
        return;
    };
    let image = images.join("link-cost");
    let mut model = NamedTempFile::new().unwrap();
    let settings = HealthSettings::new(60e-6, 60.0);
    let checked = damper("in-service", &[]).check().unwrap();
    let built = checked.health_model(&settings, 1e-3).unwrap();
    model.write_all(&built.to_image()).unwrap();
    let address = symbol_address(&image, "__sheap");
    let path = model.path().display();
    let loader = format!("loader,file={path},addr={address:#x},force-raw=on");
    let printed = first_line(&image, &CORTEX_M7, 0, &["-device", &loader]);
    let printed: serde_json::Value = serde_json::from_str(&printed).unwrap();
    let number = |key: &str| printed[key].as_f64().unwrap();
    let requests = number("requests");
    assert_eq!(number("accepted"), requests + 1.0, "hello and every step");
    let instructions_per_clock_tick = 1e9 / number("clock_hz");
    let mean = number("clock_ticks") * instructions_per_clock_tick / requests;
    let most = number("most_clock_ticks") * instructions_per_clock_tick;
    assert!(most <= BUDGET_1_KHZ, "{most}");
    assert!(most <= BUDGET_10_KHZ, "{most}");
    let limited = number("limited_clock_ticks") * instructions_per_clock_tick;
    assert!(most < limited && limited <= BUDGET_1_KHZ, "{limited}");
    assert_eq!(
        number("health_accepted"),
        1001.0,
        "a model, 500 requests of samples, 500 readings"
    );
    let [slice, measure, reading] = ["health_slice", "health_measure", "health_reading"]
        .map(|key| number(key) * instructions_per_clock_tick);
    assert!(slice <= MAX_SLICE, "{slice}");
    assert!(
        measure.max(reading) <= BUDGET_10_KHZ,
        "{measure}, {reading}"
    );
    let [bytes_in, bytes_out] = ["bytes_in", "bytes_out"].map(|key| number(key) / requests);
    let compiler = TargetToolchain::find(CORTEX_M7.target).and_then(|found| found.version());
    let compiler = compiler.unwrap_or_else(|error| panic!("{error}"));
    let share = |frequency_hz: f64| 100.0 * most * frequency_hz / 400e6;
    let cost = format!(
        "| {compiler} | |\n|---|---|\n| instructions, mean | {mean:.0} |\n| instructions, most | {most:.0} |\n\
         | instructions if the input of every damper is limited | {limited:.0} |\n\
         | share at 1 kHz, at 10 kHz | {:.1} %, {:.0} % |\n| bytes in, out | {bytes_in:.0}, {bytes_out:.0} |\n\
         | largest slice of loading a health model | {slice:.0} |\n\
         | a request with 8 measured samples, maximum | {measure:.0} |\n\
         | a request for a health reading, maximum | {reading:.0} |\n",
        share(1e3),
        share(1e4),
    );
    let memory = memory(&printed["device_bytes"], &printed["watching_device_bytes"]);
    // Another compiler must keep the budget, but its figures may differ.
    if document::blessing() || document::part(LINK, "cost").contains(&compiler) {
        document::compare_part(LINK, "cost", &cost);
        document::compare_part(FIRMWARE, "memory", &memory);
    }
}

/// RAM of devices with 1, 4, 12 and 16 dampers, as a table.
fn memory(device_bytes: &serde_json::Value, watching: &serde_json::Value) -> String {
    let mut table =
        String::from("| dampers | bytes of the device | with health of each |\n|---|---|---|\n");
    let numbers = |value: &serde_json::Value| {
        let numbers = value.as_array().expect("a number for each bank");
        numbers.clone()
    };
    let rows = numbers(device_bytes).into_iter().zip(numbers(watching));
    for (dampers, (bytes, watching)) in [1, 4, 12, 16].iter().zip(rows) {
        writeln!(table, "| {dampers} | {bytes} | {watching} |").expect("text grows");
    }
    table
}

/// The memory map provides exactly the documented memory; the other tests of this file run in it.
#[test]
fn the_map_has_exactly_the_documented_memory() {
    let kilobytes = |region: &str| -> u32 {
        let map = document::read("memory.x");
        let line = map.lines().find(|line| line.trim().starts_with(region));
        let length = line.and_then(|line| line.split("LENGTH = ").nth(1));
        let length = length.and_then(|length| length.trim_end().strip_suffix('K'));
        length
            .and_then(|k| k.parse().ok())
            .unwrap_or_else(|| panic!("memory.x: no {region} in K"))
    };
    let (stack, ram) = (kilobytes("STACK"), kilobytes("RAM"));
    let stated = format!(
        "{} KiB of RAM: {stack} KiB of stack and {ram} KiB",
        stack + ram
    );
    assert!(
        document::read(FIRMWARE).contains(&stated),
        "{FIRMWARE}: {stated}"
    );
    let Some(images) = images() else {
        return;
    };
    let bytes = std::fs::read(images.join("dashpot-firmware")).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    let size = |name: &str| {
        file.section_by_name(name)
            .map_or(0, |section| section.size())
    };
    let used = size(".data") + size(".bss") + size(".uninit");
    let room = 1024 * u64::from(ram);
    assert!(used <= room && used + 1024 > room, "{used} bytes of {room}");
    assert_eq!(
        size(".data"),
        0,
        "the bank takes no flash beside the dampers themselves"
    );
    let panics: Vec<&str> = file
        .symbols()
        .filter_map(|symbol| symbol.name().ok())
        .filter(|name| name.contains("panic"))
        .collect();
    assert_eq!(panics, [""; 0], "panics in the image");
}
