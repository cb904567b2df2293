//! Whether the force of the contact jumps: from one pose to the next by more than the stiffness of the contact allows.

use crate::contact::geometry::ContactGeometry;
use crate::contact::silhouette::{SilhouettePoint, TurnedWheel, WheelPose};
use crate::contact::tables::patch::TabulatedPatch;
use crate::contact::zones::ZONES;

/// Loads at which the force is compared, in nominal loads.
const LOADS: [f64; 2] = [0.5, 1.0];

/// Shift over which the stiffness of the contact allows a change of the force, m: the distance of neighbouring nodes in the fine part of
/// the default [`Grid`](super::Grid), which blurs a change over as much.
const ALLOWED_SHIFT_M: f64 = 30e-6;

/// Part of the load by which the force of tables may jump beyond what the stiffness allows. docs/contact.md says how it was chosen.
pub const MAX_JUMP: f64 = 0.3;

/// Smallest change between neighbouring nodes, beyond what the stiffness allows, whose cause is looked for, over the load.
const SUSPECT: f64 = 0.02;

/// Distance of two poses at which a change of the force that is left is a jump, m: the distance of neighbouring nodes is halved until
/// then.
const NEAR_M: f64 = 0.03e-6;

/// Halvings that bring shifts of a kilometre so near; a wider grid has no contact.
const MAX_HALVINGS: usize = 35;

/// Depth below the first touch at which a wheel carries every load, m.
const DEEPEST_M: f64 = 3e-3;

/// A jump of the force on a wheel that is shifted over its rail at a constant height.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Jump {
    /// Where it jumps.
    pub pose: WheelPose,
    /// Vertical force before it jumps, N.
    pub load_n: f64,
    /// By how much it jumps, N.
    pub jump_n: f64,
    /// By how much it may change there: the stiffness of the contact, times the slope of the surfaces, times a shift of 30 um, N.
    pub allowed_n: f64,
}

impl Jump {
    /// What the jump has beyond what the stiffness allows, over the load; negative for one that is allowed.
    pub fn excess(&self) -> f64 {
        (self.jump_n - self.allowed_n) / self.load_n
    }

    /// The greatest jump along rising shifts, for a wheel that is turned already: `nodes` are shifts with its patches there.
    /// `None` if the force changes between no two nodes by more than the stiffness allows.
    pub(super) fn greatest(
        geometry: &ContactGeometry,
        wheel: &TurnedWheel<'_>,
        yaw_rad: f64,
        nodes: &[(f64, [TabulatedPatch; ZONES])],
        scratch: &mut Vec<SilhouettePoint>,
    ) -> Option<Self> {
        let mut greatest: Option<Self> = None;
        for part in LOADS {
            let load_n = part * geometry.nominal_load_n();
            let mut poses = nodes
                .iter()
                .map(|(lateral_m, patches)| Loaded::new(*lateral_m, *patches, load_n));
            let Some(mut before) = poses.next() else {
                continue;
            };
            for after in poses {
                let change = before.change_to(&after);
                let allowed_n = change.allowed_n(after.lateral_m - before.lateral_m);
                if change.force_n - allowed_n > SUSPECT * load_n {
                    let (lateral_m, change) =
                        narrowed(geometry, wheel, [&before, &after], load_n, scratch);
                    let pose = WheelPose {
                        lateral_m,
                        roll_rad: wheel.roll_rad,
                        yaw_rad,
                    };
                    let found = Self {
                        pose,
                        load_n,
                        jump_n: change.force_n,
                        allowed_n: change.allowed_n(ALLOWED_SHIFT_M),
                    };
                    greatest = Some(greatest.map_or(found, |greatest| greatest.greater(found)));
                }
                before = after;
            }
        }
        greatest
    }

    /// The one with the greater excess; the first of equal ones.
    pub(super) fn greater(self, other: Self) -> Self {
        if other.excess() > self.excess() {
            other
        } else {
            self
        }
    }
}

/// Halves the distance of two poses again and again, towards the greater change: where it is, and how great it is in the end.
fn narrowed(
    geometry: &ContactGeometry,
    wheel: &TurnedWheel<'_>,
    ends: [&Loaded; 2],
    load_n: f64,
    scratch: &mut Vec<SilhouettePoint>,
) -> (f64, Change) {
    let [mut before, mut after] = ends.map(Loaded::clone);
    let mut change = before.change_to(&after);
    for _ in 0..MAX_HALVINGS {
        if after.lateral_m - before.lateral_m <= NEAR_M {
            break;
        }
        let lateral_m = 0.5 * (before.lateral_m + after.lateral_m);
        let patches = geometry.patches_of(wheel, lateral_m, scratch);
        let middle = Loaded::new(lateral_m, patches, load_n);
        let [first, second] = [before.change_to(&middle), middle.change_to(&after)];
        if first.force_n > second.force_n {
            (after, change) = (middle, first);
        } else {
            (before, change) = (middle, second);
        }
    }
    (after.lateral_m, change)
}

/// A wheel at a shift, at the height at which it carries a load.
#[derive(Clone)]
struct Loaded {
    lateral_m: f64,
    patches: [TabulatedPatch; ZONES],
    /// Depth of the tread datum below the rail's top, m; none where the rail carries the load at no depth.
    depth_m: Option<f64>,
}

/// Change of the vertical force between two poses.
#[derive(Clone, Copy, Default)]
struct Change {
    /// Its magnitude, N.
    force_n: f64,
    /// Stiffness times slope: how far the force may change with the shift, N/m.
    allowed_n_per_m: f64,
}

impl Change {
    fn allowed_n(&self, shift_m: f64) -> f64 {
        self.allowed_n_per_m * shift_m
    }
}

impl Loaded {
    fn new(lateral_m: f64, patches: [TabulatedPatch; ZONES], load_n: f64) -> Self {
        let heights = patches.iter().map(|patch| patch.interpenetration_m);
        let touch = -heights.fold(f64::MIN, f64::max);
        let force = |depth: f64| Vertical::new(&patches, depth).force_n;
        let (mut low, mut high) = (touch, touch + DEEPEST_M);
        let depth_m = (force(high) >= load_n).then(|| {
            // To a picometre.
            for _ in 0..32 {
                let middle = 0.5 * (low + high);
                if force(middle) < load_n {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            high
        });
        Self {
            lateral_m,
            patches,
            depth_m,
        }
    }

    /// The greater change of the force at the height of either pose; none where one of them does not carry the load.
    fn change_to(&self, other: &Self) -> Change {
        let (Some(here), Some(there)) = (self.depth_m, other.depth_m) else {
            return Change::default();
        };
        let [own, moved] = [self, other].map(|pose| Vertical::new(&pose.patches, here));
        let [back, others] = [self, other].map(|pose| Vertical::new(&pose.patches, there));
        let all = [&own, &moved, &back, &others];
        let most = |of: fn(&Vertical) -> f64| all.iter().map(|one| of(one)).fold(0.0, f64::max);
        Change {
            force_n: (moved.force_n - own.force_n)
                .abs()
                .max((others.force_n - back.force_n).abs()),
            allowed_n_per_m: most(|one| one.stiffness_n_per_m) * most(|one| one.slope),
        }
    }
}

/// The vertical force of all patches at a depth.
#[derive(Default)]
struct Vertical {
    force_n: f64,
    stiffness_n_per_m: f64,
    /// The steepest of the loaded patches: as much does a patch penetrate more for each metre of shift.
    slope: f64,
}

impl Vertical {
    fn new(patches: &[TabulatedPatch; ZONES], depth_m: f64) -> Self {
        let mut sum = Self::default();
        for patch in patches {
            let cosine = 1.0 / (1.0 + patch.slope * patch.slope).sqrt();
            let penetration = (patch.interpenetration_m + depth_m) * cosine;
            if penetration > 0.0 {
                let load = patch.load_fraction * patch.hertz.load_n(penetration);
                sum.force_n += load * cosine;
                sum.stiffness_n_per_m += 1.5 * load / penetration * cosine * cosine;
                sum.slope = sum.slope.max(patch.slope.abs());
            }
        }
        sum
    }
}
