//! Experiments on the emulated Cortex-M7: what `firmware/src/bin/step_cost.rs` measures, and the same
//! motion on this machine.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use dashpot_core::{Damper, step_bank};
use dashpot_hil::excitation::Excitation;
use serde::Deserialize;

use crate::digest::Digest;

/// Step of every experiment (s).
pub const STEP_S: f64 = 1e-3;

/// Dampers in a bank.
pub const BANK: usize = 12;

/// Lanes of a bank run this many ticks apart.
const LAG: usize = 9;

/// Clock ticks of an instruction: 1024 ns each (`-icount shift=10`), 25 ticks a microsecond.
const TICKS_PER_INSTRUCTION: f64 = 25.6;

/// A damper driven over an excitation, to its end and back until the steps are done.
pub struct Experiment<'a> {
    /// The damper.
    pub damper: &'a Damper<f32>,
    /// Another one, swapped in at the end.
    pub other: &'a Damper<f32>,
    /// The motion.
    pub excitation: Excitation,
    /// Whether a bank of [`BANK`] or one damper.
    pub bank: bool,
    /// Steps.
    pub steps: u32,
}

/// What the target printed, in clock ticks and bytes.
#[derive(Deserialize)]
struct Printed {
    call: u64,
    least: u64,
    most: u64,
    sum: u64,
    digest: String,
    single_call: u64,
    known: u64,
    first: u64,
    held: u64,
    swapped: u64,
    stack_bytes: u32,
    damper_bytes: u32,
    state_bytes: u32,
}

/// What an experiment found on the target.
#[derive(Clone, Debug)]
pub struct Found {
    /// Instructions of a call: mean, fewest, most.
    pub mean: f64,
    /// Fewest.
    pub least: f64,
    /// Most.
    pub most: f64,
    /// Of the first step after a reset.
    pub first: f64,
    /// Input held.
    pub held: f64,
    /// Damper swapped.
    pub swapped: f64,
    /// Of a function of 101 instructions, its return included.
    pub known: f64,
    /// Most stack of these three (bytes).
    pub stack_bytes: u32,
    /// Size of a damper (bytes).
    pub damper_bytes: u32,
    /// Size of a state (bytes).
    pub state_bytes: u32,
    /// FNV-1a (64 bit) of the force bits.
    pub digest: String,
}

/// Ended when dropped.
struct Emulator(Child);

impl Drop for Emulator {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The first line that an image prints on its UART, in an emulator where an instruction takes
/// 2^`shift` ns.
pub fn first_line(image: &Path, shift: u32, arguments: &[&str]) -> String {
    let mut command = Command::new("qemu-system-arm");
    command
        .args(["-M", "mps2-an500", "-cpu", "cortex-m7", "-nographic"])
        .args(["-monitor", "none", "-serial", "stdio"])
        .args(["-icount", &format!("shift={shift}")])
        .args(arguments)
        .arg("-kernel")
        .arg(image);
    let child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .expect("qemu-system-arm starts");
    let mut emulator = Emulator(child);
    let output = emulator.0.stdout.take().expect("it is piped");
    let mut line = String::new();
    BufReader::new(output)
        .read_line(&mut line)
        .expect("the target prints text");
    line
}

impl Experiment<'_> {
    /// Samples of the excitation (m).
    fn motion(&self) -> Vec<f32> {
        let exact = self.excitation.displacements_m(STEP_S);
        assert!(exact.len() <= 100_000, "the target has room for no more");
        exact.iter().map(|x| *x as f32).collect()
    }

    /// Runs on the target: the image `step-cost` in the emulator.
    pub fn on_target(&self, image: &Path) -> Found {
        let mut data = tempfile::NamedTempFile::new().expect("a writable folder");
        let motion = self.motion();
        let words = self
            .other
            .to_words()
            .into_iter()
            .chain(self.damper.to_words());
        let counts = [u32::from(self.bank), self.steps, motion.len() as u32];
        let words = words
            .chain(counts)
            .chain(motion.iter().map(|x| x.to_bits()));
        let bytes: Vec<u8> = words.flat_map(u32::to_le_bytes).collect();
        data.write_all(&bytes).expect("room on the disk");

        let loader = format!(
            "loader,file={},addr=0x20200000,force-raw=on",
            data.path().display()
        );
        let line = first_line(image, 10, &["-device", &loader]);
        let printed: Printed = serde_json::from_str(&line)
            .unwrap_or_else(|error| panic!("the target printed `{line}`: {error}"));
        printed.found(self.steps)
    }

    /// Digest of the same steps on this machine.
    pub fn digest_here(&self) -> String {
        let motion = self.motion();
        let last = motion.len() - 1;
        let at = |step: usize| {
            let place = step % (2 * last);
            motion[place.min(2 * last - place)]
        };
        let mut digest = Digest::default();
        let mut add = |force: f32| digest.add(force.to_bits().to_le_bytes());
        let mut states = std::array::from_fn(|lane| self.damper.at_rest(at(LAG * lane)));
        let mut forces = [0.0; BANK];
        for step in 0..self.steps as usize {
            if self.bank {
                let motion = std::array::from_fn(|lane| at(step + LAG * lane));
                step_bank(&[self.damper; BANK], &mut states, &motion, &mut forces);
                forces.into_iter().for_each(&mut add);
            } else {
                add(self.damper.step(&mut states[0], at(step)));
            }
        }
        format!("{:016x}", digest.value())
    }
}

impl Printed {
    fn found(self, steps: u32) -> Found {
        // The call subtracted is of a function of one instruction.
        let beyond = |ticks: f64, call: u64| (ticks - call as f64) / TICKS_PER_INSTRUCTION + 1.0;
        let whole = |ticks: u64, call| beyond(ticks as f64, call).round();
        Found {
            mean: beyond(self.sum as f64 / f64::from(steps), self.call),
            least: whole(self.least, self.call),
            most: whole(self.most, self.call),
            first: whole(self.first, self.single_call),
            held: whole(self.held, self.single_call),
            swapped: whole(self.swapped, self.single_call),
            known: whole(self.known, self.single_call),
            stack_bytes: self.stack_bytes,
            damper_bytes: self.damper_bytes,
            state_bytes: self.state_bytes,
            digest: self.digest,
        }
    }
}
