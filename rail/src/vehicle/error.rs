//! Why a vehicle is refused.

/// Why a vehicle is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleError {
    /// A number is out of bounds.
    #[error("{owner}: {name} = {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Body, wheelset, element or ride point.
        owner: String,
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Smallest and greatest allowed value.
        allowed: [f64; 2],
    },
    /// Two parts have the same name.
    #[error(
        "{name}: used twice; every body, wheelset, element and ride point has a name of its own"
    )]
    NameUsedTwice {
        /// The name.
        name: String,
    },
    /// An element is attached to something that there is not.
    #[error("{element}: attached to {to}, which there is not; there are {}", .names.join(", "))]
    NotThere {
        /// The element.
        element: String,
        /// What it is attached to.
        to: String,
        /// What there is.
        names: Vec<String>,
    },
    /// A ride point is on a body that there is not.
    #[error("{point}: on {on}, which is no body; there are {}", .names.join(", "))]
    NoSuchBody {
        /// The ride point.
        point: String,
        /// What it is on.
        on: String,
        /// The bodies.
        names: Vec<String>,
    },
    /// Both ends of an element are on the same body.
    #[error("{element}: both ends are on {on}")]
    SameBody {
        /// The element.
        element: String,
        /// The body.
        on: String,
    },
    /// The ends of an element do not lie as its law needs them.
    #[error("{element}: {reason}")]
    Ends {
        /// The element.
        element: String,
        /// What is wrong, and what is allowed.
        reason: &'static str,
    },
    /// A damper is refused.
    #[error("{element}: {source}")]
    Damper {
        /// The element.
        element: String,
        /// What is wrong with its parameters.
        source: Box<dashpot_core::BuildError>,
    },
    /// The points of a stop are no stop.
    #[error("{element}: points of a stop: allowed: {reason}")]
    Stop {
        /// The element.
        element: String,
        /// What is allowed.
        reason: &'static str,
    },
    /// There is nothing that could move.
    #[error("no body: a vehicle has one at least")]
    NoBody,
    /// Nothing rolls.
    #[error("no wheelset: a vehicle that runs has one at least")]
    NoWheelset,
    /// A step is too long for what softens with the load.
    #[error("step_s = {step_s}: too long for this vehicle; give a shorter one")]
    StepTooLong {
        /// The step, s.
        step_s: f64,
    },
    /// There are not so many dampers.
    #[error("damper {damper}: the vehicle has {dampers}, counted from 0")]
    NoSuchDamper {
        /// The number.
        damper: usize,
        /// How many there are.
        dampers: usize,
    },
    /// There are not so many bodies.
    #[error("body {body}: the vehicle has {bodies} bodies and wheelsets, counted from 0")]
    NoBodyOfNumber {
        /// The number.
        body: usize,
        /// How many there are.
        bodies: usize,
    },
    /// A state belongs to another vehicle.
    #[error(
        "the state belongs to another vehicle; allowed: a state of a vehicle with the same parameters, step and rails"
    )]
    OtherVehicle,
    /// A force from outside is not finite.
    #[error("damper {damper}: a force of {force_n} N from outside, allowed: a finite number")]
    OutsideForce {
        /// The damper.
        damper: usize,
        /// The force, N.
        force_n: f64,
    },
    /// The rails do not carry a wheelset.
    #[error(
        "{wheelset}: a load of {load_n} N, allowed: above 0 and what wheel and rail carry within 2 mm"
    )]
    NotCarried {
        /// The wheelset.
        wheelset: String,
        /// Its load, N.
        load_n: f64,
    },
    /// The equations of motion have a number that is not finite, or the iteration for the eigenvalues does not converge.
    #[error("the modes cannot be found: stiffnesses, damping and masses are too far apart")]
    NoModes,
    /// A body is not held against its weight or against moving away.
    #[error("{body}: not held in {coordinate}; add an element that holds it")]
    NotHeld {
        /// The body.
        body: String,
        /// The coordinate that nothing holds.
        coordinate: &'static str,
    },
}

impl VehicleError {
    /// Checks that a number of `owner` is within its bounds; NaN is not.
    ///
    /// # Errors
    /// It is not.
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

    /// The body, wheelset, element or ride point that is wrong, where it is one.
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
            | Self::NotCarried { wheelset: part, .. }
            | Self::NotHeld { body: part, .. } => Some(part),
            Self::NoWheelset
            | Self::StepTooLong { .. }
            | Self::NoSuchDamper { .. }
            | Self::NoBodyOfNumber { .. }
            | Self::OtherVehicle
            | Self::OutsideForce { .. }
            | Self::NoBody
            | Self::NoModes => None,
        }
    }
}
