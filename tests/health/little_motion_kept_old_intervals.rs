//! Fixed bug: when the clearance grew to 4 mm under a motion of 0.44 mm rms, the old estimate kept its narrow intervals
//! for the rest of the run, because nothing was measured and nothing was forgotten.

use dashpot_core::health::{Health, HealthStatus};
use dashpot_testbench::health::Noise;

use crate::synthetic::{forces, model, ride, varied};

#[test]
fn knowledge_fades_in_uninformative_motion() {
    const BEFORE: usize = 20_000;
    const TICKS: usize = 320_000;
    let healthy = varied("in-service", None);
    let mut worn = healthy.clone();
    worn.mount.clearance_m = 4e-3;
    for seed in 0..3 {
        let mut x = ride(seed, TICKS);
        let rest = x[BEFORE];
        let square = x[BEFORE..].iter().map(|x| (x - rest).powi(2)).sum::<f64>();
        let small = 0.44e-3 / (square / (TICKS - BEFORE) as f64).sqrt();
        for x in &mut x[BEFORE..] {
            *x = rest + small * (*x - rest);
        }
        let force = forces(&healthy, &worn, BEFORE, &x);
        let noise = Noise::from_rms(0.02, &x[..BEFORE], &force[..BEFORE]);
        let model = model(&healthy, &noise);
        let (x, force) = noise.add_to(&x, &force, seed);
        let mut health = Health::new(&model);
        let mut known = None;
        for (tick, (x, force)) in x.iter().zip(&force).enumerate() {
            health.tick(&model, *x as f32, *force as f32);
            if tick == BEFORE {
                known = Some(health.reading(&model));
            }
        }
        let (known, last) = (known.unwrap(), health.reading(&model));
        println!("{known:?}\n{last:?}");
        assert!(known.clearance_m.sd < 0.05e-3, "{known:?}");
        let misses = (last.clearance_m.value - 4e-3).abs() / last.clearance_m.sd;
        assert!(misses < 4.0 || !last.is_trusted(), "{last:?}");
        let little = HealthStatus::LITTLE_EXCITATION;
        assert!(
            last.status
                .intersects(little | HealthStatus::CLEARANCE | HealthStatus::NO_FORCE),
            "{last:?}"
        );
    }
}
