"""Dashpot: a real-time model of a rail vehicle's hydraulic damper, on numpy arrays.

Quantities are in SI units, and names contain their unit.

>>> import dashpot, numpy
>>> damper = dashpot.Damper("in-service", {"mount.clearance_m": 1e-3})
>>> built = damper.build(step_s=1e-3, dtype=numpy.float32)
>>> x = (5e-3 * numpy.sin(2 * numpy.pi * numpy.arange(2000) * 1e-3)).astype(numpy.float32)
>>> force_n = built.replay(x)
>>> force_n.dtype, force_n.shape
(dtype('float32'), (2000,))
"""

from ._dashpot import VERSION as __version__
from ._dashpot import (
    Bank,
    BuiltDamper,
    Calibrated,
    Contact,
    Cycle,
    Damper,
    MotionFilter,
    State,
    Study,
    TransferSystem,
    Vehicle,
    VehicleRun,
    calibrate,
    contact,
    creep_forces,
    export,
    export_fmu,
    export_health,
    fleet,
    health,
    modes,
    read,
    response,
    sheet,
    shims,
    vehicle,
    verify,
)
from ._errors import DashpotError, DashpotFileError, DashpotKeyError
from ._fleet import Fleet
from ._health import Estimate, Health, HealthAlarm, HealthCause, HealthStatus
from ._hybrid import Command, EnergyReading, HybridStatus, Measured, Motion, TrackingReading
from ._modes import Modes
from ._notebook import attach as _attach
from ._response import Response, ResponseCurves
from ._sheet import Sheet, SheetTest
from ._shims import Shims
from ._status import Status
from ._verify import RecordedError, StepError

_attach(Damper, Cycle, Calibrated, VehicleRun)

__all__ = [
    "Bank",
    "BuiltDamper",
    "Calibrated",
    "Command",
    "Contact",
    "Cycle",
    "Damper",
    "DashpotError",
    "DashpotFileError",
    "DashpotKeyError",
    "EnergyReading",
    "Estimate",
    "Fleet",
    "Health",
    "HealthAlarm",
    "HealthCause",
    "HealthStatus",
    "HybridStatus",
    "Measured",
    "Modes",
    "Motion",
    "MotionFilter",
    "RecordedError",
    "Response",
    "ResponseCurves",
    "Sheet",
    "SheetTest",
    "Shims",
    "State",
    "Status",
    "StepError",
    "Study",
    "TrackingReading",
    "TransferSystem",
    "Vehicle",
    "VehicleRun",
    "calibrate",
    "contact",
    "creep_forces",
    "export",
    "export_fmu",
    "export_health",
    "fleet",
    "health",
    "modes",
    "read",
    "response",
    "sheet",
    "shims",
    "vehicle",
    "verify",
]
