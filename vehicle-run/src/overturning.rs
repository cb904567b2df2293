//! Detection of a vehicle that tips over to one side.

use dashpot_rail::vehicle::VehicleState;

/// Vehicle that is tipping over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Overturned {
    /// Side to which it falls: 0 left, 1 right.
    pub side: usize,
    /// Number of unloaded wheels on the other side.
    pub unloaded_wheels: usize,
    /// Index of the wheelset with the largest roll to that side.
    pub wheelset: usize,
    /// Roll of that wheelset, positive with the right side down, rad.
    pub roll_rad: f64,
}

/// Minimum roll of a wheelset that is tilted off its rail, rad: the raised wheel is then 18 mm above the rail.
const MIN_ROLL_RAD: f64 = 12e-3;

impl Overturned {
    /// Examines a state whose wheels have left the rails or the contact tables. The vehicle is overturning if
    ///
    /// - on more than half of the wheelsets, the wheel on one side carries no load while the other wheel does;
    /// - a wheelset is tilted towards the loaded side by at least [`MIN_ROLL_RAD`], with its unloaded wheel raised (a
    ///   wheel raised by flange climbing carries load); and
    /// - every other body rolls to the same side.
    pub fn detect(state: &VehicleState) -> Option<Self> {
        (0..2).find_map(|side| Self::to_side(state, side))
    }

    fn to_side(state: &VehicleState, side: usize) -> Option<Self> {
        let contacts = state.contacts();
        let (bodies, wheelsets) = state
            .coordinates()
            .split_at(state.coordinates().len() - contacts.len());
        let raised = 1 - side;
        // Positive roll is towards `side`.
        let outward = if side == 1 { 1.0 } else { -1.0 };
        let roll_of = |coordinates: &[f64; 5]| outward * coordinates[2];
        let is_raised = |index: &usize| {
            let contact = &contacts[*index];
            contact.wheels[raised].load_n() <= 0.0 && contact.wheels[side].load_n() > 0.0
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
