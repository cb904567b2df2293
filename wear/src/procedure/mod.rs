//! A procedure that wears a pair of profiles over growing mileage: a documented example, and a source of worn pairs.
//!
//! The distance is divided into stages. In each stage, the contact of the pair is computed for every running condition
//! of a collective: the elastic contact under the wheel load, the creepages of a wheelset that rolls at its mean
//! radius, the creep forces of Polach's law. The wear of the conditions is added up by their shares of the distance.
//! The length of a stage follows from its maximum depth, so that the contact is updated as the profiles change. Then
//! the wear is removed from both profiles. The procedure has no random numbers.
//!
//! The rail meets many wheels while a wheel wears; [`Procedure::rail_part`] states its depth relative to that of the
//! wheel.

mod collective;
mod conditions;
mod family;
mod rail_position;

pub use collective::{Collective, Condition, Position};
pub use conditions::SearchError;
pub use family::{FAMILY, Member, family, family_of};

use dashpot_rail::contact::{
    ContactGeometry, GeometryError, Installation, Pair, PairError, Steel, SurfaceError,
};
use dashpot_rail::profile::{Body, Profile, ProfilePoint};

use crate::estimate::WearEstimate;
use crate::grid::WearGrid;
use crate::law::WearLaw;
use crate::removal::{RemovalError, removed};
use crate::wear::Wear;
use conditions::Running;
use rail_position::RailPosition;

/// Errors of the procedure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProcedureError {
    /// The profiles are no pair.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The steel is out of bounds.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The friction is out of bounds.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The wear cannot be removed.
    #[error(transparent)]
    Removal(#[from] RemovalError),
    /// A condition has no position.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// Nothing is worn: the conditions have no load or no friction work.
    #[error("collective: no wear, allowed: conditions with load, creepage and friction")]
    NoWear,
    /// The depth is not reached in [`MAX_STAGES`].
    #[error(
        "depth of wear: {depth_m} m, allowed: at most the {reached_m} m that {MAX_STAGES} stages reach"
    )]
    TooShallow {
        /// The depth reached, m.
        reached_m: f64,
        /// The depth required, m.
        depth_m: f64,
    },
}

/// Settings of the procedure.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Procedure {
    /// Distances between the wheels and between the rails.
    pub installation: Installation,
    /// Law of the wear of both bodies.
    pub law: WearLaw,
    /// Friction coefficient, dimensionless.
    pub friction: f64,
    /// Speed, m/s.
    pub speed_m_per_s: f64,
    /// Maximum depth removed from the wheel in a stage, m.
    pub stage_depth_m: f64,
    /// Maximum depth removed from the rail in a stage, as a part of that of the wheel.
    pub rail_part: f64,
    /// Length over which the depth is averaged, m; see [`WearEstimate::averaged`].
    pub averaging_m: f64,
    /// Wavelength whose amplitude the smoothing of the worn profile halves, m; see [`Profile::through`]. Plastic flow
    /// rounds the edges that wear alone would leave beside the contact.
    pub smoothing_m: f64,
}

impl Default for Procedure {
    /// Archard's law at 20 m/s with friction 0.3; stages of 0.15 mm; the rail wears 0.3 of the wheel; 5 mm of
    /// averaging.
    fn default() -> Self {
        Self {
            installation: Installation::default().with_wheel_radius_m(0.46),
            law: WearLaw::default(),
            friction: 0.3,
            speed_m_per_s: 20.0,
            stage_depth_m: 0.15e-3,
            rail_part: 0.3,
            averaging_m: 5e-3,
            smoothing_m: 4e-3,
        }
    }
}

/// Maximum number of stages until a depth is reached.
pub const MAX_STAGES: usize = 200;

/// A wheel and a rail after a distance.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct WornPair {
    /// The wheel's profile.
    pub wheel: Profile,
    /// The rail's profile.
    pub rail: Profile,
    /// The wheel's profile when it was new.
    pub new_wheel: Profile,
    /// Distance that the wheel has run in the conditions of the collective, m: an estimate.
    pub distance_m: f64,
}

impl WornPair {
    /// New profiles.
    pub fn new(wheel: Profile, rail: Profile) -> Self {
        Self {
            new_wheel: wheel.clone(),
            wheel,
            rail,
            distance_m: 0.0,
        }
    }

    /// Maximum depth lost by the wheel along the normal of the new profile, m.
    pub fn wheel_depth_m(&self) -> f64 {
        let inner = |point: &&ProfilePoint| libm::cos(point.angle_rad) > 0.3;
        let depth = |point: &ProfilePoint| {
            (point.z_m - self.wheel.at(point.y_m).z_m) * libm::cos(point.angle_rad)
        };
        let points = self.new_wheel.points().iter();
        points.filter(inner).map(depth).fold(0.0, f64::max)
    }
}

impl Procedure {
    /// Wears a pair in a collective until the wheel has lost `depth_m` somewhere.
    ///
    /// # Errors
    /// The profiles are no pair, the friction is out of bounds, nothing wears, a worn profile folds back, or
    /// [`MAX_STAGES`] do not reach the depth.
    ///
    /// ```
    /// use dashpot_rail::profile::{s1002, uic60};
    /// use dashpot_wear::procedure::{Collective, Procedure, WornPair};
    /// let new = WornPair::new(s1002::profile(), uic60::profile());
    /// let worn = Procedure::default().wear(&new, &Collective::straight(), 0.2e-3)?;
    /// // The tread loses 0.2 to 0.35 mm; the smoothing moves the flange by some micrometres.
    /// assert!((0.2e-3..0.35e-3).contains(&worn.wheel_depth_m()));
    /// assert!((worn.wheel.at(-0.05).z_m - new.wheel.at(-0.05).z_m).abs() < 20e-6);
    /// # Ok::<(), dashpot_wear::procedure::ProcedureError>(())
    /// ```
    pub fn wear(
        &self,
        pair: &WornPair,
        collective: &Collective,
        depth_m: f64,
    ) -> Result<WornPair, ProcedureError> {
        let mut worn = pair.clone();
        for _ in 0..MAX_STAGES {
            if worn.wheel_depth_m() >= depth_m {
                return Ok(worn);
            }
            worn = self.stage(&worn, collective)?;
        }
        Err(ProcedureError::TooShallow {
            reached_m: worn.wheel_depth_m(),
            depth_m,
        })
    }

    fn stage(&self, worn: &WornPair, collective: &Collective) -> Result<WornPair, ProcedureError> {
        let pair = Pair::new(worn.wheel.clone(), &worn.rail, self.installation)?;
        let geometry = ContactGeometry::new(pair, Steel::default())?;
        let running = Running::new(geometry, self.friction, self.speed_m_per_s)?;
        let on_rail = RailPosition::new(running.pair(), &worn.rail);
        let [mut wheel, mut rail] =
            [&worn.wheel, &worn.rail].map(|profile| Wear::new(WearGrid::new(profile), self.law));
        let shares: f64 = collective.conditions.iter().map(|one| one.share).sum();
        for condition in &collective.conditions {
            let distance_m = condition.share / shares;
            for patch in running.patches(condition)? {
                let rail_y_m = on_rail.profile_y_m(patch.track_y_m);
                wheel.add(patch.wheel_y_m, &patch.wearing, distance_m);
                rail.add(rail_y_m, &patch.wearing, distance_m);
            }
        }
        // Wear of a distance of 1 m.
        let radius_m = self.installation.wheel_radius_m;
        let on_wheel = wheel.of_wheel(radius_m).averaged(self.averaging_m);
        let on_rail = rail.of_rail(1.0).averaged(self.averaging_m);
        if on_wheel.max_depth_m <= 0.0 || on_rail.max_depth_m <= 0.0 {
            return Err(ProcedureError::NoWear);
        }
        let scaled = |wear: WearEstimate, depth_m: f64| {
            let factor = depth_m / wear.max_depth_m;
            wear.scaled(factor)
        };
        let distance_m = self.stage_depth_m / on_wheel.max_depth_m;
        let on_wheel = scaled(on_wheel, self.stage_depth_m);
        let on_rail = scaled(on_rail, self.rail_part * self.stage_depth_m);
        Ok(WornPair {
            wheel: self.removed(&worn.wheel, Body::Wheel, &on_wheel)?,
            rail: self.removed(&worn.rail, Body::Rail, &on_rail)?,
            distance_m: worn.distance_m + distance_m,
            new_wheel: worn.new_wheel.clone(),
        })
    }

    /// The profile without the wear, smoothed.
    fn removed(
        &self,
        profile: &Profile,
        body: Body,
        wear: &WearEstimate,
    ) -> Result<Profile, RemovalError> {
        let worn = removed(profile, body, wear)?;
        let points_m: Vec<[f64; 2]> = worn
            .points()
            .iter()
            .map(|point| [point.y_m, point.z_m])
            .collect();
        Ok(Profile::through(
            profile.name(),
            &points_m,
            self.smoothing_m,
        )?)
    }
}
