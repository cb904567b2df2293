//! Whether a vehicle tips over to one side.

use dashpot_rail::vehicle::VehicleState;

use super::signals::load_n;

/// A vehicle that is tipping over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Overturned {
    /// The side that it falls to: 0 left, 1 right.
    pub side: usize,
    /// Wheels of the other side without load.
    pub unloaded_wheels: usize,
    /// The wheelset with the greatest roll to that side.
    pub wheelset: usize,
    /// Roll of that wheelset, the right side down positive, rad.
    pub roll_rad: f64,
}

/// Least roll of a wheelset that is tilted off its rail, rad: a wheel is then 18 mm above the rail.
const MIN_ROLL_RAD: f64 = 12e-3;

impl Overturned {
    /// Looks at a state whose wheels have left the rails or the tables of the contact. It is overturning if
    ///
    /// - on more than half of the wheelsets the wheel of one side carries no load while the other wheel carries some;
    /// - a wheelset is tilted to the other side by at least [`MIN_ROLL_RAD`], so that its raised wheel is the one without load: where a
    ///   flange climbs, the raised wheel carries load;
    /// - every other body rolls to the other side too.
    pub fn of(state: &VehicleState) -> Option<Self> {
        (0..2).find_map(|side| Self::to_side(state, side))
    }

    fn to_side(state: &VehicleState, side: usize) -> Option<Self> {
        let contacts = state.contacts();
        let (bodies, wheelsets) = state
            .coordinates()
            .split_at(state.coordinates().len() - contacts.len());
        let raised = 1 - side;
        // Positive where a body rolls to the side.
        let outward = if side == 1 { 1.0 } else { -1.0 };
        let roll_of = |coordinates: &[f64; 5]| outward * coordinates[2];
        let is_raised = |number: &usize| {
            let contact = &contacts[*number];
            load_n(contact, raised) <= 0.0 && load_n(contact, side) > 0.0
        };
        let unloaded_wheels = (0..contacts.len()).filter(is_raised).count();
        let tilted = (0..contacts.len()).filter(is_raised);
        let wheelset =
            tilted.max_by(|a, b| roll_of(&wheelsets[*a]).total_cmp(&roll_of(&wheelsets[*b])))?;
        let is_overturning = 2 * unloaded_wheels > contacts.len()
            && roll_of(&wheelsets[wheelset]) >= MIN_ROLL_RAD
            && bodies.iter().all(|body| roll_of(body) > 0.0);
        is_overturning.then_some(Self {
            side,
            unloaded_wheels,
            wheelset,
            roll_rad: wheelsets[wheelset][2],
        })
    }
}
