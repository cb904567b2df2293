//! Checked parameters: ranges, relations between parameters, and the resulting laws.

use core::ops::Deref;

use crate::error::BuildError;
use crate::hydraulics::Laws;
use crate::parameters::{
    DamperParameters, Element, Geometry, Hydraulics, Limits, Oil, Orifice, Reduced, Reservoir,
    Valve, require,
};

/// The laws of an element, ready to evaluate.
#[allow(clippy::large_enum_variant)] // one per damper, never in an array
#[derive(Clone, Debug)]
pub(crate) enum ElementLaws {
    /// Oil through orifice and valves.
    Physical(Laws),
    /// Damping coefficient and saturation velocity.
    Reduced(Reduced),
}

/// Checked parameters with solved shim packs, from which dampers and static laws are built.
///
/// ```
/// use dashpot_core::characteristic::Characteristic;
/// use dashpot_core::parameters::{DamperParameters, Mount};
/// use dashpot_core::Damper;
///
/// let checked = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6)).check()?;
/// let at_1_khz: Damper<f32> = checked.build(1e-3)?;
/// let at_10_khz: Damper<f32> = checked.build(1e-4)?;
/// assert_ne!(at_1_khz.revision(), at_10_khz.revision());
/// assert_eq!(Characteristic::new(&checked).force_n(0.01), 1200.0); // C v
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CheckedParameters {
    parameters: DamperParameters,
    pub(crate) laws: ElementLaws,
}

impl Deref for CheckedParameters {
    type Target = DamperParameters;

    fn deref(&self) -> &DamperParameters {
        &self.parameters
    }
}

impl DamperParameters {
    /// Checks every parameter and solves the shim packs.
    ///
    /// # Errors
    /// The first field that is out of range, with the range.
    ///
    /// ```
    /// use dashpot_core::parameters::{DamperParameters, Mount};
    ///
    /// let error = DamperParameters::reduced(120e3, 0.03, Mount::new(0.0)).check().unwrap_err();
    /// assert_eq!((error.section, error.field), ("mount", "stiffness_n_per_m"));
    /// assert_eq!(error.allowed, "1e4 to 1e12 N/m");
    /// ```
    pub fn check(&self) -> Result<CheckedParameters, BuildError> {
        self.mount.check_ranges("mount")?;
        self.limits.check_ranges("limits")?;
        let laws = match &self.element {
            Element::Physical(hydraulics) => {
                check_hydraulics(hydraulics)?;
                let laws = Laws::new(hydraulics);
                let limit = self.limits.force_n;
                let range = &Limits::RANGES.force_n;
                let min = 2.0 * laws.friction_n;
                let max = laws.max_force_n().unwrap_or(f64::INFINITY);
                // The error names a bound that depends on other parameters only if the force limit violates it.
                let bound = if range.contains(limit) && limit <= min {
                    Some(min)
                } else {
                    (limit > max).then_some(max)
                };
                require("limits", range, limit, bound.is_none())
                    .map_err(|error| BuildError { bound, ..error })?;
                ElementLaws::Physical(laws)
            }
            Element::Reduced(reduced) => {
                reduced.check_ranges("reduced")?;
                ElementLaws::Reduced(*reduced)
            }
        };
        Ok(CheckedParameters {
            parameters: self.clone(),
            laws,
        })
    }
}

fn check_hydraulics(hydraulics: &Hydraulics) -> Result<(), BuildError> {
    let Hydraulics {
        geometry,
        orifice,
        valves,
        leakage,
        relief,
        reservoir,
        seal,
        two_chamber,
        oil,
    } = hydraulics;
    geometry.check_ranges("geometry")?;
    let (rod, piston) = (geometry.rod_diameter_m, geometry.piston_diameter_m);
    let rod_fits = rod <= 0.95 * piston && (rod > 0.0 || two_chamber.is_none());
    require("geometry", &Geometry::RANGES.rod_diameter_m, rod, rod_fits)?;
    check_oil(oil)?;
    orifice.check_ranges("orifice")?;
    let bore = orifice.diameter_m;
    require("orifice", &Orifice::RANGES.diameter_m, bore, bore < piston)?;
    if let Some(leakage) = leakage {
        leakage.check_ranges("leakage")?;
    }
    if let Some(relief) = relief {
        relief.check_ranges("relief")?;
    }
    valves.piston_extension.check("valves.piston_extension")?;
    valves
        .piston_compression
        .check("valves.piston_compression")?;
    valves.foot_compression.check("valves.foot_compression")?;
    if let Some(reservoir) = reservoir {
        reservoir.check_ranges("reservoir")?;
        let gas_left = reservoir.volume_m3(geometry.rod_area()) >= 0.1 * reservoir.gas_volume_m3;
        let insertion = reservoir.rod_insertion_m;
        require(
            "reservoir",
            &Reservoir::RANGES.rod_insertion_m,
            insertion,
            gas_left,
        )?;
    }
    if let Some(seal) = seal {
        seal.check_ranges("seal")?;
    }
    if let Some(two_chamber) = two_chamber {
        two_chamber.check_ranges("two_chamber")?;
    }
    Ok(())
}

fn check_oil(oil: &Oil) -> Result<(), BuildError> {
    oil.check_ranges("oil")?;
    let hot = oil.viscosity_100c_m2_per_s;
    let thinner = hot < oil.viscosity_40c_m2_per_s;
    require("oil", &Oil::RANGES.viscosity_100c_m2_per_s, hot, thinner)?;
    match &oil.column {
        Some(column) => column.check_ranges("oil.column"),
        None => Ok(()),
    }
}

impl Valve {
    /// Checks the valve of `table`.
    pub(crate) fn check(&self, table: &'static str) -> Result<(), BuildError> {
        self.check_ranges(table)?;
        let (clamp, free) = (self.clamp_radius_m, self.free_radius_m);
        require(table, &Self::RANGES.free_radius_m, free, free > 0.0)?;
        let inside = clamp > 0.0 && clamp < free;
        require(table, &Self::RANGES.clamp_radius_m, clamp, inside)?;
        if self.edge_compliance_m_per_pa.is_some() {
            return Ok(());
        }
        // If no edge compliance is given, it is computed from the shims. This needs at least one shim and a clamp
        // radius within these bounds.
        let invalid = |field, value, allowed| Err(BuildError::new(table, field, value, allowed));
        if !(1e-3 * free..0.999 * free).contains(&clamp) {
            let key = Self::RANGES.clamp_radius_m.key;
            return invalid(key, clamp, "between 0.001 and 0.999 of free_radius_m");
        }
        if self.shims_m.is_empty() {
            let allowed = "1 to 16 shims when edge_compliance_m_per_pa is not given";
            return invalid(Self::RANGES.shims_m.key, 0.0, allowed);
        }
        Ok(())
    }
}
