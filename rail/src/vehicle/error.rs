//! Errors of vehicles.

/// Errors of vehicle parameters, states and requests.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleError {
    /// A value is out of bounds.
    #[error("{owner}: {name} = {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Name of the body, wheelset, element or ride point.
        owner: String,
        /// Name of the quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Smallest and largest allowed value.
        allowed: [f64; 2],
    },
    /// Two parts have the same name.
    #[error(
        "{name}: used twice; names of bodies, wheelsets, elements and ride points must be unique"
    )]
    NameUsedTwice {
        /// The duplicate name.
        name: String,
    },
    /// An element is attached to a body or wheelset that does not exist.
    #[error("{element}: attached to {to}, which does not exist; allowed: {}", .names.join(", "))]
    NotThere {
        /// Name of the element.
        element: String,
        /// Name of the missing body or wheelset.
        to: String,
        /// Names of all bodies and wheelsets.
        names: Vec<String>,
    },
    /// A ride point is on a body that does not exist.
    #[error("{point}: on {on}, which is not a body; allowed: {}", .names.join(", "))]
    NoSuchBody {
        /// Name of the ride point.
        point: String,
        /// Name of the missing body.
        on: String,
        /// Names of all bodies.
        names: Vec<String>,
    },
    /// Both ends of an element are on the same body.
    #[error("{element}: both ends are on {on}")]
    SameBody {
        /// Name of the element.
        element: String,
        /// Name of the body.
        on: String,
    },
    /// The ends of an element do not suit its law.
    #[error("{element}: {reason}")]
    Ends {
        /// Name of the element.
        element: String,
        /// Required position of the ends.
        reason: &'static str,
    },
    /// The parameters of a damper are invalid.
    #[error("{element}: {source}")]
    Damper {
        /// Name of the element.
        element: String,
        /// Error of its parameters.
        source: Box<dashpot_core::BuildError>,
    },
    /// The points of a stop are invalid.
    #[error("{element}: points of a stop, allowed: {reason}")]
    Stop {
        /// Name of the element.
        element: String,
        /// Requirement that the points violate.
        reason: &'static str,
    },
    /// The friction of an element follows a spring that gives no load.
    #[error("{element}: friction follows the load of {spring}, {reason}")]
    FrictionSpring {
        /// Name of the element.
        element: String,
        /// Name of the spring.
        spring: String,
        /// The problem, and what is allowed.
        reason: String,
    },
    /// The springs of friction elements are too stiff for the tick.
    #[error(
        "friction: the stuck elements oscillate at {frequency_hz:.3} Hz against the bodies, allowed: at most \
         {allowed_hz:.3} Hz in ticks of {step_s} s; use softer springs or a shorter tick"
    )]
    FrictionTooStiff {
        /// Frequency of the bodies on all stuck friction elements, Hz.
        frequency_hz: f64,
        /// Its bound, Hz.
        allowed_hz: f64,
        /// Tick, s.
        step_s: f64,
    },
    /// The vehicle has no bodies.
    #[error("no body: a vehicle needs at least one")]
    NoBody,
    /// The vehicle has no wheelsets.
    #[error("no wheelset: a running vehicle needs at least one")]
    NoWheelset,
    /// The step is too long: the geometric stiffness due to the load makes the equations of a step indefinite.
    #[error("step_s = {step_s}: too long for this vehicle; use a shorter step")]
    StepTooLong {
        /// Step, s.
        step_s: f64,
    },
    /// The lighter of wheel and rail is too light for the stiffness and damping of their contact.
    #[error(
        "contact of wheel and rail: needs steps of {needed_s:.1e} s, allowed: at least {least_s:.1e} s, a \
         two-hundredth of the tick; use heavier rails, less normal damping or a shorter tick"
    )]
    ContactTooFast {
        /// Step that the contact needs, s.
        needed_s: f64,
        /// Shortest allowed step, s.
        least_s: f64,
    },
    /// The index of a damper is out of range.
    #[error("damper {damper}: the vehicle has {dampers} dampers, counted from 0")]
    NoSuchDamper {
        /// Index, from 0.
        damper: usize,
        /// Number of dampers.
        dampers: usize,
    },
    /// The index of a body is out of range.
    #[error("body {body}: the vehicle has {bodies} bodies and wheelsets, counted from 0")]
    NoSuchBodyIndex {
        /// Index, from 0.
        body: usize,
        /// Number of bodies and wheelsets.
        bodies: usize,
    },
    /// The state belongs to another vehicle.
    #[error(
        "the state belongs to another vehicle; allowed: a state of a vehicle with the same parameters, step and rails"
    )]
    OtherVehicle,
    /// An external force is not finite.
    #[error("damper {damper}: external force of {force_n} N, allowed: a finite number")]
    OutsideForce {
        /// Index of the damper, from 0.
        damper: usize,
        /// The force, N.
        force_n: f64,
    },
    /// The rails cannot carry a wheelset's load.
    #[error(
        "{wheelset}: load of {load_n} N, allowed: above 0 and at most what the rails carry when pressed down by 2 mm"
    )]
    NotCarried {
        /// Name of the wheelset.
        wheelset: String,
        /// Its load, N.
        load_n: f64,
    },
    /// The number of contacts is not the number of wheelsets.
    #[error("contacts: {contacts}, allowed: {wheelsets}, one for each wheelset")]
    Contacts {
        /// Number of contacts.
        contacts: usize,
        /// Number of wheelsets.
        wheelsets: usize,
    },
    /// The equations of motion contain a non-finite value, or the eigenvalue iteration does not converge.
    #[error(
        "the modes cannot be found: the values of stiffness, damping and mass are too far apart"
    )]
    NoModes,
    /// No element holds a body in one of its coordinates.
    #[error("{body}: free to move in {coordinate}; add an element that constrains it")]
    NotHeld {
        /// Name of the body.
        body: String,
        /// Name of the coordinate.
        coordinate: &'static str,
    },
    /// The springs hold a body, but not under its weight.
    #[error(
        "{body}: tips over at standstill, because its springs are too soft or too close together \
         for the height of its centre of gravity; make them stiffer or the centre lower"
    )]
    TipsOver {
        /// Name of the body that moves most.
        body: String,
    },
}

impl VehicleError {
    /// Checks that a value of `owner` is within its bounds. NaN never is.
    ///
    /// # Errors
    /// [`VehicleError::OutOfBounds`].
    pub fn check(
        owner: &str,
        name: &'static str,
        value: f64,
        allowed: [f64; 2],
    ) -> Result<(), Self> {
        if (allowed[0]..=allowed[1]).contains(&value) {
            return Ok(());
        }
        Err(Self::OutOfBounds {
            owner: owner.to_owned(),
            name,
            value,
            allowed,
        })
    }

    /// Returns the name of the invalid body, wheelset, element or ride point; `None` for errors of the whole vehicle.
    pub fn part(&self) -> Option<&str> {
        match self {
            Self::OutOfBounds { owner: part, .. }
            | Self::NameUsedTwice { name: part }
            | Self::NotThere { element: part, .. }
            | Self::NoSuchBody { point: part, .. }
            | Self::SameBody { element: part, .. }
            | Self::Ends { element: part, .. }
            | Self::Damper { element: part, .. }
            | Self::Stop { element: part, .. }
            | Self::FrictionSpring { element: part, .. }
            | Self::NotCarried { wheelset: part, .. }
            | Self::NotHeld { body: part, .. }
            | Self::TipsOver { body: part, .. } => Some(part),
            Self::NoWheelset
            | Self::StepTooLong { .. }
            | Self::ContactTooFast { .. }
            | Self::FrictionTooStiff { .. }
            | Self::NoSuchDamper { .. }
            | Self::NoSuchBodyIndex { .. }
            | Self::OtherVehicle
            | Self::OutsideForce { .. }
            | Self::NoBody
            | Self::Contacts { .. }
            | Self::NoModes => None,
        }
    }
}
