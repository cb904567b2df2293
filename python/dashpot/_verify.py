"""Errors of the fixed step against the reference solver."""

from dataclasses import dataclass


@dataclass(frozen=True)
class StepError:
    """Largest errors of a damper's step in one precision over a fixed set of motions. `dashpot.verify` returns them.

    `nrmse` is the root mean square error of the worst motion over its root mean square force, `largest_error_n` the
    largest error at a tick, and `largest_wrong_sign_n` the largest force where that of the reference has the opposite
    sign or is zero. The motions are pairs of kind and speed (m/s). `promised_nrmse` and `promised_error_n` are
    guaranteed for every motion of the class in docs/numerics.md.

    >>> import dashpot
    >>> rows = dashpot.verify(dashpot.Damper("reduced-vertical"), step_s=5e-3)
    >>> [row.scalar for row in rows], rows[0].promised_nrmse >= rows[0].nrmse
    (['f64', 'f32'], True)
    """

    scalar: str
    step_s: float
    nrmse: float
    nrmse_motion: tuple
    largest_error_n: float
    largest_error_over_limit: float
    largest_error_motion: tuple
    largest_wrong_sign_n: float
    promised_nrmse: float
    promised_error_n: float


@dataclass(frozen=True)
class RecordedError:
    """Errors of a damper's step in one precision on a recorded motion. `dashpot.verify` returns them.

    `nrmse` is the error of the step alone, with the reference on the displacements at the ticks;
    `nrmse_on_recording` includes the resampling, with the reference on the samples of the recording. `rejected_inputs`
    is the number of ticks whose displacement was held or limited.

    >>> import dashpot, numpy
    >>> time_s = numpy.arange(300) * 1e-3
    >>> rows = dashpot.verify(dashpot.Damper("paper"), (time_s, 5e-3 * numpy.sin(20 * time_s)), step_s=1e-3)
    >>> rows[0].nrmse < 0.01, rows[0].rejected_inputs
    (True, 0)
    """

    scalar: str
    step_s: float
    nrmse: float
    largest_error_over_peak: float
    largest_error_n: float
    reference_rms_n: float
    reference_peak_n: float
    nrmse_on_recording: float
    rejected_inputs: int
