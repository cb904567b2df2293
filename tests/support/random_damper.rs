//! Random dampers with any combination of terms.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::{
    Element, Geometry, Hydraulics, Leakage, Limits, Mount, Oil, OilColumn, Orifice, Reduced,
    Relief, Reservoir, Seal, TwoChamber, Valve, Valves,
};

/// Pseudo-random numbers: SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// Log-uniform between two numbers.
    pub fn decades(&mut self, from: f64, to: f64) -> f64 {
        self.between(from.ln(), to.ln()).exp()
    }

    /// True with the given probability.
    pub fn happens(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// The value with the given probability, otherwise `None`.
    pub fn some<T>(&mut self, probability: f64, value: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.happens(probability).then(|| value(self))
    }
}

fn valve(random: &mut Random, free_radius_m: f64) -> Valve {
    let compliance = random.decades(1e-13, 1e-10);
    let factor = random.between(0.2, 1.0);
    let discharge = random.between(0.5, 0.8);
    let preload_pa = random.some(0.6, |r| r.decades(1e4, 1e7)).unwrap_or(0.0);
    Valve::with_edge_compliance(0.5 * free_radius_m, free_radius_m, compliance, discharge)
        .equivalent_pressure_factor(factor)
        .preload_pa(preload_pa)
}

fn oil(random: &mut Random) -> Oil {
    let mut oil = Oil::new(random.between(800.0, 900.0))
        .thermal_expansion_per_k(7e-4)
        .temperature_c(random.between(-40.0, 90.0));
    oil.column = random.some(0.6, |r| {
        OilColumn::new(
            r.decades(8e8, 2e9),
            r.decades(1e-4, 2e-3),
            r.decades(1e-4, 2e-3),
        )
        .air_fraction(r.some(0.7, |r| r.decades(1e-5, 0.05)).unwrap_or(0.0))
        .polytropic_exponent(r.some(0.5, |r| r.between(1.0, 1.4)).unwrap_or(1.0))
    });
    oil
}

fn hydraulics(random: &mut Random) -> Hydraulics {
    let piston = random.between(0.03, 0.12);
    let geometry = Geometry::new(piston * random.between(0.2, 0.7), piston);
    let orifice = Orifice::new(
        random.some(0.9, |r| r.decades(5e-4, 4e-3)).unwrap_or(0.0),
        random.between(0.5, 0.9),
    )
    .transition_reynolds(random.some(0.5, |r| r.decades(10.0, 2000.0)).unwrap_or(0.0));
    let valves = Valves::new(
        valve(random, 0.3 * piston),
        valve(random, 0.3 * piston),
        valve(random, 0.15 * piston),
    );
    let leakage = random.some(0.5, |r| {
        Leakage::new(r.decades(1e-5, 1e-4), r.between(0.01, 0.06)).eccentricity_ratio(r.unit())
    });
    let relief = random.some(0.5, |r| {
        Relief::new(
            r.decades(3e5, 2e7),
            r.decades(1e-13, 1e-11),
            r.between(0.5, 0.8),
        )
    });
    let reservoir = random.some(0.5, |r| {
        let fill_pressure_pa = r.some(0.5, |r| r.decades(1e4, 2e6)).unwrap_or(0.0);
        Reservoir::new(fill_pressure_pa, 1e-3, 20.0).rod_insertion_m(r.between(-0.05, 0.05))
    });
    let seal = random.some(0.5, |r| Seal::new(r.decades(10.0, 1000.0)));
    let two_chamber = random.some(0.4, |r| TwoChamber::new(r.between(-1e5, -1e4)));
    let mut hydraulics = Hydraulics::new(geometry, orifice, valves, oil(random));
    hydraulics.leakage = leakage;
    hydraulics.relief = relief;
    hydraulics.reservoir = reservoir;
    hydraulics.seal = seal;
    hydraulics.two_chamber = two_chamber;
    hydraulics
}

/// A damper with each term randomly on or off.
pub fn damper(random: &mut Random) -> DamperParameters {
    let element = if random.happens(0.15) {
        Element::Reduced(Reduced::new(
            random.decades(1e4, 1e6),
            random.decades(5e-3, 0.3),
        ))
    } else {
        Element::Physical(hydraulics(random))
    };
    let mut mount = Mount::new(random.decades(1e6, 4e7));
    mount.seat_stiffness_n_per_m = random.some(0.3, |r| r.decades(1e7, 1e9));
    mount.clearance_m = random.some(0.5, |r| r.decades(1e-5, 5e-3)).unwrap_or(0.0);
    let limits = Limits::DEFAULT
        .force_n(random.decades(5e3, 2e5))
        .rate_m_per_s(random.between(2.0, 10.0));
    DamperParameters::new(element, mount).limits(limits)
}
