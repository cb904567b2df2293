//! Exports dampers as C without a library, compiles them, and runs them in parallel with the core.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use dashpot_core::{Damper, DamperState, SavedStateError};
use dashpot_export::{Provenance, Word, standalone_header, standalone_source};
use dashpot_files::Scalar;

use crate::controller::succeed;
use crate::memory::{self, PlainData};

/// Program that reads requests ([`Request`]) and answers them.
const DRIVER: &str = include_str!("standalone/driver.c");

/// A request to a damper and its state.
#[derive(Clone, Debug)]
pub enum Request<T> {
    /// Put the state at rest at a displacement (m).
    AtRest(T),
    /// Step to a displacement (m).
    Step(T),
    /// Set another clearance (m).
    SetClearance(T),
    /// Carry the state over to the damper.
    Adopt,
    /// Restore the saved state.
    Restore(Vec<u8>),
    /// Damage memory: replace the state's bytes with these.
    Overwrite(Vec<u8>),
    /// Clear the status.
    ClearStatus,
}

/// Result of a request: the code, the returned value, and the state, both in memory and saved.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Value of the C enum `prefix_result`.
    pub code: u8,
    /// Bits of the returned value and of the four values of the state, in memory and saved; all NaNs are equal.
    pub numbers: [u64; 9],
    /// Revision, status and counter, in memory and saved.
    pub rest: [[u8; 8]; 2],
}

/// A scalar type whose dampers are exported and stepped.
pub trait Exported: Word {
    /// Result of [`Damper::state_from_bytes`] for this scalar, as a C code.
    fn restore(damper: &Damper<Self>, bytes: &[u8]) -> Result<DamperState<Self>, u8>;
    /// Bytes of a value as stored in memory.
    fn bytes(self) -> Vec<u8>;
    /// Zero-extended bits of a value from its bytes.
    fn bits(bytes: &[u8]) -> u64;
}

macro_rules! exported {
    ($float:ident, $word:ident) => {
        impl Exported for $float {
            fn restore(damper: &Damper<Self>, bytes: &[u8]) -> Result<DamperState<Self>, u8> {
                let bytes = bytes.try_into().expect("a state's bytes");
                damper.state_from_bytes(bytes).map_err(|error| match error {
                    SavedStateError::Revision { .. } => 2,
                    _ => 3,
                })
            }
            fn bytes(self) -> Vec<u8> {
                self.to_ne_bytes().into()
            }
            fn bits(bytes: &[u8]) -> u64 {
                let number = Self::from_ne_bytes(bytes.try_into().expect("a number's bytes"));
                if number.is_nan() {
                    u64::MAX
                } else {
                    u64::from(number.to_bits())
                }
            }
        }
    };
}

exported!(f32, u32);
exported!(f64, u64);

/// Writes `name.c` and `name.h` to a folder and returns the path of the source.
pub fn export<T: Word>(folder: &Path, name: &str, damper: &Damper<T>) -> PathBuf {
    let provenance = Provenance {
        damper: name,
        step_us: 1000.0,
        command: "a test",
    };
    let constant = name.to_uppercase();
    let header = standalone_header(&constant, damper, &provenance).expect("a name");
    let included = format!("{name}.h");
    let source =
        standalone_source(&constant, damper, &provenance, Some(&included)).expect("a name");
    let file = folder.join(name).with_extension("c");
    std::fs::write(&file, source).expect("a writable folder");
    std::fs::write(file.with_extension("h"), header).expect("a writable folder");
    file
}

/// Builds the program of [`DRIVER`] for a damper, in a folder, with the given compiler command.
pub fn driver<T: Word>(damper: &Damper<T>, compiler: &mut Command, folder: &Path) -> PathBuf {
    let source = export(folder, "damper", damper);
    let main = folder.join("driver.c");
    let text = DRIVER
        .replace("prefix_", "damper_")
        .replace("PREFIX_", "DAMPER_");
    std::fs::write(&main, text).expect("a writable folder");
    let program = folder.join("driver");
    succeed(compiler.arg(source).arg(main).arg("-o").arg(&program));
    program
}

/// Answers of the program of [`driver`].
pub fn answers<T: Exported>(program: &Path, requests: &[Request<T>]) -> Vec<Answer> {
    let mut child = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut input = child.stdin.take().expect("it is piped");
    let state_bytes = size_of::<DamperState<T>>();
    let mut asked = Vec::new();
    for request in requests {
        let (kind, mut payload) = match request {
            Request::AtRest(number) => (0, number.bytes()),
            Request::Step(number) => (1, number.bytes()),
            Request::SetClearance(number) => (2, number.bytes()),
            Request::Adopt => (3, Vec::new()),
            Request::Restore(bytes) => (4, bytes.clone()),
            Request::Overwrite(bytes) => (5, bytes.clone()),
            Request::ClearStatus => (6, Vec::new()),
        };
        payload.resize(state_bytes, 0);
        asked.push(kind);
        asked.extend(payload);
    }
    let mut printed = Vec::new();
    std::thread::scope(|scope| {
        scope.spawn(move || input.write_all(&asked).expect("it reads"));
        let mut output = child.stdout.take().expect("it is piped");
        output.read_to_end(&mut printed).expect("it prints");
    });
    assert!(child.wait().expect("it ends").success(), "{program:?}");
    let length = 1 + size_of::<T>() + 2 * state_bytes;
    assert_eq!(printed.len(), length * requests.len(), "{program:?}");
    printed.chunks(length).map(Answer::parse::<T>).collect()
}

impl Answer {
    fn parse<T: Exported>(bytes: &[u8]) -> Self {
        let real = size_of::<T>();
        let (returned, states) = bytes[1..].split_at(real);
        let (memory, saved) = states.split_at(4 * real + 8);
        let reals = returned.chunks(real);
        let reals = reals
            .chain(memory[..4 * real].chunks(real))
            .chain(saved[..4 * real].chunks(real));
        let numbers: Vec<u64> = reals.map(T::bits).collect();
        Self {
            code: bytes[0],
            numbers: numbers.try_into().expect("nine numbers"),
            rest: [memory, saved].map(|state| state[4 * real..].try_into().expect("eight bytes")),
        }
    }
}

/// Answers of the core.
pub fn expected<T: Exported>(damper: &Damper<T>, requests: &[Request<T>]) -> Vec<Answer>
where
    DamperState<T>: PlainData,
{
    let mut damper = *damper;
    let mut state = damper.at_rest(T::ZERO);
    let mut answer = |request: &Request<T>| {
        let (mut code, mut number) = (0, T::ZERO);
        match request {
            Request::AtRest(displacement) => state = damper.at_rest(*displacement),
            Request::Step(displacement) => number = damper.step(&mut state, *displacement),
            Request::SetClearance(clearance) => {
                code = u8::from(damper.set_clearance_m(*clearance).is_err());
                number = damper.clearance_m();
            }
            Request::Adopt => {
                damper.adopt(&mut state);
                number = damper.force_limit_n();
            }
            Request::Restore(bytes) => match T::restore(&damper, bytes) {
                Ok(restored) => state = restored,
                Err(refused) => code = refused,
            },
            Request::Overwrite(bytes) => memory::bytes(&mut state).copy_from_slice(bytes),
            Request::ClearStatus => state.clear_status(),
        }
        let mut bytes = vec![code];
        bytes.extend(number.bytes());
        bytes.extend_from_slice(memory::bytes(&mut state));
        bytes.extend(T::state_bytes(&state));
        Answer::parse::<T>(&bytes)
    };
    requests.iter().map(&mut answer).collect()
}

/// Asserts that C and the core answer identically.
pub fn assert_same<T: Exported>(
    damper: &Damper<T>,
    program: &Path,
    requests: &[Request<T>],
    what: &str,
) where
    DamperState<T>: PlainData,
{
    let pairs = answers(program, requests)
        .into_iter()
        .zip(expected(damper, requests));
    for (index, (found, expected)) in pairs.enumerate() {
        let request = &requests[index];
        let scalar = Scalar::of::<T>();
        assert_eq!(
            found, expected,
            "{what}, {scalar}: request {index}, {request:?}"
        );
    }
}
