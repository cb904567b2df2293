//! The method of the step: generalised alpha.

/// Spectral radius at infinite frequency: what a step leaves of the fastest motion. From 1/2 to 9/10 the errors of the locomotive on
/// straight and curved track differ little.
const SPECTRAL_RADIUS: f64 = 0.8;

/// Part of the last change of the acceleration by which the next one is predicted. The one correction of a step has the damping of creep
/// too high where it slides, which leaves the acceleration nearer to the predicted one; halfway between none and the whole change this error
/// is least.
const CARRIED_ON: f64 = 0.5;

/// Longest step inside a tick, s: impacts of the flange take some milliseconds.
const LONGEST_STEP_S: f64 = 0.25e-3;

/// Constants of the generalised alpha method (Chung and Hulbert, Journal of Applied Mechanics 60, 1993, 371-375) for one step:
/// `M ((1 - am) a1 + am a0) = (1 - af) f1 + af f0`, with Newmark's `beta` and `gamma`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Method {
    /// Steps in a tick.
    pub substeps: usize,
    pub step_s: f64,
    /// `(1 - af)/(1 - am)`, `af/(1 - am)`, `am/(1 - am)`.
    pub new_force: f64,
    pub old_force: f64,
    pub old_inertia: f64,
    /// Of a change of the acceleration in velocity and displacement: `gamma h`, `beta h^2`.
    pub to_velocity: f64,
    pub to_displacement: f64,
}

impl Method {
    /// For ticks of `tick_s`.
    pub fn new(tick_s: f64) -> Self {
        let substeps = (tick_s / LONGEST_STEP_S - 1e-9).ceil().max(1.0);
        let step_s = tick_s / substeps;
        let rho = SPECTRAL_RADIUS;
        let (am, af) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let beta = 0.25 * (1.0 - am + af) * (1.0 - am + af);
        let gamma = 0.5 - am + af;
        Self {
            substeps: substeps as usize,
            step_s,
            new_force: (1.0 - af) / (1.0 - am),
            old_force: af / (1.0 - am),
            old_inertia: am / (1.0 - am),
            to_velocity: gamma * step_s,
            to_displacement: beta * step_s * step_s,
        }
    }

    /// Weight of damping beside the inertia in the equations of a step.
    pub fn damping_weight(&self) -> f64 {
        self.new_force * self.to_velocity
    }

    /// Weight of stiffness.
    pub fn stiffness_weight(&self) -> f64 {
        self.new_force * self.to_displacement
    }

    /// The acceleration at the end of a step as the last two have it.
    #[inline(always)]
    pub fn predicted(&self, now: f64, before: f64) -> f64 {
        now + CARRIED_ON * (now - before)
    }
}
