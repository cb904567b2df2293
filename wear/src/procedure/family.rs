//! A family of worn pairs, from new ones to a hollow tread, a thin flange and conformal shapes.

use dashpot_rail::profile::{s1002, uic60};

use super::collective::Collective;
use super::{Procedure, ProcedureError, WornPair};

/// A worn pair of the family.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Member {
    /// Its name.
    pub name: &'static str,
    /// The pair.
    pub pair: WornPair,
}

/// One chain of growing wear: name and depth (m) of each member, collective, and part of the rail's wear.
struct Chain {
    members: &'static [(&'static str, f64)],
    collective: fn() -> Collective,
    rail_part: f64,
}

const CHAINS: [Chain; 5] = [
    Chain {
        members: &[("tread worn", 0.4e-3), ("hollow tread", 1.5e-3)],
        collective: Collective::straight,
        rail_part: 0.3,
    },
    Chain {
        members: &[("flange worn", 0.6e-3), ("thin flange", 2.5e-3)],
        collective: Collective::outer_wheel,
        rail_part: 0.5,
    },
    Chain {
        members: &[("tread and flange worn", 0.5e-3), ("worn all over", 1.2e-3)],
        collective: mixed,
        rail_part: 0.5,
    },
    Chain {
        members: &[("conformal", 0.4e-3), ("worn to each other", 1.0e-3)],
        collective: Collective::conforming,
        rail_part: 1.0,
    },
    Chain {
        members: &[("field side worn", 0.8e-3)],
        collective: Collective::inner_wheel,
        rail_part: 0.5,
    },
];

/// Pairs of one member's wheel on another's rail.
const CROSSED: [(&str, &str, &str); 3] = [
    (
        "hollow tread on a rail with a worn gauge corner",
        "hollow tread",
        "thin flange",
    ),
    ("thin flange on a new rail", "thin flange", "new"),
    (
        "new wheel on a rail with a worn gauge corner",
        "new",
        "thin flange",
    ),
];

/// Names of all members.
pub const FAMILY: [&str; 13] = [
    "new",
    "tread worn",
    "hollow tread",
    "flange worn",
    "thin flange",
    "tread and flange worn",
    "worn all over",
    "conformal",
    "worn to each other",
    "field side worn",
    "hollow tread on a rail with a worn gauge corner",
    "thin flange on a new rail",
    "new wheel on a rail with a worn gauge corner",
];

fn mixed() -> Collective {
    Collective::straight().mixed(Collective::outer_wheel(), 0.003)
}

/// Wears S1002 on UIC 60 into every member of the family, in the order of [`FAMILY`].
///
/// # Errors
/// See [`Procedure::wear`].
pub fn family() -> Result<Vec<Member>, ProcedureError> {
    family_of(&FAMILY)
}

/// The members with the given names; names that are not in [`FAMILY`] are left out.
///
/// # Errors
/// See [`Procedure::wear`].
pub fn family_of(names: &[&str]) -> Result<Vec<Member>, ProcedureError> {
    let wanted = |name: &str| {
        let in_crossed = CROSSED.iter().any(|(crossed, wheel, rail)| {
            names.contains(crossed) && (*wheel == name || *rail == name)
        });
        names.contains(&name) || in_crossed
    };
    let new = WornPair::new(s1002::profile(), uic60::profile());
    let mut all = vec![Member {
        name: "new",
        pair: new.clone(),
    }];
    for chain in &CHAINS {
        let Some(last) = chain.members.iter().rposition(|(name, _)| wanted(name)) else {
            continue;
        };
        let procedure = Procedure {
            rail_part: chain.rail_part,
            ..Procedure::default()
        };
        let collective = (chain.collective)();
        let mut pair = new.clone();
        for (name, depth_m) in &chain.members[..=last] {
            pair = procedure.wear(&pair, &collective, *depth_m)?;
            all.push(Member {
                name,
                pair: pair.clone(),
            });
        }
    }
    for (name, wheel, rail) in CROSSED {
        let of = |name: &str| all.iter().find(|member| member.name == name);
        if let (true, Some(wheel), Some(rail)) = (names.contains(&name), of(wheel), of(rail)) {
            all.push(Member {
                name,
                pair: WornPair {
                    rail: rail.pair.rail.clone(),
                    ..wheel.pair.clone()
                },
            });
        }
    }
    all.retain(|member| names.contains(&member.name));
    Ok(all)
}
