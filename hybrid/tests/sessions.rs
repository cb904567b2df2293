//! Sessions of a rig: who may start one, and what moves when one starts or ends.

use dashpot_core::hybrid::wire::{Frame, FrameFlags, FrameKind};
use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::damper;
use dashpot_hybrid::rig::{KeeperSettings, RigClient, RigServer, VirtualRig};

const STEP_S: f64 = 1e-3;
const VELOCITY_M_PER_S: f64 = 0.8;

fn server() -> RigServer {
    let servo = ActuatorParameters::load("servo").unwrap();
    let damper = damper::load("reduced-lateral", &[]).unwrap();
    let settings = KeeperSettings {
        extrapolated_ticks: 5,
        ramp_s: 0.2,
        velocity_m_per_s: VELOCITY_M_PER_S,
        stroke_m: 0.1,
    };
    RigServer::new(
        VirtualRig::new(&servo, &damper, STEP_S, 1).unwrap(),
        settings,
        STEP_S,
    )
}

/// One tick with a command (m); returns whether the rig took it.
fn tick(server: &mut RigServer, client: &mut RigClient, command_m: f32) -> bool {
    let taken = server.take(&client.command(1.0, command_m).to_bytes());
    if let Some(answer) = server.tick() {
        client.take(&answer.to_bytes());
    }
    taken
}

/// A session that moves to 10 mm at 0.2 m/s.
fn moved() -> (RigServer, RigClient) {
    let (mut server, mut client) = (server(), RigClient::new(7, STEP_S));
    for number in 0..=50 {
        assert!(tick(&mut server, &mut client, 2e-4 * number as f32));
    }
    assert!((server.command_m() - 0.01).abs() < 1e-8);
    (server, client)
}

#[test]
fn a_new_session_moves_nothing_until_the_vehicle_knows_where_the_rig_is() {
    let (mut server, mut client) = moved();
    server.take(&client.stop(1.0).to_bytes());
    for _ in 0..300 {
        server.tick();
    }
    let held_m = server.command_m();
    let mut second = RigClient::new(8, STEP_S);
    // Its answers are lost at first.
    for _ in 0..30 {
        assert!(server.take(&second.command(0.0, 0.0).to_bytes()));
        let answer = server.tick().unwrap();
        assert_eq!(server.command_m(), held_m);
        assert!((f64::from(answer.displacement_m) - held_m).abs() < 1e-4);
    }
    second.take(&server.tick().unwrap().to_bytes());
    // The first command counts from where the rig is, not from 0.
    let first = second.command(0.001, held_m as f32 + 1e-4);
    assert!(first.other.abs() < 0.3, "{first:?}");
}

#[test]
fn nobody_gets_a_rig_that_has_not_come_to_rest() {
    let (mut server, _) = moved();
    let mut other = RigClient::new(8, STEP_S);
    let mut last_m = server.command_m();
    for silent in 1..250 {
        let is_started = server.take(&other.command(0.0, 0.0).to_bytes());
        assert_eq!(is_started, silent > 205, "after {silent} ticks");
        server.tick();
        let change_m = server.command_m() - last_m;
        last_m = server.command_m();
        // From 0.2 m/s evenly to rest.
        assert!(
            (0.0..=2.001e-4).contains(&change_m),
            "tick {silent}: {change_m}"
        );
        if is_started {
            return;
        }
    }
    panic!("the rig is never free");
}

#[test]
fn an_absurd_rate_moves_the_rig_no_farther_than_its_velocity_limit() {
    let (mut server, mut client) = moved();
    let from_m = server.command_m();
    let mut frame = client.command(1.0, 0.0102);
    frame.other = 1e30;
    server.take(&frame.to_bytes());
    server.tick();
    for _ in 0..300 {
        server.tick();
    }
    // Five ticks at the limit and a ramp of 0.2 s from it.
    let most_m = VELOCITY_M_PER_S * (0.001 + 0.005 + 0.5 * 0.2) + 1e-6;
    assert!(
        server.command_m() - from_m <= most_m,
        "{}",
        server.command_m()
    );
    assert_eq!(server.longest_gap(), 300);
}

#[test]
fn foreign_datagrams_of_all_sessions_are_counted() {
    let (mut server, mut client) = moved();
    for _ in 0..3 {
        server.take(b"DSH1 but not a datagram");
    }
    let wrong_direction = Frame {
        kind: FrameKind::Measurement,
        flags: FrameFlags::empty(),
        session: 7,
        sequence: 99,
        answers: 0,
        time_s: 0.0,
        displacement_m: 0.0,
        other: 0.0,
    };
    server.take(&wrong_direction.to_bytes());
    assert_eq!(server.counts().foreign, 4);
    server.take(&client.stop(1.0).to_bytes());
    for _ in 0..300 {
        server.tick();
    }
    assert!(server.take(&RigClient::new(8, STEP_S).command(0.0, 0.0).to_bytes()));
    assert_eq!((server.counts().foreign, server.sessions()), (4, 2));
}

/// A rig whose clock runs at half the speed of the vehicle's.
#[test]
fn a_rig_with_another_step_is_seen_by_its_clock() {
    let (mut server, mut client) = (server(), RigClient::new(7, STEP_S));
    for number in 1..=400 {
        server.take(&client.command(2e-3 * f64::from(number), 0.0).to_bytes());
        client.take(&server.tick().unwrap().to_bytes());
    }
    assert!((client.clock_ratio().unwrap() - 0.5).abs() < 1e-9);
}
