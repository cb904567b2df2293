//! Detection of jumps: changes of the contact force between neighbouring poses that the contact stiffness does not
//! explain.

use crate::contact::geometry::ContactGeometry;
use crate::contact::silhouette::{SilhouettePoint, TurnedWheel, WheelPose};
use crate::contact::tabulated_patch::TabulatedPatch;
use crate::contact::zones::ZONES;

/// Loads at which the force is compared, as fractions of the nominal load.
const LOADS: [f64; 2] = [0.5, 1.0];

/// Shift over which the change of force due to the contact stiffness is not counted as part of a jump, m. It is the
/// node distance in the fine part of the default [`Grid`](super::Grid), over which interpolation blurs a jump anyway.
const ALLOWED_SHIFT_M: f64 = 30e-6;

/// Maximum [`Jump::excess`] of tables, as a fraction of the load; docs/contact.md explains the choice.
pub const MAX_JUMP: f64 = 0.3;

/// Threshold above which the interval between two nodes is searched for a jump: the change of force that the stiffness
/// does not explain, as a fraction of the load.
const SUSPECT: f64 = 0.02;

/// Length of a shift interval, m, over which a remaining change of the force counts as a jump. Intervals are halved
/// down to this length.
const NEAR_M: f64 = 0.03e-6;

/// Maximum number of halvings. They suffice for an interval of a kilometre, which is far wider than any contact.
const MAX_HALVINGS: usize = 35;

/// Depth below first contact that suffices for any load, m.
const DEEPEST_M: f64 = 3e-3;

/// A jump of the force on a wheel that moves laterally over its rail at constant height.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Jump {
    /// Pose at which the force jumps.
    pub pose: WheelPose,
    /// Vertical force before the jump, N.
    pub load_n: f64,
    /// Size of the jump, N.
    pub jump_n: f64,
    /// Change explained by the contact stiffness, N: stiffness times slope of the surfaces times a shift of 30 um.
    pub allowed_n: f64,
}

impl Jump {
    /// Jump beyond the change explained by the stiffness, as a fraction of the load; negative if the stiffness explains
    /// it.
    pub fn excess(&self) -> f64 {
        (self.jump_n - self.allowed_n) / self.load_n
    }

    /// Returns the largest jump of the force of a turned wheel between neighbouring `nodes`: shifts in increasing
    /// order, each with its patches. `None` if the stiffness explains every change.
    pub(super) fn largest(
        geometry: &ContactGeometry,
        wheel: &TurnedWheel<'_>,
        yaw_rad: f64,
        nodes: &[(f64, [TabulatedPatch; ZONES])],
        scratch: &mut Vec<SilhouettePoint>,
    ) -> Option<Self> {
        let mut largest: Option<Self> = None;
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
                    largest = Some(largest.map_or(found, |largest| largest.larger(found)));
                }
                before = after;
            }
        }
        largest
    }

    /// The jump with the larger excess; `self` if both are equal.
    pub(super) fn larger(self, other: Self) -> Self {
        if other.excess() > self.excess() {
            other
        } else {
            self
        }
    }
}

/// Repeatedly halves the interval between two poses, keeping the half with the larger change. Returns the shift and the
/// remaining change.
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

/// A wheel at a lateral shift, and the height at which it carries a given load.
#[derive(Clone)]
struct Loaded {
    lateral_m: f64,
    patches: [TabulatedPatch; ZONES],
    /// Depth of the tread datum below the rail's top, m; `None` if the rail cannot carry the load.
    depth_m: Option<f64>,
}

/// Change of the vertical force between two poses.
#[derive(Clone, Copy, Default)]
struct Change {
    /// Magnitude, N.
    force_n: f64,
    /// Stiffness times slope: the change of the force per shift that the stiffness explains, N/m.
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
            // 32 halvings resolve a picometre.
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

    /// The larger of the changes of the force at the two heights; zero if one of the poses cannot carry the load.
    fn change_to(&self, other: &Self) -> Change {
        let (Some(here), Some(there)) = (self.depth_m, other.depth_m) else {
            return Change::default();
        };
        let [own, moved] = [self, other].map(|pose| Vertical::new(&pose.patches, here));
        let [back, others] = [self, other].map(|pose| Vertical::new(&pose.patches, there));
        let all = [&own, &moved, &back, &others];
        let max = |field: fn(&Vertical) -> f64| {
            let values = all.iter().map(|vertical| field(vertical));
            values.fold(0.0, f64::max)
        };
        Change {
            force_n: (moved.force_n - own.force_n)
                .abs()
                .max((others.force_n - back.force_n).abs()),
            allowed_n_per_m: max(|vertical| vertical.stiffness_n_per_m)
                * max(|vertical| vertical.slope),
        }
    }
}

/// Vertical force of all patches at a depth.
#[derive(Default)]
struct Vertical {
    force_n: f64,
    stiffness_n_per_m: f64,
    /// Maximum slope of the loaded patches: the change of penetration per shift.
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
