//! Health over the link: a model is loaded completely or not at all, samples are sent, and the reading equals that of
//! an estimator on this machine.

use dashpot::damper;
use dashpot::signed_image::crc_32;
use dashpot_core::health::{Health, HealthImageError, HealthModel, HealthReading, HealthSettings};
use dashpot_core::link::{Clock, Device, MAX_MEASURED, Refusal, Request, Response, request_frame};

use crate::common::{Answer, Bench, SESSION, reals};

fn model(name: &str, step_s: f64) -> HealthModel {
    let checked = damper(name, &[]).check().unwrap();
    let settings = HealthSettings::new(20e-6, 20.0);
    checked.health_model(&settings, step_s).unwrap()
}

fn load(bench: &mut Bench, damper: u8, image: &[u8]) -> Answer {
    bench.ask(&Request::LoadHealth { damper, image })
}

fn reading(bench: &mut Bench, request: &Request<'_>) -> HealthReading {
    match bench.ask(request).response().1 {
        Response::Health(reading) => reading,
        other => panic!("{other:?}"),
    }
}

/// Displacement and force of the bench's second damper in a motion that excites every parameter.
fn samples(bench: &Bench, count: usize) -> Vec<(f32, f32)> {
    let mut state = bench.dampers[1].at_rest(0.0);
    let motion = (0..count).map(|tick| {
        let t = tick as f32 * 1e-3;
        4e-3 * (9.0 * t).sin() + 2e-3 * (31.0 * t).sin()
    });
    motion
        .map(|x| (x, bench.dampers[1].step(&mut state, x)))
        .collect()
}

fn bytes(samples: &[(f32, f32)]) -> Vec<u8> {
    let pairs = samples.iter();
    pairs
        .flat_map(|(x, force)| [x.to_le_bytes(), force.to_le_bytes()].concat())
        .collect()
}

#[test]
fn a_measured_damper_has_the_reading_of_the_desk() {
    let mut bench = Bench::open();
    let model = model("reduced-vertical", 1e-3);
    assert_eq!(
        load(&mut bench, 1, &model.to_image()).response().1,
        Response::Done
    );
    let ask = Request::Health { damper: 1 };
    let mut expected = Health::new(&model);
    assert_eq!(reading(&mut bench, &ask), expected.reading(&model));
    let rest = bench.states();
    let mut samples = samples(&bench, 6000);
    samples[1000].0 = f32::NAN;
    // The samples are sent in batches of every size.
    let (mut rest_of_them, mut size) = (&samples[..], 1);
    while !rest_of_them.is_empty() {
        let (batch, rest) = rest_of_them.split_at(size.min(rest_of_them.len()));
        bench.done(&Request::Measure {
            damper: 1,
            samples: &bytes(batch),
        });
        (rest_of_them, size) = (rest, size % MAX_MEASURED + 1);
    }
    for (x, force) in &samples {
        expected.tick(&model, *x, *force);
    }
    let (found, expected) = (reading(&mut bench, &ask), expected.reading(&model));
    assert_eq!(found, expected);
    assert!(
        found.flow_factor.sd < 0.01 && found.samples > 1000,
        "{found:?}"
    );
    assert_eq!(found.rejected, 1);
    assert_eq!(bench.states(), rest, "no damper was stepped");
    // The answer contains the status that was cleared.
    let cleared = reading(&mut bench, &Request::ClearHealth { damper: 1 });
    assert_eq!(cleared, expected);
    let after = reading(&mut bench, &ask);
    assert!(after.status.is_empty() && after.rejected == 0, "{after:?}");
    assert_eq!(after.flow_factor, expected.flow_factor);
}

#[test]
fn requests_for_unwatched_dampers_are_refused() {
    let mut bench = Bench::open();
    let one = bytes(&[(0.0, 0.0)]);
    let requests = |damper| {
        [
            Request::Measure {
                damper,
                samples: &one,
            },
            Request::Health { damper },
            Request::ClearHealth { damper },
        ]
    };
    for (damper, refusal) in [(0, Refusal::NoHealth), (2, Refusal::Damper(2))] {
        for request in requests(damper) {
            assert_eq!(bench.ask(&request).refusal(), Some(refusal), "{request:?}");
        }
    }
    let image = model("in-service", 1e-3).to_image();
    assert_eq!(
        load(&mut bench, 2, &image).refusal(),
        Some(Refusal::Damper(2))
    );
    assert_eq!(load(&mut bench, 0, &image).response().1, Response::Done);
    let before = reading(&mut bench, &Request::Health { damper: 0 });
    let too_many = bytes(&[(1e-3, 500.0); MAX_MEASURED + 1]);
    for samples in [&[][..], &one[1..], &too_many, &too_many[4..]] {
        let refused = bench.ask(&Request::Measure { damper: 0, samples });
        assert_eq!(refused.refusal(), Some(Refusal::Range));
    }
    assert_eq!(reading(&mut bench, &Request::Health { damper: 0 }), before);
    assert_eq!(
        bench.ask(&Request::Health { damper: 1 }).refusal(),
        Some(Refusal::NoHealth),
        "the other slot has none"
    );
}

#[test]
fn a_damaged_model_is_refused_and_the_estimate_continues() {
    let mut bench = Bench::open();
    let image = model("reduced-vertical", 1e-3).to_image();
    load(&mut bench, 1, &image);
    let fed = bytes(&samples(&bench, MAX_MEASURED));
    bench.done(&Request::Measure {
        damper: 1,
        samples: &fed,
    });
    let before = reading(&mut bench, &Request::Health { damper: 1 });
    let signed = |offset: usize, word: u32| {
        let mut wrong = image;
        wrong[offset..offset + 4].copy_from_slice(&word.to_le_bytes());
        let (checked, check) = wrong.split_last_chunk_mut::<4>().unwrap();
        *check = crc_32(checked).to_le_bytes();
        wrong
    };
    let cut = HealthImageError::Length {
        expected: image.len() as u32,
        found: image.len() as u32 - 1,
    };
    let mut flipped = image;
    flipped[image.len() / 2] ^= 8;
    for (wrong, error) in [
        (&image[..image.len() - 1], cut),
        (&signed(0, 7), HealthImageError::Magic),
        (&signed(4, 99), HealthImageError::Version(99)),
        (&flipped, HealthImageError::Checksum),
        // These change the mark, half the step, and the number of ticks in a block.
        (&signed(8, 0), HealthImageError::Values),
        (&signed(12, f32::NAN.to_bits()), HealthImageError::Values),
        (&signed(12, 0), HealthImageError::Values),
        (&signed(28, 0), HealthImageError::Values),
    ] {
        assert_eq!(HealthModel::from_image(wrong), Err(error));
        let refusal = load(&mut bench, 1, wrong).refusal();
        assert_eq!(refusal, Some(Refusal::HealthImage(error)));
    }
    let other_step = model("reduced-vertical", 5e-4).to_image();
    let refusal = load(&mut bench, 1, &other_step).refusal();
    assert_eq!(refusal, Some(Refusal::StepSize));
    assert_eq!(reading(&mut bench, &Request::Health { damper: 1 }), before);
    // A valid model then restarts the estimate.
    load(&mut bench, 1, &image);
    let fresh = Health::new(&model("reduced-vertical", 1e-3));
    let fresh = fresh.reading(&model("reduced-vertical", 1e-3));
    assert_eq!(reading(&mut bench, &Request::Health { damper: 1 }), fresh);
}

/// A load in progress does not change the ticks, and a firmware's own sensors feed the same estimate.
#[test]
fn a_model_is_loaded_between_ticks_and_fed_by_the_board() {
    let mut bench = Bench::open();
    bench.ask(&Request::Run {
        displacements_m: reals([0.0; 2]),
    });
    bench.ask(&Request::Displace {
        displacements_m: reals([2e-3; 2]),
    });
    let model = model("reduced-vertical", 1e-3);
    let image = model.to_image();
    bench.header.sequence += 1;
    let request = Request::LoadHealth {
        damper: 1,
        image: &image,
    };
    for byte in request_frame(bench.header, &request).bytes() {
        assert!(!bench.device.receive(*byte));
    }
    let mut states = bench.dampers.map(|damper| damper.at_rest(0.0));
    let mut slices = 0;
    while !bench.device.advance() {
        slices += 1;
        assert!(
            bench.device.push_measurement(1, 0.0, 0.0).is_err(),
            "not yet loaded"
        );
        bench.device.tick(1);
        let dampers = bench.dampers.iter().zip(&mut states);
        for ((damper, state), output) in dampers.zip(bench.device.outputs_n()) {
            assert_eq!(damper.step(state, 2e-3).to_bits(), output.to_bits());
        }
    }
    assert!(slices > 10, "{slices}");
    let mut expected = Health::new(&model);
    for (x, force) in samples(&bench, 3000) {
        let device = &mut bench.device;
        assert!(device.push_measurement(1, x, force).is_ok());
        assert!(device.push_measurement(0, x, force).is_err());
        assert!(device.push_measurement(2, x, force).is_err());
        expected.tick(&model, x, force);
    }
    let found = reading(&mut bench, &Request::Health { damper: 1 });
    assert_eq!(found, expected.reading(&model));
}

/// A device may watch only some slots, or none; it refuses a model for another slot before it loads anything.
#[test]
fn unwatched_slots_take_no_model() {
    let bench = Bench::new();
    let mut device = Box::new(Device::<2, 1>::new());
    let clock = Clock::new(|| 0, 1);
    device.start(&bench.dampers.each_ref(), clock).unwrap();
    let image = model("reduced-vertical", 1e-3).to_image();
    let header = |sequence| dashpot_core::link::Header {
        session: SESSION,
        sequence,
    };
    let mut ask = |sequence, request: &Request<'_>| {
        let mut answered = false;
        for byte in request_frame(header(sequence), request).bytes() {
            answered = device.receive(*byte);
            while device.is_busy() {
                answered = device.advance();
            }
        }
        assert!(answered);
        let mut reader = dashpot_core::link::FrameReader::<512>::new();
        let answer = device.response().iter();
        let message = answer.filter_map(|byte| Some(reader.push(*byte)?.unwrap().bytes.to_vec()));
        let message: Vec<u8> = message.flatten().collect();
        let (_, response) =
            postcard::from_bytes::<(dashpot_core::link::Header, Response<'_>)>(&message).unwrap();
        match response {
            Response::Refused(refusal) => Some(refusal),
            _ => None,
        }
    };
    let hello = Request::Hello {
        protocol: dashpot_core::link::PROTOCOL,
    };
    assert_eq!(ask(1, &hello), None);
    let load = |damper| Request::LoadHealth {
        damper,
        image: &image,
    };
    assert_eq!(ask(2, &load(0)), None);
    assert_eq!(ask(3, &load(1)), Some(Refusal::NoHealth));
    assert_eq!(
        ask(4, &Request::Health { damper: 1 }),
        Some(Refusal::NoHealth)
    );
}
