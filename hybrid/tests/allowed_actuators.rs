//! Every actuator that its file may describe moves within its stroke and stays finite, whatever is asked of it.

use dashpot_files::actuator::{
    ActuatorLaw, ActuatorLimits, ActuatorParameters, Coupled, DisplacementSensor, ForceSensor,
    SecondOrder, ServoHydraulic,
};
use dashpot_files::damper;
use dashpot_hybrid::rig::VirtualRig;
use fastrand::Rng;

/// A number from the whole range, by its logarithm; ranges from 0 begin at a billionth of their end.
fn draw(random: &mut Rng, least: f64, most: f64) -> f64 {
    let from = if least > 0.0 { least } else { 1e-9 * most };
    from * (most / from).powf(random.f64())
}

fn law(random: &mut Rng) -> ActuatorLaw {
    let mut of = |least, most| draw(random, least, most);
    match of(1.0, 27.0).ln() as u32 {
        0 => ActuatorLaw::Coupled(Coupled {
            valve_gain_n_per_m_s3: of(1e6, 1e18),
            valve_damping_per_s: of(1.0, 5e3),
            valve_stiffness_per_s2: of(1e2, 4e6),
            leakage_per_s: of(0.0, 1e3),
            interaction_n_per_m: of(0.0, 1e9),
            moving_mass_kg: of(1.0, 1e4),
            frame_stiffness_n_per_m: of(0.0, 1e9),
            frame_damping_n_s_per_m: of(0.0, 1e7),
            measured_gain: of(0.5, 2.0),
        }),
        1 => ActuatorLaw::SecondOrder(SecondOrder {
            frequency_hz: of(0.5, 300.0),
            damping_ratio: of(0.05, 5.0),
            delay_s: of(0.0, 0.2),
        }),
        _ => ActuatorLaw::ServoHydraulic(ServoHydraulic {
            piston_area_m2: of(1e-5, 0.1),
            supply_pressure_pa: of(1e5, 1e8),
            rated_flow_m3_per_s: of(1e-6, 0.1),
            rated_drop_pa: of(1e5, 1e8),
            valve_hz: of(1.0, 300.0),
            valve_damping_ratio: of(0.1, 5.0),
            oil_volume_m3: of(1e-6, 1.0),
            bulk_modulus_pa: of(1e7, 3e9),
            leakage_m3_per_s_pa: of(0.0, 1e-8),
            moving_mass_kg: of(1.0, 1e4),
            loop_gain_per_s: of(0.1, 1e3),
            delay_s: of(0.0, 0.2),
        }),
    }
}

#[test]
fn every_allowed_actuator_stays_within_its_stroke() {
    let mut random = Rng::with_seed(11);
    let dampers = ["reduced-lateral", "reduced-vertical", "in-service", "paper"];
    let dampers = dampers.map(|name| damper::load(name, &[]).unwrap());
    let mut ran = [0; 3];
    while ran.iter().any(|count| *count < 100) {
        let stroke_m = draw(&mut random, 1e-3, 1.0);
        let parameters = ActuatorParameters {
            name: "drawn".into(),
            limits: ActuatorLimits {
                stroke_m,
                velocity_m_per_s: draw(&mut random, 1e-3, 10.0),
                force_n: draw(&mut random, 1.0, 1e7),
            },
            law: law(&mut random),
            displacement_sensor: DisplacementSensor::default(),
            force_sensor: ForceSensor::default(),
        };
        let damper = &dampers[random.usize(0..dampers.len())];
        let rig = VirtualRig::new(&parameters, damper, 1e-3, random.u64(..));
        let (Ok(()), Ok(mut rig)) = (parameters.check(), rig) else {
            continue;
        };
        let kind = match &parameters.law {
            ActuatorLaw::Coupled(_) => 0,
            ActuatorLaw::SecondOrder(_) => 1,
            ActuatorLaw::ServoHydraulic(_) => 2,
        };
        ran[kind] += 1;
        let gain = match &parameters.law {
            ActuatorLaw::Coupled(law) => law.measured_gain,
            _ => 1.0,
        };
        let mut command_m = 0.0;
        for _ in 0..500 {
            if random.u8(0..20) == 0 {
                command_m = 3.0 * stroke_m * (random.f64() - 0.5);
            }
            let measured = rig.tick(command_m).unwrap();
            assert!(
                f64::from(measured.displacement_m).abs() <= 1.1001 * gain * stroke_m,
                "{parameters:?}: {measured:?}"
            );
            assert!(measured.force_n.is_finite(), "{parameters:?}: {measured:?}");
        }
    }
}
