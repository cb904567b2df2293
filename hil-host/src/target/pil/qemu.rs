//! A target in an emulator that this process starts and ends.

use std::io::{ErrorKind, Read};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::{Link, Tcp};
use crate::error::{Failure, Outcome};
use crate::target::child::ChildProcess;

/// The firmware as `cargo build --release` in `firmware/` leaves it.
pub const DEFAULT_IMAGE: &str = "firmware/target/thumbv7em-none-eabihf/release/dashpot-firmware";
const EMULATOR: &str = "qemu-system-arm";
/// A busy machine starts it late; one that ends is noticed at once.
const START_TIMEOUT: Duration = Duration::from_secs(60);
/// With `-icount shift=0` an instruction takes a nanosecond of the target's time.
const INSTRUCTIONS_PER_S: f64 = 1e9;

/// QEMU with a Cortex-M7 board (mps2-an500) whose UART is the link. Ended when dropped.
#[derive(Debug)]
pub struct Qemu {
    emulator: Emulator,
    link: Tcp,
    image: PathBuf,
    outputs: Option<PathBuf>,
}

#[derive(Debug)]
struct Emulator(ChildProcess);

impl Qemu {
    /// Starts the emulator with `image`, an ELF file for Arm.
    ///
    /// # Errors
    /// The image is none, the emulator is not installed or ends at once.
    pub fn start(image: &Path) -> Outcome<Self> {
        Self::start_with_outputs(image, None)
    }

    /// As [`Qemu::start`]; what the target's second UART sends, its outputs, goes to the file.
    ///
    /// # Errors
    /// As [`Qemu::start`].
    pub fn start_with_outputs(image: &Path, outputs: Option<&Path>) -> Outcome<Self> {
        check_image(image)?;
        let (emulator, link) = launch(image, outputs)?;
        Ok(Self {
            emulator,
            link,
            image: image.to_owned(),
            outputs: outputs.map(Path::to_owned),
        })
    }

    /// Process id of the emulator.
    pub fn process_id(&self) -> u32 {
        self.emulator.0.id()
    }
}

impl Link for Qemu {
    fn send(&mut self, bytes: &[u8]) -> Outcome<()> {
        self.link
            .send(bytes)
            .map_err(|failure| self.emulator.explain(failure))
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Outcome<usize> {
        self.link
            .receive(buffer, timeout)
            .map_err(|failure| self.emulator.explain(failure))
    }

    fn reset_target(&mut self) -> Outcome<()> {
        (self.emulator, self.link) = launch(&self.image, self.outputs.as_deref())?;
        Ok(())
    }

    fn can_reset(&self) -> bool {
        true
    }

    fn instructions_per_s(&self) -> Option<f64> {
        Some(INSTRUCTIONS_PER_S)
    }
}

impl Emulator {
    /// How the emulator ended, when that is why the link broke.
    fn explain(&self, failure: Failure) -> Failure {
        // It may need a moment to end after its socket did.
        let deadline = Instant::now() + Duration::from_millis(200);
        while Instant::now() < deadline {
            if let Some(status) = self.0.ended() {
                return Failure::new(format!("{EMULATOR} ended: {status}{}", self.complaint()));
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        failure
    }

    /// What it wrote to its standard error.
    fn complaint(&self) -> String {
        match self.0.errors(2000).trim() {
            "" => String::new(),
            text => format!("; it said: {text}"),
        }
    }
}

/// The emulator takes any file and runs it, so what is no image for this target is refused here.
fn check_image(image: &Path) -> Outcome<()> {
    let mut start = [0; 20];
    let read = std::fs::File::open(image).and_then(|mut file| file.read_exact(&mut start));
    match read {
        Err(error) if error.kind() == ErrorKind::NotFound => Err(Failure::in_file(
            image,
            "no firmware image there; build it with `cargo xtask firmware`, or name one with \
             --link qemu:IMAGE",
        )),
        Err(error) if error.kind() != ErrorKind::UnexpectedEof => {
            Err(Failure::in_file(image, format!("cannot read: {error}")))
        }
        // ELF, 32 bit, little-endian; machine 40 is Arm (System V ABI, ELF header).
        Ok(()) if start[..6] == *b"\x7fELF\x01\x01" && start[18..] == [40, 0] => Ok(()),
        _ => Err(Failure::in_file(
            image,
            "no firmware image: must be a 32-bit little-endian ELF file for Arm",
        )),
    }
}

fn launch(image: &Path, outputs: Option<&Path>) -> Outcome<(Emulator, Tcp)> {
    let failed = |error: std::io::Error| Failure::new(format!("cannot open a local port: {error}"));
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).map_err(failed)?;
    listener.set_nonblocking(true).map_err(failed)?;
    let port = listener.local_addr().map_err(failed)?.port();
    let mut command = Command::new(EMULATOR);
    command
        .args(["-M", "mps2-an500", "-cpu", "cortex-m7", "-nographic"])
        .args(["-monitor", "none", "-icount", "shift=0"])
        .arg("-serial")
        .arg(format!("tcp:127.0.0.1:{port},nodelay=on"))
        .arg("-serial")
        .arg(outputs.map_or("null".into(), |file| format!("file:{}", file.display())))
        .arg("-kernel")
        .arg(image)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let child = ChildProcess::start(&mut command).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Failure::new(format!(
            "{EMULATOR} is not installed; on Debian and Ubuntu: apt-get install qemu-system-arm"
        )),
        _ => Failure::new(format!("cannot start {EMULATOR}: {error}")),
    })?;
    let emulator = Emulator(child);
    let stream = accept(&listener, &emulator)?;
    let link = Tcp::over(stream, EMULATOR.into())?;
    Ok((emulator, link))
}

fn accept(listener: &TcpListener, emulator: &Emulator) -> Outcome<TcpStream> {
    let deadline = Instant::now() + START_TIMEOUT;
    loop {
        match listener.accept() {
            Ok((stream, _)) => {
                stream
                    .set_nonblocking(false)
                    .map_err(|error| Failure::new(format!("{EMULATOR}: {error}")))?;
                return Ok(stream);
            }
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(error) => return Err(Failure::new(format!("{EMULATOR}: {error}"))),
        }
        if let Some(status) = emulator.0.ended() {
            let complaint = emulator.complaint();
            return Err(Failure::new(format!(
                "{EMULATOR} ended: {status}{complaint}"
            )));
        }
        if Instant::now() > deadline {
            return Err(Failure::new(format!(
                "{EMULATOR} did not open its serial line within {} s",
                START_TIMEOUT.as_secs()
            )));
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}
