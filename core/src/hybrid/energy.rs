//! Energy that the actuator adds to the vehicle.

use super::limits::{self, clamped, credible};
use super::motion::Chain;
use crate::BuildError;

/// Settings of [`AddedEnergy`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergySettings {
    /// Time after which past energy counts 1/e (s), 0.05 to 1000.
    pub window_s: f32,
    /// Energy added in this time that is an alarm, as a share of the energy that the damper exchanges; 0.01 to 100.
    pub largest_share: f32,
    /// Mean exchanged power below which there is no alarm (W), 0 to 1e6.
    pub least_power_w: f32,
    /// Pole of the low-pass filters of displacement and force (Hz), 1 to 1000 and to a tenth of the rate of the ticks.
    pub pole_hz: f32,
}

impl Default for EnergySettings {
    /// An alarm when a tenth of the exchanged energy is added during a second, at 1 W or more.
    fn default() -> Self {
        Self {
            window_s: 1.0,
            largest_share: 0.1,
            least_power_w: 1.0,
            pole_hz: 50.0,
        }
    }
}

/// The energy `integral of f (x_measured' - x_desired') dt` that the actuator adds, and its share of the energy
/// `integral of |f x_desired'| dt` that the damper exchanges with the vehicle.
///
/// A delay makes the actuator add energy in every cycle, long before the motion grows; an actuator that leads takes
/// energy away. (Mosqueda, Stojadinovic and Mahin 2007, hybrid simulation error monitors.) Displacements and force pass
/// the same low-pass filters, so their delay does not matter. There is no alarm in the first `window_s`, in which the
/// means still depend on single ticks.
///
/// ```
/// use dashpot_core::hybrid::{AddedEnergy, EnergySettings};
///
/// // A spring of 1 MN/m, 10 ms late: a sine of 5 mm at 20 rad/s adds k tau v^2/2 = 50 W.
/// let mut energy = AddedEnergy::new(&EnergySettings::default(), 1e-3)?;
/// let mut at_2_s = 0.0;
/// for tick in 0..12_001 {
///     let t = 1e-3 * tick as f32;
///     let (desired, measured) = (0.005 * (20.0 * t).sin(), 0.005 * (20.0 * (t - 0.01)).sin());
///     energy.observe(desired, measured, 1e6 * measured);
///     if tick == 2000 {
///         at_2_s = energy.added_j();
///     }
/// }
/// assert!((energy.added_j() - at_2_s - 497.0).abs() < 10.0); // 10 s of k v^2 sin(omega tau)/(2 omega)
/// assert!(energy.is_alarm());
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AddedEnergy {
    step_s: f32,
    pole_per_s: f32,
    fading: f32,
    largest_share: f32,
    least_power_w: f32,
    desired: Chain<1>,
    errors: Chain<1>,
    forces: Chain<1>,
    added_j: f32,
    /// Mean powers over the fading past (W).
    added_w: f32,
    exchanged_w: f32,
    /// Mean power that the vehicle gives (W): positive for a damper.
    given_w: f32,
    /// Ticks of the window, and those that are left before the first alarm.
    window_ticks: u32,
    ticks_left: u32,
}

impl AddedEnergy {
    /// No energy yet, at rest at 0.
    ///
    /// # Errors
    /// A setting is outside its range.
    pub fn new(settings: &EnergySettings, step_s: f32) -> Result<Self, BuildError> {
        const SECTION: &str = "energy";
        let check =
            |field, value, range, allowed| limits::within((SECTION, field), value, range, allowed);
        limits::step(SECTION, step_s)?;
        check(
            "window_s",
            settings.window_s,
            (0.05, 1000.0),
            "0.05 to 1000",
        )?;
        check(
            "largest_share",
            settings.largest_share,
            (0.01, 100.0),
            "0.01 to 100",
        )?;
        check(
            "least_power_w",
            settings.least_power_w,
            (0.0, 1e6),
            "0 to 1e6",
        )?;
        let tenth = "1 to 1000 and to a tenth of the rate of the ticks";
        check(
            "pole_hz",
            settings.pole_hz,
            (1.0, 1000_f32.min(0.1 / step_s)),
            tenth,
        )?;
        let pole_per_s = core::f32::consts::TAU * settings.pole_hz;
        let chain = Chain::new(pole_per_s, step_s);
        Ok(Self {
            step_s,
            pole_per_s,
            fading: limits::fading(step_s, settings.window_s),
            largest_share: settings.largest_share,
            least_power_w: settings.least_power_w,
            desired: chain,
            errors: chain,
            forces: chain,
            added_j: 0.0,
            added_w: 0.0,
            exchanged_w: 0.0,
            given_w: 0.0,
            window_ticks: (settings.window_s / step_s) as u32,
            ticks_left: (settings.window_s / step_s) as u32,
        })
    }

    /// Starts over at rest at a displacement (m), with a force (N).
    pub fn rest_at(&mut self, displacement_m: f32, force_n: f32) {
        self.desired.rest_at(credible(displacement_m, 1.0));
        self.errors.rest_at(0.0);
        self.forces.rest_at(credible(force_n, 1e7));
        (self.added_j, self.added_w) = (0.0, 0.0);
        (self.exchanged_w, self.given_w) = (0.0, 0.0);
        self.ticks_left = self.window_ticks;
    }

    /// Takes desired and measured displacement (m) and the measured force (N) of a tick.
    #[inline]
    pub fn observe(&mut self, desired_m: f32, measured_m: f32, force_n: f32) {
        let desired_m = credible(desired_m, 1.0);
        let [_, desired] = self.desired.push(desired_m);
        let [_, error] = self.errors.push(credible(measured_m, 1.0) - desired_m);
        let [force, _] = self.forces.push(credible(force_n, 1e7));
        let added_w = force * error * self.pole_per_s;
        let given_w = force * desired * self.pole_per_s;
        self.added_j = clamped(self.added_j + added_w * self.step_s, 1e12);
        self.added_w += self.fading * (added_w - self.added_w);
        self.exchanged_w += self.fading * (given_w.abs() - self.exchanged_w);
        self.given_w += self.fading * (given_w - self.given_w);
        self.ticks_left = self.ticks_left.saturating_sub(1);
    }

    /// Energy added since the start (J); negative if the actuator took energy away.
    pub fn added_j(&self) -> f32 {
        self.added_j
    }

    /// Share of the exchanged energy that the actuator added over the fading past (1); 0 below a mean power of 1 nW.
    pub fn added_share(&self) -> f32 {
        match self.exchanged_w > 1e-9 {
            true => self.added_w / self.exchanged_w,
            false => 0.0,
        }
    }

    /// True while the force pushes in the direction of the desired or of the measured motion: vehicle or actuator gets
    /// more than half of the exchanged energy back, which no damper can give. A sensor with the wrong sign looks like
    /// this.
    #[inline]
    pub fn is_reversed(&self) -> bool {
        // The energy along the measured motion is what the vehicle gives plus what the actuator adds.
        let least_w = self.given_w + self.added_w.min(0.0);
        self.is_known() && least_w < -0.5 * self.exchanged_w
    }

    /// True while the added share is above its limit.
    #[inline]
    pub fn is_alarm(&self) -> bool {
        self.is_known() && self.added_w > self.largest_share * self.exchanged_w
    }

    /// True if enough energy has been exchanged for an alarm.
    #[inline]
    fn is_known(&self) -> bool {
        self.ticks_left == 0 && self.exchanged_w >= self.least_power_w
    }
}
