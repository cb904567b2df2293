"""Frequency response of a damper."""

from dataclasses import dataclass

from ._notebook import axes_for


@dataclass(frozen=True, eq=False, repr=False)
class ResponseCurves:
    """Curves of a `dashpot.Response`: arrays with one row per amplitude and one column per frequency.

    For x = A sin wt, the first harmonic of the force is A (K' sin wt + K" cos wt): `storage_n_per_m` is K' (N/m),
    `loss_n_per_m` is K", `dynamic_stiffness_n_per_m` the magnitude of both, `loss_angle_deg` the phase by which the
    force leads the displacement (degrees; NaN without a force), and `damping_n_s_per_m` is K"/w (N s/m).

    >>> import dashpot, numpy
    >>> damper = dashpot.Damper("reduced-vertical")
    >>> curves = dashpot.response(damper, [1e-3, 2e-3], frequency_hz=numpy.array([1.0, 2.0, 4.0])).harmonic
    >>> curves.loss_angle_deg.shape
    (2, 3)
    """

    dynamic_stiffness_n_per_m: object
    loss_angle_deg: object
    storage_n_per_m: object
    loss_n_per_m: object
    damping_n_s_per_m: object

    def __repr__(self):
        return "<ResponseCurves of {} amplitudes and {} frequencies>".format(*self.storage_n_per_m.shape)


@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """Frequency response of a damper at `frequency_hz` and `amplitude_m`. `dashpot.response` returns it.

    `harmonic` has the curves of the periodic force, `linearised` those for a peak velocity of 0.1 mm/s with the
    clearance taken up (a single row), and `swept` those of one motion through all frequencies, or `None`. `difference`
    has the relative differences of the swept from the harmonic complex stiffness, or is `None`.

    >>> import dashpot, numpy
    >>> damper = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0.0})
    >>> found = dashpot.response(damper, 1e-3, frequency_hz=numpy.array([0.5]), swept=False)
    >>> round(float(found.linearised.loss_angle_deg[0, 0]), 1)  # atan(K/(C w)) with 8 MN/m and 120 kN s/m
    87.3
    """

    frequency_hz: object
    amplitude_m: object
    harmonic: ResponseCurves
    linearised: ResponseCurves
    swept: ResponseCurves | None
    difference: object

    def __repr__(self):
        amplitudes, hz = ", ".join(f"{amplitude:g}" for amplitude in self.amplitude_m), self.frequency_hz
        return f"<Response at {amplitudes} m, {len(hz)} frequencies from {hz[0]:g} to {hz[-1]:g} Hz>"

    def plot(self, quantity="dynamic_stiffness_n_per_m", axes=None):
        """Plots a quantity of the curves over frequency with matplotlib, one line per amplitude and a dashed one for
        the linearised damper, and returns the axes, new ones by default. An unknown name raises `AttributeError`.
        """
        rows, linear = getattr(self.harmonic, quantity), getattr(self.linearised, quantity)
        axes = axes_for(axes)
        for amplitude_m, row in zip(self.amplitude_m, rows):
            axes.semilogx(self.frequency_hz, row, label=f"{1e3 * amplitude_m:g} mm")
        axes.semilogx(self.frequency_hz, linear[0], "--", label="linearised")
        axes.set_xlabel("frequency, Hz")
        axes.set_ylabel(quantity)
        axes.legend()
        return axes
