//! Checks that docs/link.md suffices to write a host in another language: its numbers and names are those of the code,
//! its frames are what a device sends, and the client written from it drives a device.

use std::fmt::Write as _;
use std::io::{Read, Write as _};
use std::net::{Ipv4Addr, TcpListener};
use std::process::Command;
use std::time::Duration;

use dashpot::requests::every_request;
use dashpot::signed_image::revise_and_sign;
use dashpot::{damper, document};
use dashpot_core::health::{
    Estimate, Health, HealthImageError, HealthModel, HealthReading, HealthSettings, HealthStatus,
};
use dashpot_core::link::{
    Counters, Forces, FrameReader, Header, MAX_MEASURED, MEASURED_BYTES, PROTOCOL, Parameter,
    PerDamper, RESPONSE_BYTES, Reals, Refusal, Request, Response, SafeOutput, Sample, Samples,
    Scalar, Welcome, request_frame,
};
use dashpot_core::{Damper, ImageError, Status};
use dashpot_host_link::{Desk, Link};
use serde::Serialize;
use xtask::tools::{PYTHON, have};

const LINK: &str = "docs/link.md";

fn desk<const N: usize>(names: [&str; N]) -> Desk<N> {
    Desk::new(names.map(|name| damper(name, &[]).build(1e-3).expect("a preset"))).expect("one step")
}

/// Number that represents an enum variant on the wire.
fn number(choice: &impl Serialize) -> u8 {
    let mut bytes = [0; 64];
    postcard::to_slice(choice, &mut bytes).expect("a short message")[0]
}

/// Names in the rows `| number | name | ...` of the table whose header row names `kind`.
fn rows(kind: &str) -> Vec<(u8, String)> {
    let text = document::read(LINK);
    let header = format!("| # | {kind} |");
    let table = text.lines().skip_while(|line| !line.starts_with(&header));
    let rows = table.skip(2).take_while(|line| line.starts_with('|'));
    rows.map(|row| {
        let mut cells = row.split('|').map(str::trim).skip(1);
        let number = cells.next().and_then(|cell| cell.parse().ok());
        let name = cells.next().map(str::to_owned);
        number.zip(name).unwrap_or_else(|| panic!("{row}"))
    })
    .collect()
}

/// Name of a variant from its debug text: `Step` from `Step { .. }`.
fn name(choice: &impl std::fmt::Debug) -> String {
    let text = format!("{choice:?}");
    let end = text.find(|letter: char| !letter.is_alphanumeric());
    text[..end.unwrap_or(text.len())].to_owned()
}

fn welcome() -> Welcome<'static> {
    Welcome::default()
}

fn numbered<T: Serialize + std::fmt::Debug>(choices: &[T]) -> Vec<(u8, String)> {
    choices
        .iter()
        .map(|choice| (number(choice), name(choice)))
        .collect()
}

#[test]
fn the_numbers_are_those_of_the_code() {
    let requests = every_request(&[], &[], &[], &Reals::new());
    assert_eq!(rows("request"), numbered(&requests));
    let outputs = [
        SafeOutput::Hold,
        SafeOutput::RampToZero { ticks: 0 },
        SafeOutput::Zero,
    ];
    assert_eq!(rows("output"), numbered(&outputs));
    let refusals = [
        Refusal::Corrupt,
        Refusal::Unreadable,
        Refusal::Protocol(0),
        Refusal::NoSession,
        Refusal::OutOfOrder(0),
        Refusal::Tick(0),
        Refusal::Count(0),
        Refusal::Damper(0),
        Refusal::NeedsRebuild,
        Refusal::Range,
        Refusal::Image(ImageError::Magic),
        Refusal::StepSize,
        Refusal::State,
        Refusal::Running,
        Refusal::NotRunning,
        Refusal::LinkLost,
        Refusal::Corrupted(0),
        Refusal::NoHealth,
        Refusal::HealthImage(HealthImageError::Magic),
    ];
    assert_eq!(rows("refusal"), numbered(&refusals));
    let image_errors = [
        ImageError::Length {
            expected: 0,
            found: 0,
        },
        ImageError::Magic,
        ImageError::ByteOrder,
        ImageError::Version(0),
        ImageError::Scalar(0),
        ImageError::Checksum,
        ImageError::Piece(0),
        ImageError::Revision,
        ImageError::Scalars,
    ];
    assert_eq!(rows("image"), numbered(&image_errors));
    let health_image_errors = [
        HealthImageError::Length {
            expected: 0,
            found: 0,
        },
        HealthImageError::Magic,
        HealthImageError::Version(0),
        HealthImageError::Checksum,
        HealthImageError::Values,
    ];
    assert_eq!(rows("model"), numbered(&health_image_errors));
    let answers = [
        Response::Welcome(welcome()),
        Response::Done,
        Response::Forces(Forces::default()),
        Response::Saved {
            tick: 0,
            states: &[],
        },
        Response::Telemetry {
            overwritten: 0,
            samples: Samples::default(),
        },
        Response::Counters(Counters::default()),
        Response::Outputs {
            outputs_n: Reals::new(),
        },
        Response::Status {
            status: PerDamper::new(),
            rejected_inputs: PerDamper::new(),
        },
        Response::Refused(Refusal::State),
        Response::Health(HealthReading::default()),
    ];
    assert_eq!(rows("answer"), numbered(&answers));
    let text = document::read(LINK);
    assert!(text.contains(&format!("This is protocol **{PROTOCOL}**.")));
    let parameters = [
        (Parameter::ClearanceM, "0 `mount.clearance_m`"),
        (Parameter::StiffnessNPerM, "1 `mount.stiffness_n_per_m`"),
        (Parameter::DampingNSPerM, "2 `reduced.damping_n_s_per_m`"),
        (
            Parameter::SaturationVelocityMPerS,
            "3 `reduced.saturation_velocity_m_per_s`",
        ),
        (Parameter::ForceLimitN, "4 `limits.force_n`"),
    ];
    for (parameter, stated) in parameters {
        assert!(stated.starts_with(&number(&parameter).to_string()));
        assert!(text.contains(stated), "{stated}");
    }
    assert_eq!((number(&Scalar::F32), number(&Scalar::F64)), (0, 1));
    let errors = document::read("docs/reference/errors.md");
    for (name, bit) in Status::all().iter_names() {
        let stated = format!("| {} | `{name}` |", bit.bits());
        assert!(errors.contains(&stated), "{stated}");
    }
    for (bit, stated) in [
        (HealthStatus::FLOW, "1 flow"),
        (HealthStatus::STIFFNESS, "2 stiffness"),
        (HealthStatus::CLEARANCE, "4 clearance"),
        (HealthStatus::LITTLE_EXCITATION, "8 too little motion"),
        (HealthStatus::INPUT_REJECTED, "16 a sample"),
        (HealthStatus::RESTARTED, "32 the estimate"),
    ] {
        assert!(stated.starts_with(&format!("{} ", bit.bits())) && text.contains(stated));
    }
    let samples = format!("1 to {MAX_MEASURED} samples of {MEASURED_BYTES} bytes");
    assert!(text.contains(&samples), "{samples}");
    let bytes = format!("{} bytes, whole", HealthModel::IMAGE_BYTES);
    assert!(text.contains(&bytes), "{bytes}");
    // The document must list fields in order, because they have no numbers.
    let in_order = |fields: String| {
        let mut rest = &text[..];
        for field in fields
            .split(['{', ','])
            .filter_map(|field| field.split_once(':'))
        {
            let name = field.0.trim();
            let position = rest.find(name);
            let position = position.unwrap_or_else(|| panic!("{name} is missing, or out of order"));
            rest = &rest[position + name.len()..];
        }
    };
    in_order(format!("{:?}", Counters::default()));
    in_order(format!("{:?}", Sample::default()));
    let reading = format!("{:?}", HealthReading::default());
    // The document describes the fields of an estimate (value and deviation) only once, so they are left out here.
    let estimate = format!("{:?}", Estimate::default());
    in_order(reading.replace(&estimate, "number"));
}

/// Health model of the damper in the worked frames.
fn model() -> HealthModel {
    let checked = damper("reduced-vertical", &[]).check().expect("a preset");
    let settings = HealthSettings::new(20e-6, 20.0);
    checked.health_model(&settings, 1e-3).expect("settings")
}

#[test]
fn the_worked_frames_match_a_device() {
    let mut desk = desk(["reduced-vertical"]);
    let x = |x: f32| [x].into_iter().collect();
    let model = model().to_image();
    let sample = [2e-5_f32.to_le_bytes(), 30_f32.to_le_bytes()].concat();
    let requests = [
        Request::Hello { protocol: PROTOCOL },
        Request::Step {
            tick: 1,
            displacements_m: x(2e-5),
        },
        Request::Set {
            damper: 0,
            parameter: Parameter::ClearanceM,
            value: 1e-3,
        },
        Request::Status,
        Request::LoadHealth {
            damper: 0,
            image: &model,
        },
        Request::Measure {
            damper: 0,
            samples: &sample,
        },
        Request::Health { damper: 0 },
        Request::Stop,
    ];
    let mut table = String::new();
    let hex = |bytes: &[u8]| {
        let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        match &*bytes {
            [.., a, b, c] if bytes.len() > 1000 => {
                let between = bytes.len() - 15;
                format!("{} ({between} bytes) {a} {b} {c}", bytes[..12].join(" "))
            }
            bytes => bytes.join(" "),
        }
    };
    let summary = |request: &Request<'_>| match request {
        Request::LoadHealth { damper, image } => {
            format!(
                "LoadHealth {{ damper: {damper}, image: {} bytes }}",
                image.len()
            )
        }
        request => format!("{request:?}"),
    };
    for (sequence, request) in (1..).zip(&requests) {
        let header = Header {
            session: 4660,
            sequence,
        };
        let frame = request_frame(header, request);
        desk.send(frame.bytes()).expect("a device");
        let mut answer = [0; 1024];
        let count = desk
            .receive(&mut answer, Duration::ZERO)
            .expect("an answer");
        let mut reader = FrameReader::<RESPONSE_BYTES>::new();
        let message = answer[..count].iter().find_map(|byte| {
            let message = reader.push(*byte)?;
            Some(message.expect("a whole frame").bytes.to_vec())
        });
        let message = message.expect("a frame");
        let (found, response): (Header, Response<'_>) =
            postcard::from_bytes(&message).expect("an answer");
        assert_eq!(found, header);
        writeln!(
            table,
            "    session {}, sequence {sequence}: {}",
            header.session,
            summary(request)
        )
        .expect("text");
        writeln!(table, "    {}", hex(frame.bytes())).expect("text");
        writeln!(table, "    -> {response:?}").expect("text");
        writeln!(table, "    {}\n", hex(&answer[..count])).expect("text");
    }
    document::compare_part(LINK, "worked frames", &format!("\n{table}"));
}

#[test]
fn the_revision_is_computed_as_the_document_says() {
    let mut built: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    let first = built.revision();
    for clearance_m in [None, Some(2e-3)] {
        if let Some(clearance_m) = clearance_m {
            built.set_clearance_m(clearance_m).unwrap();
            assert_ne!(built.revision(), first);
        }
        let image = built.to_image();
        assert_eq!(image.len(), 6728);
        let mut revised = image;
        revised[60..68].fill(0);
        revise_and_sign::<f32>(&mut revised);
        assert_eq!(revised, image);
        assert_eq!(image[60..64], built.revision().to_le_bytes());
    }
}

/// The Python client receives the core's forces from a device behind a TCP port.
#[test]
fn the_client_in_python_drives_a_device() {
    if !have(&[PYTHON], "the client in Python") {
        return;
    }
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a port");
    let port = listener.local_addr().expect("its address").port();
    let target = std::thread::spawn(move || {
        let (mut line, _) = listener.accept().expect("a host");
        let mut desk = desk(["reduced-vertical", "in-service"]);
        let mut buffer = [0; 1024];
        // The first answer is broken, so the client asks again.
        let mut broken = false;
        while let Ok(count @ 1..) = line.read(&mut buffer) {
            desk.send(&buffer[..count]).expect("a device");
            let count = desk
                .receive(&mut buffer, Duration::ZERO)
                .expect("an answer");
            if !std::mem::replace(&mut broken, true) {
                buffer[1] ^= 1;
            }
            if line.write_all(&buffer[..count]).is_err() {
                break;
            }
        }
        desk.device().counters()
    });
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("model.bin");
    std::fs::write(&file, model().to_image()).expect("a file");
    let output = Command::new(PYTHON.program)
        .arg(document::in_repository("docs/link_client.py"))
        .args(["127.0.0.1", &port.to_string()])
        .arg(&file)
        .output()
        .expect("python starts");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success(),
        "{printed}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let mut health = Health::new(&model());
    let forces = ["reduced-vertical", "in-service"].map(|name| {
        let damper: Damper<f32> = damper(name, &[]).build(1e-3).expect("a preset");
        let mut state = damper.at_rest(0.0);
        (1..=100).fold(0.0, |_, step| {
            let x = (0.02 * f64::from(1e-3_f32) * f64::from(step)) as f32;
            let force = damper.step(&mut state, x);
            if name == "reduced-vertical" {
                health.tick(&model(), x, force);
            }
            force
        })
    });
    let [vertical, in_service] = forces;
    let reading = health.reading(&model());
    assert!(reading.samples > 0);
    let expected = [
        format!("forces {vertical:.1} {in_service:.1} N, status [0, 0]"),
        format!(
            "flow factor {:.4} +- {:.4} by {} samples, {} rejected, status {}",
            reading.flow_factor.value,
            reading.flow_factor.sd,
            reading.samples,
            reading.rejected,
            reading.status.bits()
        ),
    ];
    let lines: Vec<&str> = printed.lines().skip(1).collect();
    assert_eq!(lines, expected);
    let counters = target.join().expect("the target");
    assert_eq!(
        (counters.accepted, counters.repeated, counters.corrupt),
        // The requests are hello, 100 steps, a model, 100 samples in groups of eight, and a reading.
        (1 + 100 + 1 + 13 + 1, 1, 0)
    );
}
