//! Actuator files: the actuator of a rig, its limits and its sensors. TOML in SI units.

mod bounds;
mod error;
mod law;
mod sensor;

pub use bounds::Bound;
use bounds::of_table;
pub use error::ActuatorFileError;
pub use law::{ActuatorLaw, Coupled, SecondOrder, ServoHydraulic};
pub use sensor::{DisplacementSensor, ForceSensor};
use serde::Deserialize;

use crate::overrides::explain;
use crate::shipped::{Found, Shipped};

/// Built-in actuators: name and text.
pub const ACTUATORS: [(&str, &str); 4] = [
    ("servo", include_str!("../../data/actuators/servo.toml")),
    (
        "second-order",
        include_str!("../../data/actuators/second-order.toml"),
    ),
    ("slow", include_str!("../../data/actuators/slow.toml")),
    (
        "benchmark",
        include_str!("../../data/actuators/benchmark.toml"),
    ),
];

const SHIPPED: Shipped = Shipped {
    kind: "actuator",
    built_in: "shipped actuator",
    texts: &ACTUATORS,
};

/// The actuator of a rig with its sensors.
#[derive(Debug, Clone, PartialEq)]
pub struct ActuatorParameters {
    /// Name.
    pub name: String,
    /// Largest motion and force.
    pub limits: ActuatorLimits,
    /// How it follows its command.
    pub law: ActuatorLaw,
    /// Sensor of the displacement.
    pub displacement_sensor: DisplacementSensor,
    /// Sensor of the force.
    pub force_sensor: ForceSensor,
}

/// Tables of the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ActuatorTables {
    name: String,
    limits: ActuatorLimits,
    coupled: Option<Coupled>,
    second_order: Option<SecondOrder>,
    servo_hydraulic: Option<ServoHydraulic>,
    #[serde(default)]
    displacement_sensor: DisplacementSensor,
    #[serde(default)]
    force_sensor: ForceSensor,
}

/// Largest motion and force of an actuator, in either direction.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ActuatorLimits {
    /// Displacement from the middle (m).
    pub stroke_m: f64,
    /// Velocity (m/s).
    pub velocity_m_per_s: f64,
    /// Force (N).
    pub force_n: f64,
}

impl ActuatorParameters {
    /// Loads the actuator called `name`: a built-in one, or the TOML file at that path (`-` for standard input).
    ///
    /// # Errors
    /// There is no such actuator or readable file, the text is not TOML, a key is unknown or missing, or a value is out
    /// of range.
    ///
    /// ```
    /// let actuator = dashpot_files::actuator::ActuatorParameters::load("servo")?;
    /// assert_eq!(actuator.limits.stroke_m, 0.1);
    /// # Ok::<(), dashpot_files::actuator::ActuatorFileError>(())
    /// ```
    pub fn load(name: &str) -> Result<Self, ActuatorFileError> {
        let Found { name, text, .. } = SHIPPED.find::<ActuatorFileError>(name)?;
        Self::parse(&name, &text)
    }

    /// Parses the actuator in `text`; error messages call it `name`.
    ///
    /// # Errors
    /// Same errors as [`Self::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ActuatorFileError> {
        let in_text = |message: String| ActuatorFileError::Text {
            name: name.to_owned(),
            message,
        };
        let tables: ActuatorTables =
            toml::from_str(text).map_err(|error| in_text(explain(&error)))?;
        let laws = [
            tables.coupled.map(ActuatorLaw::Coupled),
            tables.second_order.map(ActuatorLaw::SecondOrder),
            tables.servo_hydraulic.map(ActuatorLaw::ServoHydraulic),
        ];
        let mut given = laws.into_iter().flatten();
        let (Some(law), None) = (given.next(), given.next()) else {
            return Err(in_text(
                "allowed: one of the tables [coupled], [second_order] and [servo_hydraulic]".into(),
            ));
        };
        let parameters = Self {
            name: tables.name,
            limits: tables.limits,
            law,
            displacement_sensor: tables.displacement_sensor,
            force_sensor: tables.force_sensor,
        };
        match parameters.check() {
            Ok(()) => Ok(parameters),
            Err(bound) => Err(ActuatorFileError::Value {
                name: name.to_owned(),
                bound,
            }),
        }
    }

    /// Checks all values.
    ///
    /// # Errors
    /// The first value that is not allowed.
    pub fn check(&self) -> Result<(), Bound> {
        let broken = self.bounds().find(|bound| !bound.is_kept());
        broken.map_or(Ok(()), Err)
    }

    /// All values with their allowed ranges.
    fn bounds(&self) -> impl Iterator<Item = Bound> + use<> {
        let ActuatorLimits {
            stroke_m,
            velocity_m_per_s,
            force_n,
        } = self.limits;
        let limits = of_table(
            "limits",
            [
                ("stroke_m", stroke_m, 1e-3, 1.0),
                ("velocity_m_per_s", velocity_m_per_s, 1e-3, 10.0),
                ("force_n", force_n, 1.0, 1e7),
            ],
        );
        let law = match &self.law {
            ActuatorLaw::Coupled(law) => law.bounds(),
            ActuatorLaw::SecondOrder(law) => law.bounds(),
            ActuatorLaw::ServoHydraulic(law) => law.bounds(),
        };
        let sensors = [
            self.displacement_sensor.bounds(),
            self.force_sensor.bounds(),
        ];
        limits
            .into_iter()
            .chain(law)
            .chain(sensors.into_iter().flatten())
    }
}
