//! Random dampers of every term under random motions: the accuracy that docs/numerics.md promises, for inputs
//! nobody chose.
//!
//! A number makes a damper and its motion. `DASHPOT_RANDOM_DAMPERS=1000..2000` tries others.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use dashpot::accuracy::{STEPS_S, stepped};
use dashpot_core::characteristic::{Characteristic, Corner};
use dashpot_core::parameters::{
    Element, Geometry, Hydraulics, Leakage, Limits, Mount, Oil, OilColumn, Orifice, Reduced,
    Relief, Reservoir, Seal, TwoChamber, Valve, Valves,
};
use dashpot_core::{Damper, DamperParameters};
use dashpot_hil::study::Scalar;
use dashpot_hil::study::accuracy_limits::{
    AccuracyLimits, LEAST_RMS_FORCE_RATIO, relaxation_time_s,
};
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::{largest_magnitude, nrmse_above};

/// Dampers tried.
const NUMBERS: Range<u64> = 0..48;

/// Least share of them that the promise covers.
const COVERED: f64 = 0.8;

/// What an NRMSE is of, in the order of [`Case::nrmse`].
const COLUMNS: [&str; 4] = ["1 kHz f64", "1 kHz f32", "10 kHz f64", "10 kHz f32"];

/// Numbers that look random: SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// Each decade as likely as another.
    fn decades(&mut self, from: f64, to: f64) -> f64 {
        self.between(from.ln(), to.ln()).exp()
    }

    fn happens(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// The value, or what is off.
    fn some<T>(&mut self, probability: f64, value: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.happens(probability).then(|| value(self))
    }
}

fn valve(random: &mut Random, free_radius_m: f64) -> Valve {
    Valve {
        clamp_radius_m: 0.5 * free_radius_m,
        free_radius_m,
        shims_m: heapless::Vec::new(),
        edge_compliance_m_per_pa: Some(random.decades(1e-13, 1e-10)),
        equivalent_pressure_factor: random.between(0.2, 1.0),
        discharge_coefficient: random.between(0.5, 0.8),
        preload_pa: random.some(0.6, |r| r.decades(1e4, 1e7)).unwrap_or(0.0),
        elastic_modulus_pa: 2e11,
        poisson_ratio: 0.3,
    }
}

fn oil(random: &mut Random) -> Oil {
    Oil {
        density_kg_per_m3: random.between(800.0, 900.0),
        thermal_expansion_per_k: 7e-4,
        temperature_c: random.between(-40.0, 90.0),
        viscosity_40c_m2_per_s: 15e-6,
        viscosity_100c_m2_per_s: 3.8e-6,
        column: random.some(0.6, |r| OilColumn {
            bulk_modulus_pa: r.decades(8e8, 2e9),
            rod_side_volume_m3: r.decades(1e-4, 2e-3),
            piston_side_volume_m3: r.decades(1e-4, 2e-3),
            air_fraction: r.some(0.7, |r| r.decades(1e-5, 0.05)).unwrap_or(0.0),
            polytropic_exponent: r.some(0.5, |r| r.between(1.0, 1.4)).unwrap_or(1.0),
        }),
    }
}

fn hydraulics(random: &mut Random) -> Hydraulics {
    let piston = random.between(0.03, 0.12);
    Hydraulics {
        geometry: Geometry {
            rod_diameter_m: piston * random.between(0.2, 0.7),
            piston_diameter_m: piston,
        },
        orifice: Orifice {
            diameter_m: random.some(0.9, |r| r.decades(5e-4, 4e-3)).unwrap_or(0.0),
            discharge_coefficient: random.between(0.5, 0.9),
            transition_reynolds: random.some(0.5, |r| r.decades(10.0, 2000.0)).unwrap_or(0.0),
        },
        valves: Valves {
            piston_extension: valve(random, 0.3 * piston),
            piston_compression: valve(random, 0.3 * piston),
            foot_compression: valve(random, 0.15 * piston),
        },
        leakage: random.some(0.5, |r| Leakage {
            radial_clearance_m: r.decades(1e-5, 1e-4),
            length_m: r.between(0.01, 0.06),
            eccentricity_ratio: r.unit(),
        }),
        relief: random.some(0.5, |r| Relief {
            opening_pressure_pa: r.decades(3e5, 2e7),
            area_gradient_m2_per_pa: r.decades(1e-13, 1e-11),
            discharge_coefficient: r.between(0.5, 0.8),
        }),
        reservoir: random.some(0.5, |r| Reservoir {
            fill_pressure_pa: r.some(0.5, |r| r.decades(1e4, 2e6)).unwrap_or(0.0),
            gas_volume_m3: 1e-3,
            fill_temperature_c: 20.0,
            rod_insertion_m: r.between(-0.05, 0.05),
        }),
        seal: random.some(0.5, |r| Seal {
            friction_n: r.decades(10.0, 1000.0),
        }),
        two_chamber: random.some(0.4, |r| TwoChamber {
            vapour_pressure_pa: r.between(-1e5, -1e4),
        }),
        oil: oil(random),
    }
}

fn damper(random: &mut Random) -> DamperParameters {
    let element = if random.happens(0.15) {
        Element::Reduced(Reduced {
            damping_n_s_per_m: random.decades(1e4, 1e6),
            saturation_velocity_m_per_s: random.decades(5e-3, 0.3),
        })
    } else {
        Element::Physical(hydraulics(random))
    };
    DamperParameters {
        element,
        mount: Mount {
            stiffness_n_per_m: random.decades(1e6, 4e7),
            seat_stiffness_n_per_m: random.some(0.3, |r| r.decades(1e7, 1e9)),
            clearance_m: random.some(0.5, |r| r.decades(1e-5, 5e-3)).unwrap_or(0.0),
        },
        limits: Limits {
            force_n: random.decades(5e3, 2e5),
            rate_m_per_s: random.between(2.0, 10.0),
        },
    }
}

const DURATION_S: f64 = 2.0;

/// A displacement (m) over time (s): random to 20 Hz, velocity ramps out and back with sudden stops, or
/// harmonic.
fn motion(random: &mut Random) -> Box<dyn Fn(f64) -> f64> {
    match (3.0 * random.unit()) as u32 {
        0 => {
            let velocity = random.decades(0.005, 0.4);
            let lines: Vec<[f64; 3]> = (0..40)
                .map(|_| {
                    let angular = TAU * random.decades(0.2, 20.0);
                    [random.unit(), angular, TAU * random.unit()]
                })
                .collect();
            let sum: f64 = lines.iter().map(|[share, ..]| share * share).sum();
            let scale = velocity / (0.5 * sum).sqrt();
            Box::new(move |t| {
                let line = |[share, angular, phase]: &[f64; 3]| {
                    share / angular * ((angular * t + phase).sin() - phase.sin())
                };
                scale * lines.iter().map(line).sum::<f64>()
            })
        }
        1 => {
            let velocity = random.decades(0.02, 0.6);
            Box::new(move |t| {
                let quarter = DURATION_S / 4.0;
                let ramp = |t: f64| 0.5 * velocity * t.clamp(0.0, quarter).powi(2) / quarter;
                ramp(t) + ramp(t - quarter) - ramp(t - 2.0 * quarter) - ramp(t - 3.0 * quarter)
            })
        }
        _ => {
            let amplitude = random.decades(1e-3, 3e-2);
            let angular = TAU * random.decades(0.3, 5.0);
            Box::new(move |t| amplitude * (angular * t).sin())
        }
    }
}

/// What a damper did at each step of [`STEPS_S`].
struct Case {
    number: u64,
    /// Relaxation time (s), of the last step.
    relaxation_s: f64,
    /// NRMSE for each step size in `f64` and in `f32`.
    nrmse: [[f64; 2]; 2],
    /// Corners that the force went through.
    reached: Vec<Corner>,
}

fn measure(number: u64) -> Result<Case, String> {
    let mut random = Random(number);
    let parameters = damper(&mut random);
    let motion = motion(&mut random);
    let mut case = Case {
        number,
        relaxation_s: 0.0,
        nrmse: [[0.0; 2]; 2],
        reached: Vec::new(),
    };
    let law = Characteristic::new(&parameters.check().map_err(|error| error.to_string())?);
    for (step_s, found) in STEPS_S.into_iter().zip(&mut case.nrmse) {
        let ticks = (DURATION_S / step_s).round() as usize;
        let times: Vec<f64> = (0..=ticks).map(|tick| tick as f64 * step_s).collect();
        let displacements: Vec<f64> = times
            .iter()
            .map(|time| f64::from(motion(*time) as f32))
            .collect();
        let reference = Reference::new(&parameters)
            .and_then(|mut reference| reference.forces(&times, &displacements))
            .map_err(|failure| format!("{failure}"))?;
        if largest_magnitude(reference.iter().copied()) == 0.0 {
            return Err("the motion stays within the clearance".into());
        }
        let beyond = |corner: f64| reference.iter().any(|force| force / corner >= 1.0 - 1e-9);
        let corners = law.corners().into_iter();
        case.reached.extend(
            corners
                .filter(|(_, at)| beyond(*at))
                .map(|(corner, _)| corner),
        );
        case.relaxation_s = relaxation_time_s(&parameters, step_s, &displacements, &reference);
        let stepped = [
            stepped::<f64>(&parameters, step_s, &displacements),
            stepped::<f32>(&parameters, step_s, &displacements),
        ];
        let built: Damper<f64> = parameters
            .build(step_s)
            .map_err(|error| error.to_string())?;
        let least_rms_n = LEAST_RMS_FORCE_RATIO * built.force_limit_n();
        *found = stepped.map(|forces| nrmse_above(&forces, &reference, least_rms_n));
    }
    Ok(case)
}

/// NRMSE promised for each step of [`STEPS_S`] in `f64` and in `f32`, where there is a promise.
fn promised(relaxation_s: f64) -> Option<[[f64; 2]; 2]> {
    let promise = AccuracyLimits::of(relaxation_s)?;
    let nrmse = |step_s, scalar| {
        promise
            .nrmse(step_s, scalar)
            .expect("a step of 1 ms at most")
    };
    Some(STEPS_S.map(|step_s| [Scalar::F64, Scalar::F32].map(|scalar| nrmse(step_s, scalar))))
}

fn numbers() -> Range<u64> {
    let Ok(range) = std::env::var("DASHPOT_RANDOM_DAMPERS") else {
        return NUMBERS;
    };
    let ends = range
        .split_once("..")
        .and_then(|(from, to)| Some(from.trim().parse().ok()?..to.trim().parse().ok()?));
    ends.unwrap_or_else(|| panic!("DASHPOT_RANDOM_DAMPERS={range}: must be like 1000..2000"))
}

#[test]
fn the_promise_holds_for_random_dampers_and_motions() {
    let (numbers, next) = (numbers(), AtomicU64::new(0));
    let cases = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                loop {
                    let number = numbers.start + next.fetch_add(1, Ordering::Relaxed);
                    if number >= numbers.end {
                        break;
                    }
                    let case = measure(number);
                    cases.lock().expect("no case panicked before").push(case);
                }
            });
        }
    });
    let cases = cases.into_inner().expect("no case panicked");
    let mut complaints = Vec::new();
    let mut found: [Vec<f64>; 4] = Default::default();
    for case in cases.iter().flatten() {
        let Some(promised) = promised(case.relaxation_s) else {
            continue;
        };
        let columns = case
            .nrmse
            .as_flattened()
            .iter()
            .zip(promised.as_flattened());
        for ((nrmse, promised), (found, column)) in columns.zip(found.iter_mut().zip(COLUMNS)) {
            found.push(*nrmse);
            if nrmse > promised {
                complaints.push(format!(
                    "damper {}, relaxation time {:.1e} s, {column}: {nrmse:.1e} of {promised:.0e}",
                    case.number, case.relaxation_s
                ));
            }
        }
    }
    for corner in [
        Corner::PistonValveOpens,
        Corner::ReliefOpens,
        Corner::FootValveOpens,
        Corner::Vapour,
        Corner::Yields,
    ] {
        let covered = |case: &&Case| promised(case.relaxation_s).is_some();
        let mut reached = cases
            .iter()
            .flatten()
            .filter(covered)
            .map(|case| &case.reached);
        assert!(
            reached.any(|all| all.contains(&corner)),
            "no motion reached {corner:?}"
        );
    }
    for (found, column) in found.iter_mut().zip(COLUMNS) {
        found.sort_by(f64::total_cmp);
        let (median, largest) = (found[found.len() / 2], found[found.len() - 1]);
        println!(
            "{column}: median {median:.1e}, largest {largest:.1e} of {}",
            found.len()
        );
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
    let (covered, tried) = (found[0].len(), numbers.end - numbers.start);
    assert!(
        covered as f64 >= COVERED * tried as f64,
        "the promise covers {covered} of {tried} dampers"
    );
}
