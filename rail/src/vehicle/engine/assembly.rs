//! Assembles the constants of a vehicle from its parameters.

use std::sync::Arc;

use dashpot_core::{Damper, DamperParameters};
use nalgebra::DMatrix;

use super::across::{Across, DamperElement, StopElement};
use super::block::N;
use super::friction::{self, FrictionElement, Standing};
use super::guidance::BodyPosition;
use super::identity::Identity;
use super::method::{Method, OnContact};
use super::rail_equations::RailEquations;
use super::rails::{self, RailSupport};
use super::shape::Shape;
use super::springs::Springs;
use super::structure::Structure;
use super::tangent::{KALKER, SurfaceConstants};
use super::{ContactBodies, STEP_S, Vehicle, WheelsetConstants};
use crate::contact::{PatchSource, WheelsetContact};
use crate::creep::CreepLaw;
use crate::math::dispatch::dispatch;
use crate::vehicle::carried::Carried;
use crate::vehicle::element::Law;
use crate::vehicle::error::VehicleError;
use crate::vehicle::linear::Linear;
use crate::vehicle::parameters::VehicleParameters;
use crate::vehicle::standstill::{Standstill, attach, wheelset_bodies};

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Builds the vehicle with `contact` on all wheelsets, for ticks of `step_s`.
    ///
    /// # Errors
    /// Those of [`Standstill::new`], a step that is out of bounds or too long for the stiffness of the elements, a
    /// wheelset that the rails cannot carry, or no wheelset.
    pub fn new(
        parameters: &VehicleParameters,
        contact: Arc<WheelsetContact<L, S>>,
        step_s: f64,
    ) -> Result<Self, VehicleError> {
        Self::on_rails(parameters, contact, step_s, None)
    }

    /// Builds the vehicle on elastically supported rails, or on rigid rails if `support` is `None`.
    ///
    /// # Errors
    /// Those of [`Vehicle::new`] and [`RailSupport::check`].
    pub fn on_rails(
        parameters: &VehicleParameters,
        contact: Arc<WheelsetContact<L, S>>,
        step_s: f64,
        support: Option<RailSupport>,
    ) -> Result<Self, VehicleError> {
        let contacts = vec![contact; parameters.wheelsets.len()];
        Self::with_contacts(parameters, contacts, step_s, support)
    }

    /// Builds the vehicle like [`Vehicle::on_rails`], with a contact for each wheelset. Equal wheelsets should share
    /// one.
    ///
    /// # Errors
    /// Those of [`Vehicle::on_rails`], or the number of contacts differs from that of the wheelsets.
    pub fn with_contacts(
        parameters: &VehicleParameters,
        contacts: Vec<Arc<WheelsetContact<L, S>>>,
        step_s: f64,
        support: Option<RailSupport>,
    ) -> Result<Self, VehicleError> {
        VehicleError::check(&parameters.name, "step_s", step_s, STEP_S)?;
        let standstill = Standstill::new(parameters)?;
        if parameters.wheelsets.is_empty() {
            return Err(VehicleError::NoWheelset);
        }
        if contacts.len() != parameters.wheelsets.len() {
            return Err(VehicleError::Contacts {
                contacts: contacts.len(),
                wheelsets: parameters.wheelsets.len(),
            });
        }
        let mut bodies = parameters.bodies.clone();
        bodies.extend(wheelset_bodies(parameters));
        let mut linear = Linear::new(&bodies);
        let mut on_track = Linear::new(&bodies);
        let (mut dampers, mut stops, mut frictions) = (Vec::new(), Vec::new(), Vec::new());
        let mut stuck = Linear::new(&bodies);
        let attached = attach(parameters, true)?;
        for ((element, (ends, line)), force) in parameters
            .elements
            .iter()
            .zip(&attached)
            .zip(standstill.forces())
        {
            match &element.law {
                Law::Damper {
                    direction,
                    parameters,
                } => dampers.push(DamperElement {
                    name: element.name.clone(),
                    across: Across::new(&linear, ends, direction.axis()),
                    damper: build(&element.name, parameters, step_s)?,
                }),
                Law::BumpStop { direction, points } => stops.push(StopElement {
                    across: Across::new(&linear, ends, direction.axis()),
                    points: points.clone(),
                }),
                Law::Friction { .. } => {
                    stuck.add_sticking(element, ends);
                    let standing = Standing {
                        linear: &linear,
                        elements: &parameters.elements,
                        attached: &attached,
                        forces: standstill.forces(),
                    };
                    frictions.extend(FrictionElement::new(element, ends, &standing));
                }
                _ => {
                    linear.add(element, ends, *line);
                    linear.add_preload(ends, *force);
                    if ends.iter().any(|end| end.body.is_none()) {
                        on_track.add(element, ends, *line);
                        on_track.add_preload(ends, *force);
                    }
                }
            }
        }
        friction::check_stiffness(&stuck, step_s)?;
        let (first, count) = (parameters.bodies.len(), parameters.wheelsets.len());
        if let Some(support) = support {
            support.check()?;
            support.append(count, &mut linear);
        }
        let on_springs_rad_per_s = linear.fastest_rad_per_s();
        let Linear {
            inertia,
            stiffness,
            damping,
            ..
        } = linear;
        let with_contacts = parameters.wheelsets.iter().zip(&contacts);
        let carried = with_contacts
            .zip(standstill.axle_loads_n())
            .map(|((wheelset, contact), load_n)| {
                Carried::new(contact, *load_n).ok_or_else(|| VehicleError::NotCarried {
                    wheelset: wheelset.name.clone(),
                    load_n: *load_n,
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        let on_contacts: Vec<OnContact> = parameters
            .wheelsets
            .iter()
            .zip(
                contacts
                    .iter()
                    .zip(standstill.axle_loads_n().iter().zip(&carried)),
            )
            .map(|(wheelset, (contact, (load_n, carried)))| {
                let of_wheel_kg = 0.5 * wheelset.mass_kg;
                OnContact {
                    mass_kg: support
                        .map_or(of_wheel_kg, |rail| rail.least_mass_kg().min(of_wheel_kg)),
                    stiffness_n_per_m: carried.wheel_stiffness_n_per_m,
                    damping_n_s_per_m: 0.5 * load_n * contact.normal_damping_s_per_m(),
                    creep_n: KALKER * contact.shear_modulus_pa() * carried.wheel_axes_m2,
                }
            })
            .collect();
        let method = Method::new(step_s, &on_contacts, on_springs_rad_per_s)?;
        let system = DMatrix::from_diagonal(&inertia)
            + &damping * method.damping_weight()
            + &stiffness * method.stiffness_weight();
        let rails_of = |number: usize| support.is_some().then_some(first + count + number);
        let diagonal = |body: usize| std::array::from_fn(|i| system[(N * body + i, N * body + i)]);
        let rails = (0..count)
            .filter_map(rails_of)
            .map(|rails| RailEquations::uncoupled(diagonal(rails)))
            .collect();
        let size = N * bodies.len();
        let system = system.view((0, 0), (size, size)).into_owned();
        let structure = Structure::new(&system);
        let system = structure.blocks(&system);
        let level = crate::math::level();
        if !dispatch!(level, simd => structure.factorise(simd, &mut system.clone())) {
            return Err(VehicleError::StepTooLong { step_s });
        }
        let mut wheelsets = Vec::with_capacity(count);
        let with_contacts = parameters.wheelsets.iter().zip(&contacts);
        for (number, (wheelset, contact)) in with_contacts.enumerate() {
            let carried = carried[number];
            wheelsets.push(WheelsetConstants {
                bodies: ContactBodies {
                    wheelset: first + number,
                    rails: rails_of(number),
                },
                surface: SurfaceConstants {
                    shear_modulus_pa: contact.shear_modulus_pa(),
                    normal_damping_s_per_m: contact.normal_damping_s_per_m(),
                },
                standing_n: rails::standing_n(&carried.wheel_forces_n),
                carried,
                axle_load_n: standstill.axle_loads_n()[number],
                spin_inertia_kg_m2: wheelset.inertia_kg_m2[1],
            });
        }
        let is_held = on_track.stiffness.amax() > 0.0 || on_track.damping.amax() > 0.0;
        let mut vehicle = Self {
            identity: Identity::new(parameters, step_s, support.as_ref()),
            shape: Shape::default(),
            step_s,
            method,
            contacts,
            level,
            width: crate::math::width(),
            names: bodies.iter().map(|body| body.name.clone()).collect(),
            positions: bodies
                .iter()
                .map(|body| BodyPosition {
                    x_m: body.x_m,
                    height_m: body.height_m,
                })
                .collect(),
            wheelsets,
            inertia: (0..inertia.len() / N)
                .map(|body| std::array::from_fn(|i| inertia[N * body + i]))
                .collect(),
            springs: Springs::new(&stiffness, &damping),
            on_track: is_held.then(|| Springs::new(&on_track.stiffness, &on_track.damping)),
            structure,
            system,
            rails,
            dampers,
            stops,
            frictions,
        };
        vehicle.shape = vehicle.undisplaced(0.0, 0.0).shape();
        Ok(vehicle)
    }
}

pub(super) fn build(
    element: &str,
    parameters: &DamperParameters,
    step_s: f64,
) -> Result<Damper<f64>, VehicleError> {
    parameters
        .build(step_s)
        .map_err(|source| VehicleError::Damper {
            element: element.to_owned(),
            source: Box::new(source),
        })
}
