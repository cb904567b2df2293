//! Experiments on emulated processors: runs the measurements of `firmware/src/bin/step_cost.rs`, and the same motion on
//! this machine.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

use dashpot_core::{Damper, step_bank};
use dashpot_experiment::Experiment as Bytes;
use dashpot_testbench::excitation::Excitation;
use object::{Object, ObjectSymbol};
use serde::Deserialize;
use tempfile::NamedTempFile;
use xtask::processor::Processor;

use crate::damper;

/// Step of every experiment (s).
const STEP_S: f64 = 1e-3;

/// Number of steps of one damper for a digest.
pub const STEPS: u32 = 1_000_000;
/// Number of steps of a bank for a digest.
pub const BANK_STEPS: u32 = 100_000;

/// Elements: name in tables, preset, and `true` for a bank of it.
pub const ELEMENTS: [(&str, &str, bool); 3] = [
    ("physical", "in-service", false),
    ("reduced", "reduced-vertical", false),
    ("bank", "in-service", true),
];

/// Time of an instruction under `-icount shift=10` (s).
const INSTRUCTION_S: f64 = 1024e-9;

type Image = [u8; Damper::<f32>::IMAGE_BYTES];

/// A damper driven by an excitation, which runs back and forth until the steps are done.
pub struct Experiment {
    /// Name of the element.
    pub element: &'static str,
    /// The motion.
    pub excitation: Excitation,
    /// True for a bank, false for one damper.
    pub bank: bool,
    /// Steps.
    pub steps: u32,
    damper: Damper<f32>,
    other: Damper<f32>,
    motion_m: Vec<[u8; 4]>,
}

/// Output of the target, in clock ticks and bytes.
#[derive(Deserialize)]
struct Printed {
    clock_hz: f64,
    call: f64,
    known: f64,
    least: f64,
    most: f64,
    sum: f64,
    digest: String,
    first: f64,
    held: f64,
    limited: f64,
    jumped: f64,
    swapped: f64,
    stack_bytes: f64,
    damper_bytes: f64,
    state_bytes: f64,
    load_slice: f64,
    c_damper_init: f64,
    c_step: f64,
    c_step_bank: f64,
    c_set_clearance: f64,
    c_check_slice: f64,
}

/// Results of an experiment on the target, in instructions per call if not stated otherwise.
#[derive(Clone, Debug)]
pub struct Found {
    /// Mean over all steps.
    pub mean: f64,
    /// Minimum.
    pub least: f64,
    /// Maximum.
    pub most: f64,
    /// First step after a reset.
    pub first: f64,
    /// Input held.
    pub held: f64,
    /// Input limited to the maximum rate.
    pub limited: f64,
    /// Input too far away to catch up with, under force.
    pub jumped: f64,
    /// Damper swapped.
    pub swapped: f64,
    /// Slice of loading a damper, maximum.
    pub load_slice: f64,
    /// Function of 101 instructions, including its return.
    pub known: f64,
    /// Maximum stack of the first step and the exceptional ones (bytes).
    pub stack_bytes: f64,
    /// Size of a damper (bytes).
    pub damper_bytes: f64,
    /// Size of a state (bytes).
    pub state_bytes: f64,
    /// C library functions: name without prefix, instructions.
    pub library: [(&'static str, f64); 5],
    /// FNV-1a (64 bit) of the force bits.
    pub digest: String,
}

/// An emulator with an image. It ends when dropped.
pub struct Emulator {
    child: Child,
    output: BufReader<ChildStdout>,
}

impl Emulator {
    /// Starts an image in an emulator where an instruction takes 2^`shift` ns.
    pub fn start(image: &Path, processor: &Processor, shift: u32, arguments: &[&str]) -> Self {
        let icount = format!("shift={shift}");
        Self::start_with(
            image,
            processor,
            &[&["-icount", &icount], arguments].concat(),
        )
    }

    /// Starts an image in an emulator with these arguments.
    pub fn start_with(image: &Path, processor: &Processor, arguments: &[&str]) -> Self {
        let mut command = Command::new("qemu-system-arm");
        command
            .args(["-M", processor.board, "-cpu", processor.emulated_cpu])
            .arg("-nographic")
            .args(["-monitor", "none", "-serial", "stdio"])
            .args(arguments)
            .arg("-kernel")
            .arg(image);
        let mut child = command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .expect("qemu-system-arm starts");
        let output = BufReader::new(child.stdout.take().expect("it is piped"));
        Self { child, output }
    }

    /// Waits for the next line that the image prints on its UART.
    pub fn line(&mut self) -> String {
        let mut line = String::new();
        self.output
            .read_line(&mut line)
            .expect("the target prints text");
        line
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Returns the first line that an image prints on its UART; see [`Emulator`].
pub fn first_line(image: &Path, processor: &Processor, shift: u32, arguments: &[&str]) -> String {
    Emulator::start(image, processor, shift, arguments).line()
}

/// Every experiment, with a fraction of the steps.
pub fn experiments(fraction: f64) -> Vec<Experiment> {
    let build = |preset| damper(preset, &[]).build(STEP_S).expect("a preset");
    let mut all = Vec::new();
    for (element, preset, bank) in ELEMENTS {
        for excitation in Excitation::ALL {
            let motion_m = excitation.displacements_m(STEP_S);
            let steps = f64::from(if bank { BANK_STEPS } else { STEPS });
            all.push(Experiment {
                element,
                excitation,
                bank,
                steps: (steps * fraction) as u32,
                damper: build(preset),
                other: build("reduced-lateral"),
                motion_m: motion_m.iter().map(|x| (*x as f32).to_le_bytes()).collect(),
            });
        }
    }
    all
}

impl Experiment {
    fn bytes<'a>(&'a self, [damper, other]: &'a [Image; 2]) -> Bytes<'a> {
        Bytes {
            bank: self.bank,
            steps: self.steps,
            damper,
            other,
            motion_m: &self.motion_m,
        }
    }

    /// Writes the experiment to a file in the format that processors read.
    fn file(&self) -> NamedTempFile {
        let images = [&self.damper, &self.other].map(Damper::<f32>::to_image);
        let bytes: Vec<u8> = self.bytes(&images).to_bytes().collect();
        assert!(Bytes::parse(&bytes).is_some(), "the processors take it");
        let mut file = NamedTempFile::new().expect("a writable folder");
        file.write_all(&bytes).expect("room on the disk");
        file
    }

    /// Runs the experiment on an emulated processor with the image `step-cost`.
    pub fn on(&self, processor: &Processor, image: &Path) -> Found {
        let file = self.file();
        let address = symbol_address(image, "__sheap");
        let path = file.path().display();
        let loader = format!("loader,file={path},addr={address:#x},force-raw=on");
        let line = first_line(image, processor, 10, &["-device", &loader]);
        let printed: Printed = serde_json::from_str(&line)
            .unwrap_or_else(|error| panic!("the target printed `{line}`: {error}"));
        printed.found(self.steps)
    }

    /// Digest that the program `dashpot-experiment` prints for the experiment's file.
    pub fn digest_by(&self, program: &mut Command) -> String {
        let file = self.file();
        let output = program.arg(file.path()).output().expect("it starts");
        let printed = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{program:?}: {output:?}");
        printed.trim().to_owned()
    }

    /// Digest of the same steps on this machine.
    pub fn digest_here(&self) -> String {
        let images = [&self.damper, &self.other].map(Damper::<f32>::to_image);
        let digest = self.bytes(&images).run(
            &self.damper,
            |damper, state, displacement| damper.step(state, displacement),
            step_bank,
        );
        format!("{:016x}", digest.value())
    }
}

/// Address of a symbol of an image.
pub fn symbol_address(image: &Path, name: &str) -> u64 {
    let bytes = std::fs::read(image).expect("an image");
    let file = object::File::parse(&*bytes).expect("an ELF file");
    let symbol = file.symbols().find(|symbol| symbol.name() == Ok(name));
    symbol
        .unwrap_or_else(|| panic!("{image:?} has no {name}"))
        .address()
}

impl Printed {
    fn found(self, steps: u32) -> Found {
        let ticks_per_instruction = INSTRUCTION_S * self.clock_hz;
        // The subtracted `call` is the time of calling a function of one instruction.
        let exact = |ticks: f64| (ticks - self.call) / ticks_per_instruction + 1.0;
        let whole = |ticks: f64| exact(ticks).round();
        Found {
            // The two readings of the clock leave an error of a few hundredths of an instruction.
            mean: (10.0 * exact(self.sum / f64::from(steps))).round() / 10.0,
            least: whole(self.least),
            most: whole(self.most),
            first: whole(self.first),
            held: whole(self.held),
            limited: whole(self.limited),
            jumped: whole(self.jumped),
            swapped: whole(self.swapped),
            load_slice: whole(self.load_slice),
            known: whole(self.known),
            stack_bytes: self.stack_bytes,
            damper_bytes: self.damper_bytes,
            state_bytes: self.state_bytes,
            library: [
                ("step", whole(self.c_step)),
                ("step_bank", whole(self.c_step_bank)),
                ("set_clearance", whole(self.c_set_clearance)),
                ("damper_init", whole(self.c_damper_init)),
                ("check_slice", whole(self.c_check_slice)),
            ],
            digest: self.digest,
        }
    }
}
