//! What a vehicle file says about the forces between a body and its two bogies.

use dashpot_rail::vehicle::{Body, Direction, Element, Law, RidePoint, VehicleParameters};

use super::error::SensorsError;
use super::law::Force;
use dashpot_recording::digest::sha256_of;

/// A vehicle as the balance of forces on its body sees it.
#[derive(Debug, Clone)]
pub struct Layout {
    /// Name of the vehicle.
    pub vehicle: String,
    /// Elements between body and bogies that the balance leaves out: friction, rods and stops.
    pub left_out: Vec<String>,
    /// Bodies: the car body, front bogie, rear bogie.
    pub(super) bodies: [Body; 3],
    pub(super) ride_points: Vec<RidePoint>,
    /// Lateral dampers, front ones first.
    pub(super) dampers: Vec<Connection>,
    pub(super) springs: Vec<Connection>,
    pub(super) yaw: Vec<Connection>,
    /// Lateral stops. The balance leaves out the seconds in which one is reached.
    pub(super) stops: Vec<Connection>,
    /// SHA-256 of the numbers that define the balance.
    pub(super) digest: String,
}

/// A force between a bogie and the body.
#[derive(Debug, Clone)]
pub(super) struct Connection {
    pub name: String,
    /// 0: front bogie, 1: rear bogie.
    pub bogie: usize,
    /// Position ahead of the body's centre of gravity, to the right, and height above the rails (m).
    pub at_m: [f64; 3],
    /// +1 if the force's displacement is that of the body from the bogie, -1 if it is that of the bogie from the body.
    pub sign: f64,
    pub force: Force,
}

impl Connection {
    /// True if the force has an arm about the middle and is not zero.
    fn resists_yaw(&self) -> bool {
        let is_nothing = matches!(
            self.force,
            Force::Linear {
                stiffness: 0.0,
                damping: 0.0
            }
        );
        self.at_m[1] != 0.0 && !is_nothing
    }
}

impl Layout {
    /// Finds the body, its bogies and the forces between them, and takes the ride points as sensors.
    ///
    /// # Errors
    /// The lateral dampers are not between one body and two bogies, or the parameters of a damper are invalid.
    pub fn new(vehicle: &VehicleParameters) -> Result<Self, SensorsError> {
        let bodies = bodies(vehicle)?;
        let mut layout = Self {
            vehicle: vehicle.name.clone(),
            left_out: Vec::new(),
            ride_points: vehicle.ride_points.clone(),
            dampers: Vec::new(),
            springs: Vec::new(),
            yaw: Vec::new(),
            stops: Vec::new(),
            digest: String::new(),
            bodies,
        };
        let on = |point: &RidePoint| layout.bodies.iter().any(|body| body.name == point.on);
        layout.ride_points.retain(on);
        let mut numbers = format!("{:?}", layout.bodies);
        for element in &vehicle.elements {
            if let Some((bogie, sign)) = layout.between(element) {
                numbers += &format!("{element:?}");
                layout.add(element, bogie, sign)?;
            }
        }
        layout.yaw.retain(Connection::resists_yaw);
        layout.dampers.sort_by_key(|damper| damper.bogie);
        numbers += &format!("{:?}", layout.ride_points);
        layout.digest = sha256_of(numbers.as_bytes());
        Ok(layout)
    }

    /// Names of the factors: springs, lateral dampers and yaw dampers, in the order of [`super::Factors::values`].
    ///
    /// ```
    /// use dashpot_calibration::vehicle_sensors::Layout;
    /// let layout = Layout::new(&dashpot_files::vehicle::load("locomotive", &[])?)?;
    /// let names = layout.factor_names();
    /// assert_eq!((names.len(), &*names[0], &*names[2]), (8, "front bogie springs", "front lateral damper 1"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn factor_names(&self) -> Vec<String> {
        let bogie = |bogie: usize| &*self.bodies[1 + bogie].name;
        let springs = [0, 1].map(|number| format!("{} springs", bogie(number)));
        let dampers = self.dampers.iter().map(|damper| damper.name.clone());
        let yaw = self
            .yaw_bogies()
            .map(|number| format!("{} yaw", bogie(number)));
        springs.into_iter().chain(dampers).chain(yaw).collect()
    }

    /// Bogies that have springs or dampers against yaw.
    pub(super) fn yaw_bogies(&self) -> impl Iterator<Item = usize> + '_ {
        [0, 1]
            .into_iter()
            .filter(|bogie| self.yaw.iter().any(|force| force.bogie == *bogie))
    }

    /// Number of the bogie that `element` connects with the body, and its sign.
    fn between(&self, element: &Element) -> Option<(usize, f64)> {
        let [body, front, rear] = self.bodies.each_ref().map(|body| Some(&*body.name));
        let [first, second] = element.ends.each_ref().map(|end| end.on.as_deref());
        let (bogie, sign) = match (first == body, second == body) {
            (false, true) => (first, 1.0),
            (true, false) => (second, -1.0),
            _ => return None,
        };
        [front, rear]
            .iter()
            .position(|name| *name == bogie)
            .map(|bogie| (bogie, sign))
    }

    fn add(&mut self, element: &Element, bogie: usize, sign: f64) -> Result<(), SensorsError> {
        let [x, y, height] = element.ends[0].at_m;
        let connection = |force: Force| Connection {
            name: element.name.clone(),
            bogie,
            at_m: [x - self.bodies[0].x_m, y, height],
            sign,
            force,
        };
        let linear = |stiffness: f64, damping: f64| Force::Linear { stiffness, damping };
        match &element.law {
            Law::SpringDamper {
                stiffness_n_per_m: k,
                damping_n_s_per_m: c,
            }
            | Law::Bush {
                stiffness_n_per_m: k,
                damping_n_s_per_m: c,
                ..
            } => {
                self.springs.push(connection(linear(k[1], c[1])));
                self.yaw.push(connection(linear(k[0], c[0])));
                if let Law::Bush {
                    stiffness_n_m_per_rad: k,
                    damping_n_m_s_per_rad: c,
                    ..
                } = &element.law
                {
                    // A moment is a force with an arm of 1 m.
                    let mut twist = connection(linear(k[2], c[2]));
                    twist.at_m[1] = 1.0;
                    self.yaw.push(twist);
                }
            }
            Law::Damper {
                direction: Direction::Lateral,
                parameters,
            } => {
                self.dampers
                    .push(connection(Force::damper(&element.name, parameters)?));
            }
            Law::Damper {
                direction: Direction::Longitudinal,
                parameters,
            } => {
                self.yaw
                    .push(connection(Force::damper(&element.name, parameters)?));
            }
            Law::BumpStop {
                direction: Direction::Lateral,
                points,
            } => {
                let gap_m = points.first().map_or(0.0, |point| point[0]);
                self.stops.push(connection(Force::Stop { gap_m }));
            }
            Law::Friction {
                direction: Direction::Lateral | Direction::Longitudinal,
                ..
            }
            | Law::BumpStop {
                direction: Direction::Longitudinal,
                ..
            }
            | Law::TractionRod { .. } => self.left_out.push(element.name.clone()),
            _ => {}
        }
        Ok(())
    }
}

/// Returns the body and its front and rear bogie: those between which all lateral dampers are.
fn bodies(vehicle: &VehicleParameters) -> Result<[Body; 3], SensorsError> {
    let is_lateral = |law: &Law| {
        matches!(
            law,
            Law::Damper {
                direction: Direction::Lateral,
                ..
            }
        )
    };
    let dampers: Vec<_> = vehicle
        .elements
        .iter()
        .filter(|element| is_lateral(&element.law))
        .collect();
    let found = |found: String| Err(SensorsError::Vehicle { found });
    let Some(first) = dampers.first() else {
        return found(format!("{} has no lateral damper", vehicle.name));
    };
    let is_on = |element: &Element, body: &Body| {
        element
            .ends
            .iter()
            .any(|end| end.on.as_deref() == Some(&*body.name))
    };
    let is_shared = |body: &&Body| dampers.iter().all(|damper| is_on(damper, body));
    let mut shared = vehicle.bodies.iter().filter(is_shared);
    let (Some(body), None) = (shared.next(), shared.next()) else {
        return found(format!(
            "the lateral dampers of {} are not all on one body",
            vehicle.name
        ));
    };
    let others = vehicle.bodies.iter().filter(|other| {
        other.name != body.name && dampers.iter().any(|damper| is_on(damper, other))
    });
    let mut bogies: Vec<&Body> = others.collect();
    bogies.sort_by(|one, other| other.x_m.total_cmp(&one.x_m));
    let ends = dampers.iter().flat_map(|damper| &damper.ends);
    let known = ends.clone().all(|end| {
        let on = end.on.as_deref();
        on == Some(&body.name) || bogies.iter().any(|bogie| on == Some(&bogie.name))
    });
    match (&*bogies, known) {
        ([front, rear], true) if front.x_m > body.x_m && rear.x_m < body.x_m => {
            Ok([body.clone(), (*front).clone(), (*rear).clone()])
        }
        ([_, _], true) => found(format!("{} is not between two bogies", body.name)),
        _ => {
            let first = &first.name;
            found(format!(
                "lateral dampers such as {first} connect {} with {} bodies",
                body.name,
                bogies.len()
            ))
        }
    }
}
