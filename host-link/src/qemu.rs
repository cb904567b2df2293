//! A target in an emulator that this process starts and stops.

use std::io::{self, ErrorKind, Read};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::emulator_error::EMULATOR;
use super::{EmulatorError, Link, LinkError, Tcp};
use crate::child::ChildProcess;
use dashpot_files::FileError;

/// Firmware image that `cargo build --release` in `firmware/` creates.
pub const DEFAULT_IMAGE: &str = "firmware/target/thumbv7em-none-eabihf/release/dashpot-firmware";

/// Time limit for starting the emulator, long enough for a busy machine. An emulator that exits is detected at once.
const START_TIMEOUT: Duration = Duration::from_secs(60);
/// With `-icount shift=0`, one instruction takes one nanosecond of target time.
const INSTRUCTIONS_PER_S: f64 = 1e9;

/// QEMU with a Cortex-M7 board (mps2-an500). Its UART is the link. The emulator is ended when dropped.
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
    /// The file is not an image, or the emulator is not installed or ends at once.
    pub fn start(image: &Path) -> Result<Self, LinkError> {
        Self::start_with_outputs(image, None)
    }

    /// Like [`Qemu::start`], and writes the target's outputs, which its second UART sends, to the file `outputs`.
    ///
    /// # Errors
    /// The same as for [`Qemu::start`].
    pub fn start_with_outputs(image: &Path, outputs: Option<&Path>) -> Result<Self, LinkError> {
        check_image(image)?;
        let (emulator, link) = launch(image, outputs)?;
        Ok(Self {
            emulator,
            link,
            image: image.to_owned(),
            outputs: outputs.map(Path::to_owned),
        })
    }
}

impl Link for Qemu {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.link
            .send(bytes)
            .map_err(|error| self.emulator.explain(error))
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        self.link
            .receive(buffer, timeout)
            .map_err(|error| self.emulator.explain(error))
    }

    fn reset_target(&mut self) -> Result<(), LinkError> {
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
    /// Returns how the emulator ended if this broke the link, otherwise `error`.
    fn explain(&self, error: LinkError) -> LinkError {
        // The process may end shortly after its socket closes.
        let deadline = Instant::now() + Duration::from_millis(200);
        while Instant::now() < deadline {
            if let Some(ended) = self.ended() {
                return ended.into();
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        error
    }

    /// Returns the exit status and standard error if the emulator has ended.
    fn ended(&self) -> Option<EmulatorError> {
        let status = self.0.ended()?;
        let message = match self.0.errors(2000).trim() {
            "" => String::new(),
            text => format!("; its output: {text}"),
        };
        Some(EmulatorError::Ended { status, message })
    }
}

/// Checks that the file is an image for this target, because the emulator would run any file.
fn check_image(image: &Path) -> Result<(), EmulatorError> {
    let mut start = [0; 20];
    let read = std::fs::File::open(image).and_then(|mut file| file.read_exact(&mut start));
    match read {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            Err(EmulatorError::NoImage(image.to_owned()))
        }
        Err(error) if error.kind() != ErrorKind::UnexpectedEof => {
            Err(FileError::read(image, error).into())
        }
        // ELF, 32 bit, little-endian; machine 40 is Arm (System V ABI, ELF header).
        Ok(()) if start[..6] == *b"\x7fELF\x01\x01" && start[18..] == [40, 0] => Ok(()),
        _ => Err(FileError::in_file(
            image,
            "not a firmware image: expected a 32-bit little-endian ELF file for Arm",
        )
        .into()),
    }
}

fn launch(image: &Path, outputs: Option<&Path>) -> Result<(Emulator, Tcp), LinkError> {
    let (listener, port) = listen().map_err(EmulatorError::Port)?;
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
        ErrorKind::NotFound => EmulatorError::NotInstalled,
        _ => EmulatorError::Start(error),
    })?;
    let emulator = Emulator(child);
    let stream = accept(&listener, &emulator)?;
    let link = Tcp::over(stream, EMULATOR.into())?;
    Ok((emulator, link))
}

/// Opens a local port and returns its number.
fn listen() -> io::Result<(TcpListener, u16)> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
    listener.set_nonblocking(true)?;
    let port = listener.local_addr()?.port();
    Ok((listener, port))
}

fn accept(listener: &TcpListener, emulator: &Emulator) -> Result<TcpStream, EmulatorError> {
    let deadline = Instant::now() + START_TIMEOUT;
    loop {
        match listener.accept() {
            Ok((stream, _)) => {
                stream
                    .set_nonblocking(false)
                    .map_err(EmulatorError::SerialLine)?;
                return Ok(stream);
            }
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(error) => return Err(EmulatorError::SerialLine(error)),
        }
        if let Some(ended) = emulator.ended() {
            return Err(ended);
        }
        if Instant::now() > deadline {
            return Err(EmulatorError::TimedOut {
                seconds: START_TIMEOUT.as_secs(),
            });
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}
