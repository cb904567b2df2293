//! Which delay a damper position bears: planning of a hybrid test.
//!
//! One damper of a simulated vehicle is a real one on a rig. The vehicle without it is linear, `x' = A x - b f`, with
//! the extension `e = c x` (m) of the damper and its force `f` (N), positive if it resists extension. The damper is a
//! dashpot `c_d` in series with the stiffness `k` of its mounts, `f = D(s) e` with `D(s) = k c_d s/(k + c_d s)`. The
//! actuator, what compensates it and the exchange of signals multiply the loop by `F(s)`, so the motion is that of
//!
//! ```text
//! 1 + L(s) F(s) = 0    with    L(s) = c (s 1 - A)^-1 b D(s),
//! ```
//!
//! where `F = exp(-s tau)` is a pure delay. Nothing is approximated by a rational function.
//!
//! Both answers come from one sweep of the imaginary axis. [`critical_delay`] is the direct method of K. Walton and
//! J. E. Marshall, "Direct method for TDS stability analysis", IEE Proceedings D 134 (1987) 101-107: a root can cross
//! the axis at `j omega` only if `|L(j omega)| = 1`, and then the shortest delay at which it is there is
//! `arg(-L(j omega))/omega`, with the argument from 0 to `2 pi`. [`stability`] counts the unstable roots by the
//! argument principle (Nyquist).
//!
//! Instead of `L`, which can have poles on the axis, the sweep follows `T = L/(1 + L)`: its poles are the eigenvalues
//! of the vehicle with the damper and without delay. `1 + L F = (1 + L) (1 - T + T F)`, and `|L F| = 1` where
//! `|T F| = |1 - T|`.
//!
//! ```
//! use dashpot_hybrid::plan::{PlantWithoutDamper, critical_delay};
//! use nalgebra::{DMatrix, DVector};
//!
//! // 1 kg on a spring of 100 N/m, with a dashpot of 3 N s/m whose mounts are very stiff.
//! let a = DMatrix::from_row_slice(2, 2, &[0.0, -100.0, 1.0, 0.0]);
//! let [b, c] = [[1.0, 0.0], [0.0, 1.0]].map(|row| DVector::from_row_slice(&row));
//! let plant = PlantWithoutDamper::new(a, b, c, 3.0, 1e9)?;
//! let critical = critical_delay(&plant)?.unwrap();
//! // A quarter of the period of the frequency at which 3 omega = omega^2 - 100.
//! let omega = 1.5 + (1.5_f64.powi(2) + 100.0).sqrt();
//! assert!((critical.frequency_hz - omega / std::f64::consts::TAU).abs() < 1e-6);
//! assert!((critical.delay_s - 0.25 / critical.frequency_hz).abs() < 1e-6);
//! # Ok::<(), dashpot_hybrid::plan::PlanError>(())
//! ```

mod crossing;
mod error;
mod frequency_response;
mod piece;
mod plant;
mod stability;
mod sweep;

pub use error::PlanError;
pub use nalgebra::Complex;
pub use plant::PlantWithoutDamper;
pub use stability::{CriticalDelay, LoopStability, critical_delay, stability};
