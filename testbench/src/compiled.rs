//! The step as compiled in this crate, for which every build profile has full optimisation.
//!
//! Rust compiles a generic function in the crate that calls it. The command is compiled without optimisation, and a
//! step compiled there would take twenty times as long, so it calls these functions.

use dashpot_core::{BuildError, CheckedParameters, Damper, DamperState, Real};

/// Scalar types whose step is compiled in this crate.
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
    /// Same as [`Damper::step`], with the same bits: takes the displacement (m), positive in extension, and returns the
    /// force (N).
    fn compiled_step(
        damper: &Damper<Self>,
        state: &mut DamperState<Self>,
        displacement: Self,
    ) -> Self;

    /// Same as [`CheckedParameters::build`]: builds the damper for a step of `step_s` (s).
    ///
    /// # Errors
    /// Same errors as [`CheckedParameters::build`].
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
