//! The default pair's tables and wheelsets that stand and roll on them.

// Each test binary uses its own share of these.
#![allow(dead_code)]

use std::sync::OnceLock;

use dashpot_rail::contact::hertz::Steel;
use dashpot_rail::contact::motion::{Motion, Rail};
use dashpot_rail::contact::pair::{Installation, Pair};
use dashpot_rail::contact::table::{Grid, Tables};
use dashpot_rail::contact::wheelset::WheelsetContact;
use dashpot_rail::creep::creepage::CreepLaw;
use dashpot_rail::creep::friction::Friction;
use dashpot_rail::creep::polach::Polach;

pub fn tables() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        let pair = Pair::standard(Installation::default()).unwrap();
        Tables::new(pair, Steel::default(), Grid::default())
    })
}

pub fn polach() -> &'static WheelsetContact<Polach> {
    static CONTACT: OnceLock<WheelsetContact<Polach>> = OnceLock::new();
    CONTACT.get_or_init(|| WheelsetContact::new(tables().clone(), Polach, Friction::default()))
}

pub const LEVEL: [Rail; 2] = [Rail {
    lateral: 0.0,
    vertical: 0.0,
    lateral_rate: 0.0,
    vertical_rate: 0.0,
}; 2];

/// Depth of the centre at which the rails carry `load`, by bisection.
pub fn settle<L: CreepLaw>(contact: &WheelsetContact<L>, motion: &Motion, load: f64) -> Motion {
    let (mut low, mut high) = (-40e-3, 1e-3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let motion = Motion {
            vertical: middle,
            ..*motion
        };
        if -contact.forces(&motion, &LEVEL).force[2] < load {
            low = middle;
        } else {
            high = middle;
        }
    }
    Motion {
        vertical: high,
        ..*motion
    }
}

pub fn rolling(speed: f64) -> Motion {
    Motion {
        speed,
        rotation: speed / 0.625,
        ..Motion::default()
    }
}
