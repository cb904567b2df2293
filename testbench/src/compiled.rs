//! The step as compiled in this crate, which every profile optimises in full.
//!
//! Rust compiles a generic function in the crate that calls it. The command is compiled without optimisation, where a
//! step would take twenty times as long, so it calls these functions.

use dashpot_core::{BuildError, CheckedParameters, Damper, DamperState, Real};

/// Scalars whose step is compiled in this crate.
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::compiled::Compiled;
/// let damper = f32::compiled_build(&damper::load("paper", &[])?, 1e-3)?;
/// let (mut state, mut other) = (damper.at_rest(0.0), damper.at_rest(0.0));
/// assert_eq!(f32::compiled_step(&damper, &mut state, 1e-4), damper.step(&mut other, 1e-4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Compiled: Real {
    /// Steps as [`Damper::step`]: displacement (m), positive in extension; returns the force (N), the same bits.
    fn compiled_step(
        damper: &Damper<Self>,
        state: &mut DamperState<Self>,
        displacement: Self,
    ) -> Self;

    /// Builds as [`CheckedParameters::build`], for a step of `step_s` (s).
    ///
    /// # Errors
    /// See [`CheckedParameters::build`].
    fn compiled_build(
        parameters: &CheckedParameters,
        step_s: f64,
    ) -> Result<Damper<Self>, BuildError>;
}

macro_rules! compiled {
    ($($scalar:ty),*) => {$(
        impl Compiled for $scalar {
            #[inline(never)]
            fn compiled_step(
                damper: &Damper<Self>,
                state: &mut DamperState<Self>,
                displacement: Self,
            ) -> Self {
                damper.step(state, displacement)
            }

            #[inline(never)]
            fn compiled_build(
                parameters: &CheckedParameters,
                step_s: f64,
            ) -> Result<Damper<Self>, BuildError> {
                parameters.build(step_s)
            }
        }
    )*};
}

compiled!(f32, f64);
