import enum
import pathlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any, Literal, NamedTuple, TypeAlias, TypeVar, final, overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

_Path: TypeAlias = str | bytes | PathLike[str] | PathLike[bytes]
_Overrides: TypeAlias = Mapping[str, float | str | bool]
_Dampers: TypeAlias = Mapping[str, _Path | Damper]
# None in cases that the caller knows of, such as a vehicle that derailed: checkers accept an index without a test.
_MaybeNone: TypeAlias = Any
_Floats: TypeAlias = NDArray[np.float32] | NDArray[np.float64]
# A list of texts, of numbers and None, or of whole numbers for some columns.
_Column: TypeAlias = NDArray[np.float64] | NDArray[np.int64] | Any
_Measured: TypeAlias = NDArray[np.floating[Any]]
_Recording: TypeAlias = Mapping[str, _Measured] | Sequence[_Measured]
_T = TypeVar("_T")
_A = TypeVar("_A", NDArray[np.float32], NDArray[np.float64])

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

__version__: str

class DashpotError(ValueError):
    """An invalid damper, case, study, array or number: the message states what is wrong, where, and what is allowed."""
class DashpotKeyError(DashpotError, KeyError):
    """An unknown key of a damper."""
class DashpotFileError(DashpotError, OSError):
    """A file that cannot be read or written: `filename` is the file, and `errno` is the system's error number, if any.
    """
    def __init__(self, words: str, errno: int | None = None, filename: str | None = None) -> None: ...

class Status(enum.IntFlag):
    """Bits latched since the last `State.clear_status`."""
    INPUT_HELD = 1
    INPUT_LIMITED = 2
    SATURATED = 4
    DAMPER_SWAPPED = 8
    CORRUPTED = 16
    RESTARTED = 32

@final
class Damper:
    """A damper: a preset or the TOML file at a path, with other values for the keys of `overrides`.

    It is a mapping from keys `table.key` to values in SI units.
    """
    def __new__(cls, name: _Path, overrides: _Overrides | None = None) -> Damper: ...
    @staticmethod
    def from_toml(text: str, overrides: _Overrides | None = None, name: str = "damper") -> Damper:
        """Reads the damper from `text`, the contents of a damper file; errors call the damper `name`."""
    def to_toml(self) -> str:
        """Returns the text of a damper file; `from_toml` reads the same damper from it."""
    def replace(self, overrides: _Overrides) -> Damper:
        """Returns the damper with other values for these keys."""
    @property
    def name(self) -> str:
        """Name of the damper in errors."""
    def keys(self) -> list[str]:
        """All keys, in order."""
    def values(self) -> list[float]:
        """All values, in the order of the keys."""
    def items(self) -> list[tuple[str, float]]:
        """Pairs of keys and values, in order."""
    @overload
    def get(self, key: object, default: None = None, /) -> float | None:
        """Returns the value of a key, or `default` if this damper lacks the key."""
    @overload
    def get(self, key: object, default: _T, /) -> float | _T:
        """Returns the value of a key, or `default` if this damper lacks the key."""
    def __getitem__(self, key: str, /) -> float: ...
    def __contains__(self, key: object, /) -> bool: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def build(self, step_s: float = 0.001, dtype: DTypeLike | None = None) -> BuiltDamper:
        """Builds the damper for a fixed step (s), in the precision of `dtype`: float32 by default, as on the target."""
    def rig(self, amplitude_m: float, frequency_hz: float, step_s: float = 0.0001) -> Cycle:
        """Runs the bench test in double precision, with steps of at most `step_s` (s): the seats move harmonically
        until the force repeats.
        """
    def indices(self, amplitude_m: float, frequency_hz: float, step_s: float = 0.0001) -> dict[str, float | None]:
        """Returns the indices of the bench test by name; an index that is undefined without force is `None`."""
    def characteristic(self, velocity_m_per_s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Returns the force (N) at each constant velocity (m/s), after the springs have settled and the clearance is
        taken up; both are positive in extension.
        """
    def reference(self, x: NDArray[np.float64], step_s: float) -> NDArray[np.float64]:
        """Returns the force (N) of the reference solution at displacements (m) of the seats. They are `step_s` (s)
        apart and linear in between. The reference is an adaptive solver, written independently of the step, and about a
        thousand times slower.
        """
    def _repr_html_(self) -> str: ...

@final
class BuiltDamper:
    """A damper built for a fixed step. It never changes, and any number of states and threads can share it.
    `Damper.build` creates one.
    """
    @property
    def step_s(self) -> float:
        """Step size (s)."""
    @property
    def dtype(self) -> np.dtype[Any]:
        """The precision of the step: float32 or float64."""
    @property
    def revision(self) -> int:
        """Number that identifies the built damper, never 0."""
    @property
    def clearance_m(self) -> float:
        """Clearance 2a, the total play (m)."""
    @property
    def force_limit_n(self) -> float:
        """Force at which the element yields (N); no step returns a larger force."""
    def with_clearance_m(self, clearance_m: float) -> BuiltDamper:
        """Returns the same damper with another clearance 2a (m), changed as in firmware at run time: the table is not
        rebuilt, and a state may continue with the returned damper at the next tick.
        """
    def at_rest(self, displacement_m: float = 0.0) -> State:
        """Returns a state at rest at a displacement (m), centred in the clearance, without force. A displacement that
        is not finite counts as 0.
        """
    def step(self, state: State, displacement_m: float) -> float:
        """Steps one tick and returns the force (N) at a displacement (m) of the seats, positive in extension. It
        accepts every displacement: one that is not finite is held, one that moves too fast is limited, and both are
        latched in the status of the state.
        """
    def replay(
        self, x: _A, *, state: State | None = None, out: _A | None = None
    ) -> _A:
        """Returns the force (N) at each displacement (m) of `x`, one step per sample, with the bits of the command
        `dashpot replay`. It starts at rest at the first sample, or continues from `state`, which it advances. `x` and
        `out` are arrays of this damper's precision and are not copied. The GIL is released during the replay, so do not
        modify them from another thread.
        """
    def state_from_bytes(self, saved: bytes) -> State:
        """Restores a state saved by `State.to_bytes`, here or in a C or Rust program. Bytes of another damper and
        damaged bytes are refused.
        """

@final
class State:
    """State of one damper. `BuiltDamper.at_rest` creates one; `copy.copy` saves it, and `pickle` stores it with its
    damper.
    """
    @property
    def displacement_m(self) -> float:
        """Displacement at the last tick (m), positive in extension."""
    @property
    def piston_displacement_m(self) -> float:
        """Piston displacement in the cylinder (m)."""
    @property
    def force_n(self) -> float:
        """Force at the last tick (N), positive when it resists extension."""
    @property
    def revision(self) -> int:
        """Revision of the damper that last stepped the state."""
    @property
    def rejected_inputs(self) -> int:
        """Number of ticks whose displacement was held or limited; it stops at 65535."""
    @property
    def status(self) -> Status:
        """Status bits latched since they were last cleared, as a `dashpot.Status`."""
    def clear_status(self) -> None:
        """Clears the status bits and the counter."""
    def to_bytes(self) -> bytes:
        """The state as self-contained bytes, the same in C and in Rust; `BuiltDamper.state_from_bytes` restores it."""
    def __copy__(self) -> State: ...
    def __deepcopy__(self, _memo: Any) -> State: ...
    def __eq__(self, other: object, /) -> bool: ...

@final
class Bank:
    """Built dampers with the same step and precision, stepped together; the same damper may occur several times."""
    def __new__(cls, dampers: Sequence[BuiltDamper]) -> Bank: ...
    def at_rest(self, displacements_m: _Floats | None = None) -> list[State]:
        """Returns a state at rest for each damper. `displacements_m` gives the displacement (m) of each, as an array of
        this bank's precision; default: 0.
        """
    def replay(
        self, x: _A, *, states: Sequence[State] | None = None, out: _A | None = None
    ) -> _A:
        """Returns the forces (N) at the displacements (m) of `x`, with one row per tick and one column per damper. Each
        column works like `BuiltDamper.replay`.
        """
    @property
    def step_s(self) -> float:
        """Step size (s)."""
    @property
    def dtype(self) -> np.dtype[Any]:
        """The precision of the step: float32 or float64."""
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[BuiltDamper]: ...

@final
class Cycle:
    """One settled cycle of a bench test. `Damper.rig` returns it."""
    @property
    def displacement_m(self) -> NDArray[np.float64]:
        """Displacement (m) of the seats at each step, starting one step after zero."""
    @property
    def velocity_m_per_s(self) -> NDArray[np.float64]:
        """Velocity (m/s) at each step."""
    @property
    def force_n(self) -> NDArray[np.float64]:
        """Force (N) at each step."""
    @property
    def step_s(self) -> float:
        """The step size used (s): the requested one, shortened so that a cycle is a whole number of steps."""
    @property
    def cycles(self) -> int:
        """Number of cycles until the force repeated."""
    @property
    def indices(self) -> dict[str, float | None]:
        """The indices by name; an index that is undefined without force is `None`."""
    def plot(self, axes: Any = None) -> Any:
        """Plots the loop of force over displacement with matplotlib, and returns the axes, new ones by default."""
    def _repr_html_(self) -> str: ...

@final
class VehicleRun:
    """A run of a vehicle. `dashpot.vehicle` returns it."""
    @property
    def case(self) -> str:
        """Name of the case."""
    @property
    def step_s(self) -> float:
        """Step (s)."""
    @property
    def ending(self) -> str:
        """How the run ended, in words: `completed`, or when and where the vehicle derailed, overturned, diverged, left
        the contact tables or went beyond the model (a wheel load over 50 times the static load).
        """
    @property
    def is_completed(self) -> bool:
        """True if the run completed."""
    @property
    def warnings(self) -> list[str]:
        """Results outside the model's validity, one sentence each with time and position: wheel loads over 10 times the
        static load, and wheels without load for more than 50 ms. Empty if there is nothing to warn about.
        """
    @property
    def history(self) -> dict[str, NDArray[np.float64]]:
        """Arrays of the signals by name, one value per tick, as `pandas.DataFrame` accepts them. The command writes the
        same values to history.csv.
        """
    @property
    def indices(self) -> dict[str, Any] | _MaybeNone:
        """The indices, as in the command's indices.json; `None` for a run that derailed, overturned, diverged, left the
        contact tables or went beyond the model.
        """
    def plot(self, *signals: str, axes: Any = None) -> Any:
        """Plots columns of the history over time with matplotlib, and returns the axes, new ones by default.

        Without names it plots all columns of `signals`. An unknown name raises `KeyError`.
        """
    def _repr_html_(self) -> str: ...

def vehicle(
    case: _Path | None = None,
    *,
    vehicle: _Path | None = None,
    track: _Path | None = None,
    speed_km_h: float | None = None,
    duration_s: float | None = None,
    start_m: float | None = None,
    friction: float | None = None,
    normal_damping_s_per_m: float | None = None,
    step_us: float | None = None,
    push_m: float | None = None,
    contact: dict[str, Any] | None = None,
    dampers: _Dampers | None = None,
    overrides: _Overrides | None = None,
    signals: Sequence[str] | None = None,
) -> VehicleRun:
    """Runs a vehicle along a track. Give a case (a shipped one or a TOML file), whose values the other arguments
    override, or a track and a speed.

    `contact` is a dictionary with keys of the table `[contact]` of a case file: profiles, gauge, inclination and
    friction. File names in it are relative to the working directory.

    `dampers` is a dictionary from dampers, by direction or name, to their replacements: a preset, a file or a `Damper`.
    `overrides` changes values of the vehicle. Both work like the command's `--damper` and `--set`. `signals` selects
    the signals of the history; default: all. Ctrl-C cancels the run.
    """

@final
class Vehicle:
    """A vehicle on a track that a program steps and influences: speed, friction, forces on bodies, dampers, and the
    forces of external dampers. `case` is a shipped case or a file.

    `outside` names dampers whose forces are inputs; `dampers` and `overrides` are those of `dashpot.vehicle`. A value
    that is set acts from the next tick on and stays until another is set, or until an event of the case changes the
    same quantity.
    """
    def __new__(
        cls,
        case: _Path,
        *,
        outside: Sequence[str] = ...,
        dampers: _Dampers | None = None,
        overrides: _Overrides | None = None,
    ) -> Vehicle: ...
    @property
    def inputs(self) -> list[str]:
        """Names of the inputs: forces of external dampers (N), `speed_m_per_s`, `friction_factor`, and for each body
        the lateral and vertical force and the roll, pitch and yaw moment that are applied to its centre.
        """
    @property
    def outputs(self) -> list[str]:
        """Names of the outputs: the signals of `VehicleRun.history`, without the time."""
    @property
    def step_s(self) -> float:
        """Step (s)."""
    @property
    def time_s(self) -> float:
        """Time since the start (s)."""
    @property
    def ending(self) -> str | None:
        """How the run ended, in words; `None` while it goes on."""
    def set(self, name: str, value: float) -> None:
        """Sets an input from the next tick on."""
    def get(self, name: str) -> float:
        """Returns the value of an input or output."""
    def replace_damper(self, name: str, damper: Damper) -> None:
        """Replaces a damper, named with its number as in `front lateral damper 1`; its force stays continuous. `reset`
        and `restore` bring back the dampers of the case.
        """
    def step(self, ticks: int = 1, inputs: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Runs `ticks` ticks and returns an array with a row of all outputs after each; fewer rows if the run ends, and
        none after its end. `ending` then gives the reason.

        `inputs` is one value for each of `Vehicle.inputs`; without it the inputs stay as they are.
        """
    def reset(self) -> None:
        """Returns to the start of the case."""
    def save(self) -> bytes:
        """Saves the state for `restore`, as bytes."""
    def restore(self, state: bytes) -> None:
        """Goes on from a state that a vehicle of the same case saved."""

class HybridStatus(enum.IntFlag):
    """Bits latched since the last `TransferSystem.clear`. Any bit ends the test, except the first two."""
    COMMAND_LIMITED = 1
    MEASUREMENT_MISSED = 2
    STROKE = 4
    VELOCITY = 8
    FORCE = 16
    TRACKING = 32
    AGE = 64
    IMPLAUSIBLE = 128
    SIGN = 256
    ENERGY = 512
    REQUESTED = 1024
    NO_FORCE = 2048

class Motion(NamedTuple):
    """Displacement of the damper's ends at a tick, positive in extension, and its derivatives."""
    displacement_m: float
    velocity_m_per_s: float = 0.0
    acceleration_m_per_s2: float = 0.0
    jerk_m_per_s3: float = 0.0

class Measured(NamedTuple):
    """Measured values of a tick: displacement, positive in extension, and force, positive when it resists extension."""
    displacement_m: float
    force_n: float

class Command(NamedTuple):
    """Result of a tick: command of the actuator, force for the vehicle, and status bits.

    The force is the measured one, or the last valid one; after the end of a test it fades to 0.
    """
    command_m: float
    force_n: float
    status: HybridStatus

class TrackingReading(NamedTuple):
    """How well the measured displacement follows, over the fading past.

    `delay_s` is the time by which it is late, negative if it is early; `amplitude` is relative to the desired one;
    `relative_error` is relative to the root mean square of the desired displacement.
    """
    delay_s: float
    amplitude: float
    relative_error: float
    error_m: float

class EnergyReading(NamedTuple):
    """Energy that the actuator has added to the vehicle since the start, and its share of the exchanged energy.

    Both are negative if the actuator took energy away; the share is over the fading past.
    """
    added_j: float
    added_share: float

@final
class MotionFilter:
    """Estimates velocity, acceleration and jerk of a displacement that is known only at the ticks.

    `pole_hz` is the pole of the filter: 1 Hz to a quarter of the rate of the ticks. The filter starts at rest at 0.
    """
    def __new__(cls, pole_hz: float, step_s: float = 0.001) -> MotionFilter: ...
    def rest_at(self, displacement_m: float) -> None:
        """Puts the filter at rest at a displacement (m): at the start, and after a displacement that was not finite."""
    def push(self, displacement_m: float) -> Motion:
        """Takes the displacement (m) of this tick and returns its `dashpot.Motion`. A displacement that is not finite
        makes this motion and those after it useless, until `rest_at`.
        """
    def __copy__(self) -> MotionFilter: ...
    def __deepcopy__(self, _memo: Any) -> MotionFilter: ...

@final
class TransferSystem:
    """All that stands between a simulated vehicle and an actuator: compensator, tracking, energy and guard, in single
    precision with the bits of the target.

    `stroke_m`, `velocity_m_per_s` and `force_n` are the limits of the test. `compensator` is `"none"`, `"polynomial"`
    (with `delay_s` and `order`, 1 to 3), `"inverse"` (with `delay_s` or `coefficients`, 1 to s^3) or `"adaptive"` (the
    same and `delay_error_s`, the largest error of the delay; also `largest_change`, `noise_m`, `least_motion_m`,
    `pole_hz`, `memory_s` and `change_s`). The settings of the guard and those that start with `energy_` have the names,
    ranges and defaults of `GuardSettings` and `EnergySettings` in Rust. `action` is how a test ends: `"hold"`, or
    `"zero_force"` with `stiffness_n_per_m` of the specimen.
    """
    def __new__(
        cls,
        *,
        stroke_m: float,
        velocity_m_per_s: float,
        force_n: float,
        step_s: float = 0.001,
        compensator: Literal["none", "polynomial", "inverse", "adaptive"] = "none",
        delay_s: float | None = None,
        delay_error_s: float | None = None,
        coefficients: Sequence[float] | None = None,
        order: int | None = None,
        largest_change: Sequence[float] | None = None,
        noise_m: float | None = None,
        least_motion_m: float | None = None,
        pole_hz: float | None = None,
        memory_s: float | None = None,
        change_s: float | None = None,
        limited_s: float | None = None,
        error_m: float | None = None,
        error_s: float | None = None,
        age_s: float | None = None,
        plausible_m_per_s: float | None = None,
        plausible_n_per_s: float | None = None,
        stuck_travel_m: float | None = None,
        least_force_n: float | None = None,
        without_force_m: float | None = None,
        ramp_s: float | None = None,
        approach_m_per_s: float | None = None,
        action: Literal["hold", "zero_force"] = "hold",
        stiffness_n_per_m: float | None = None,
        energy_window_s: float | None = None,
        energy_largest_share: float | None = None,
        energy_least_power_w: float | None = None,
        energy_pole_hz: float | None = None,
        tracking_window_s: float = 1.0,
        tracking_error: float = 0.3,
    ) -> TransferSystem: ...
    def tick(self, desired: Sequence[float], measured: Sequence[float] | None = None) -> Command:
        """Takes the desired motion and the measured values of this tick, or `None` if none came; returns a
        `dashpot.Command`. It never fails because of a value: the status reports what was wrong.

        `desired` is a `dashpot.Motion` or four numbers: displacement (m), velocity (m/s), acceleration (m/s^2) and jerk
        (m/s^3). `measured` is a `dashpot.Measured` or two numbers: displacement (m) and force (N).
        """
    def place(self, displacement_m: float) -> None:
        """Places a system that has not ended a test at the actuator's present displacement (m), from which the command
        approaches the desired one.
        """
    def end(self) -> None:
        """Ends the test: the command comes to rest, and the status has `HybridStatus.REQUESTED`."""
    def clear(self) -> bool:
        """Clears the status. A test that has come to rest starts again: the command approaches the desired
        displacement. While the command is still coming to rest, nothing is cleared and the result is False.
        """
    @property
    def tracking(self) -> TrackingReading:
        """Delay, amplitude and errors over the fading past, as a `dashpot.TrackingReading`."""
    @property
    def energy(self) -> EnergyReading:
        """Energy that the actuator adds to the vehicle, as a `dashpot.EnergyReading`."""
    @property
    def status(self) -> HybridStatus:
        """Status bits since the last `clear`, as a `dashpot.HybridStatus`."""
    @property
    def phase(self) -> Literal["approaching", "running", "ending", "held"]:
        """Phase of the test: `"approaching"`, `"running"`, `"ending"` while the command comes to rest, or `"held"`."""
    @property
    def compensator(self) -> Literal["none", "polynomial", "inverse", "adaptive"]:
        """Kind of the compensator."""
    @property
    def coefficients(self) -> tuple[float, float, float, float] | None:
        """Present coefficients of an inverse or adaptive compensator, 1 to s^3; `None` for the other kinds."""
    @property
    def step_s(self) -> float:
        """Step (s), in single precision."""
    def __copy__(self) -> TransferSystem: ...
    def __deepcopy__(self, _memo: Any) -> TransferSystem: ...

@final
class Study:
    """A shipped study or a TOML file. Cases are numbered from 0. Each row depends only on its case: its bits are the
    same in any order and on any number of threads and machines.

    `seeds` replaces the seeds of every sweep that has seeds by 1 to `seeds`. Pickling transfers a study to another
    process by name; unpickling checks that the files are the same there.
    """
    def __new__(cls, name: _Path, seeds: int | None = None) -> Study: ...
    @staticmethod
    def from_toml(text: str, seeds: int | None = None, name: str = "study") -> Study:
        """Reads the study from `text`, the contents of a study file. Errors call it `name`, and files that it names are
        relative to the working folder.
        """
    @property
    def columns(self) -> list[str]:
        """Names of the columns of a row, as in the command's rows.csv."""
    @property
    def digest(self) -> str:
        """Digest of the cases: rows of studies with the same digest and version belong together."""
    def __len__(self) -> int: ...
    def row(self, number: int) -> dict[str, str | int | float | None]:
        """Runs the case with this number and returns its row by column; missing values are `None`. To share a study
        between machines, map this over `range(len(study))`, as Dask's `client.map` does. Ctrl-C cancels the run.
        """
    def run(self, *, shard: tuple[int, int] | None = None, threads: int | None = None) -> dict[str, _Column]:
        """Runs the cases on `threads` threads, by default one per core, and returns their columns in the order of the
        cases, as `pandas.DataFrame` accepts them. `shard` is a pair of a shard's number, from 0, and the number of
        shards; only that shard is run. Ctrl-C cancels the run.
        """

@final
class Calibrated:
    """Result of a calibration. `dashpot.calibrate` returns it."""
    @property
    def damper(self) -> Damper:
        """The calibrated damper."""
    @property
    def values(self) -> dict[str, float]:
        """The fitted parameters by key. Two belong to the rig rather than to the damper: `sensor_skew_s` is the delay
        (s) of the recorded force relative to the displacement, and `force_offset_n` is the force sensor's reading (N)
        at zero force.
        """
    @property
    def intervals(self) -> dict[str, tuple[float | None, float | None]]:
        """Intervals (95 %) of the fitted parameters, as pairs of minimum and maximum; `None` in a pair means that the
        parameter reached a bound first. The intervals include the noise of the tests and the uncertainty of the oil's
        temperature and density.
        """
    @property
    def validation(self) -> list[dict[str, Any]]:

        """Each held-back test of `validate`, predicted with the calibrated damper: its root mean square error
        `error_n`, the same beyond the noise as a share of the force `error_share`, the greatest `systematic` difference
        over the velocity or `None`, and further keys as in the JSON of `dashpot calibrate --validate`.
        """
    @property
    def plan(self) -> dict[str, dict[str, float]]:

        """The tests of the sheet `plan` by name, each with what would remain of the standard deviation of each
        parameter after that test (1).
        """
    @property
    def standard_deviations(self) -> dict[str, float]:
        """Standard deviations of the fitted parameters from linear theory, in the units of the parameters."""
    @property
    def correlation(self) -> NDArray[np.float64]:
        """Correlation matrix of the parameters, in the order of `values`."""
    @property
    def loops(self) -> list[dict[str, Any]]:
        """Each recorded loop and the model's loop before and after the fit, at the samples that count in the fit:
        arrays `time_s`, `displacement_m`, `force_n`, `before_n` and `after_n` (the model's forces as the sensor would
        show them), the RMS misfits `missed_before_n` and `missed_after_n`, and `displacement_offset_m`, the mean of the
        motion, which does not affect the force.
        """
    @property
    def assumed(self) -> dict[str, dict[str, Any]]:
        """Assumed properties of the oil by key, and their effect on the parameters: `value`, `uncertainty` (half of a
        95 % interval), and `shifts`, pairs with the shift of each parameter at the lower and at the upper end of that
        interval.
        """
    @property
    def warnings(self) -> list[str]:
        """Warnings about the result, one sentence each: a misfit larger than the noise, a parameter at its bound,
        parameters that the tests hardly distinguish, or an assumed temperature that dominates a parameter.
        """
    def _repr_html_(self) -> str: ...

def calibrate(
    damper: Damper,
    tests: Sequence[Sequence[_Measured]] | None = None,
    vary: Sequence[str] | dict[str, tuple[float, float] | None] | None = None,
    *,
    indices: Sequence[dict[str, float | None]] | None = None,
    priors: dict[str, tuple[float, float]] | None = None,
    known_priors: bool = True,
    skew: bool = True,
    starts: int | None = None,
    step_s: float = 0.00025,
    hold: dict[str, float | None] | None = None,
    temperature_uncertainty_k: float = 5.0,
    density_uncertainty_kg_per_m3: float = 0.0,
    max_misfit_percent: float = 20.0,
    temperature_c: float | Sequence[float | None] | None = None,
    vary_each: Sequence[str] | dict[str, tuple[float, float] | None] | None = None,
    validate: Sequence[Sequence[_Measured]] | None = None,
    plan: _Path | None = None,
) -> Calibrated:
    """Fits parameters of `damper` to bench tests: recorded loops `tests`, each consisting of three float64 arrays, time
    (s), displacement (m) and force (N), or the `indices` of tests, each a dictionary with the columns that `dashpot
    calibrate --indices` reads.

    `vary` names the parameters, as a list of keys or as a dictionary from keys to bounds, where `None` selects the
    plausible ones. `priors` contains prior knowledge as pairs of mean and standard deviation; with `known_priors=False`
    only these apply. Two parameters of the rig are always fitted to loops, `sensor_skew_s` and `force_offset_n`: `vary`
    and `priors` may name them, and `hold` fixes them: it is a dictionary from their keys to values, or to `None` for
    zero. With `skew=False` the sensors are assumed to record at the same instant. The search has `starts` starting
    points, 4 by default.

    `temperature_c` is the oil's temperature in the recordings (degrees Celsius): a number, or a sequence with one for
    each of `tests` and then of `validate`, `None` for that of the damper. `vary_each` names parameters that each test
    has for itself, in the form of `vary`; results call that of the first test `KEY@1`. `validate` has further loops,
    which are not fitted but predicted. `plan` is a sheet, built in or a file, whose tests are judged by how much each
    would narrow the intervals.

    Intervals include the effect of the oil's temperature, known within `temperature_uncertainty_k`, and its density,
    known within `density_uncertainty_kg_per_m3` (half-widths of 95 % intervals). Parameters that the tests do not
    determine are refused, and so is a model whose misfit beyond the noise exceeds `max_misfit_percent` of a test's
    force. Ctrl-C cancels the fit.
    """

def export(
    damper: Damper,
    output: _Path,
    *,
    lang: Literal["rust", "c", "bin"] = "c",
    standalone: bool = False,
    step_s: float = 0.001,
    dtype: DTypeLike | None = None,
    name: str | None = None,
) -> list[pathlib.Path]:
    """Builds a damper for a fixed step and writes it, as `dashpot export --lang`; returns the files, which replace
    older ones.

    `lang` is `"rust"` (a `static` of dashpot-core), `"c"` (bytes for the C library, and a header beside `output`) or
    `"bin"` (bytes only). With `standalone`, C contains the step and needs no library. `dtype` is float32, as on the
    target, or float64. `name` is that of the constant, by default the damper's in capitals. A comment states this call.
    """

def export_fmu(
    dampers: Damper | Sequence[Damper],
    output: _Path,
    *,
    fmi: Literal[2, 3] = 3,
    step_s: float = 0.001,
    dtype: DTypeLike | None = None,
    name: str | None = None,
    loadable: bool = False,
    platforms: dict[str, str] | None = None,
    sources_only: bool = False,
) -> list[str]:
    """Writes a damper, or a sequence of dampers as a bank, as an FMU for co-simulation, as `dashpot export --fmi`;
    returns the platforms of its libraries.

    `fmi` is the version of the standard, 2 or 3; `step_s` the internal step; `dtype` float32 or float64; `name` that of
    the FMU, by default the first damper's in small letters. With `loadable`, the constants are images in the FMU, where
    they can be replaced. A C compiler builds the library for this platform: `cc`, or the one in the variable `CC`.
    `platforms` adds others: a dictionary from platform to compiler, such as `{"x86_64-windows":
    "x86_64-w64-mingw32-gcc"}`. With `sources_only` no compiler is needed; the importer compiles the sources.
    """

def export_health(
    damper: Damper,
    output: _Path,
    *,
    displacement_noise_m: float,
    force_noise_n: float,
    lang: Literal["rust", "c", "bin"] = "c",
    step_s: float = 0.001,
    memory_s: float | None = None,
    law_deviation: float | None = None,
    lag_s: float | None = None,
    lag_sd_s: float | None = None,
    name: str | None = None,
) -> list[pathlib.Path]:
    """Builds the health model of a damper for a fixed step and writes it, as `dashpot export --health`; returns the
    files, which replace older ones.

    The noise of the sensors (standard deviations) must be given; the other properties are those of `dashpot.health`.
    `lang` and `name` are those of `dashpot.export`; the default name ends in `_HEALTH`. Firmware takes the constant
    with `HealthModel::from_image`, C with `dashpot_health_model_init`.
    """

@final
class Contact:
    """Contact of a wheelset on a track. `dashpot.contact` returns it."""
    @property
    def conicity(self) -> dict[str, NDArray[np.float64]]:
        """Equivalent conicity of EN 15302: arrays `amplitude_m` and `equivalent_conicity`, NaN for amplitudes without a
        closed path.
        """
    @property
    def shifts(self) -> dict[str, NDArray[np.float64]]:
        """Geometry of the rigid wheelset at lateral shifts (m), positive to the right, in steps of 25 um: arrays of
        rolling radius difference, roll, contact angles and contact positions on the wheels, named as in the output of
        `dashpot contact --format json`.
        """
    @property
    def elastic_conicity(self) -> dict[str, NDArray[np.float64]] | _MaybeNone:
        """Equivalent conicity on elastic patches, as `conicity`; None without a load."""
    @property
    def wheels(self) -> dict[str, NDArray[np.float64]] | _MaybeNone:
        """Wheels under load, an array per quantity and a row per wheel; `side` is -1 for the left and 1 for the right
        wheel. The names are those of `dashpot contact --format json`. A shift without equilibrium has no rows. None
        without a load.
        """
    @property
    def patches(self) -> dict[str, NDArray[np.float64]] | _MaybeNone:
        """Contact patches under load, as `wheels` with a row per patch. Lateral quantities are positive to the field
        side; forces and moments act on the wheel. None without a load.
        """

def contact(
    wheel: _Path | None = None,
    rail: _Path | None = None,
    *,
    gauge_m: float | None = None,
    gauge_depth_m: float | None = None,
    back_to_back_m: float | None = None,
    back_to_datum_m: float | None = None,
    wheel_radius_m: float | None = None,
    inclination: float | None = None,
    smoothing_m: float | None = None,
    wheel_format: str | None = None,
    rail_format: str | None = None,
    wheel_mirror: str | None = None,
    rail_mirror: str | None = None,
    left_wheel: _Path | None = None,
    left_rail: _Path | None = None,
    left_wheel_format: str | None = None,
    left_rail_format: str | None = None,
    left_wheel_mirror: str | None = None,
    left_rail_mirror: str | None = None,
    load_n: float | None = None,
    lateral_m: Sequence[float] | None = None,
    yaw_rad: float | None = None,
    speed_m_per_s: float | None = None,
    friction: float | None = None,
) -> Contact:
    """Computes the contact of a wheelset. Each profile is built in (`s1002`, `uic60`) or a file in the format of
    MiniProf, SIMPACK or GENSYS, or with two columns; `left_wheel` and `left_rail` are given if the left side differs.

    The formats and mirrors are those of the command `dashpot contact`; give them if the file does not state them.

    With `load_n`, the vertical load of each wheel, the result has the elastic patches, forces and conicity, at the
    shifts `lateral_m` (default: every millimetre up to 8 mm), for the yaw, speed and friction given. A `UserWarning`
    reports a rail file that contains its inclination, or a contact at the end of a profile.
    """
def creep_forces(
    creepages: NDArray[np.float64],
    *,
    load_n: float,
    a_m: float,
    b_m: float,
    friction: float,
    shear_modulus_pa: float | None = None,
    poisson_ratio: float | None = None,
) -> NDArray[np.float64]:
    """Computes creep forces on the wheel by the exact theory of rolling contact, from Kalker's book of tables.

    `creepages` is a float64 array with the columns longitudinal, lateral (1) and spin (1/m). The result has one row for
    each of its rows, with the columns longitudinal force, lateral force (N) and spin moment (N m).

    `a_m` and `b_m` are the semi-axes of the contact in the rolling and in the lateral direction. The shear modulus and
    Poisson's ratio are those of steel by default.
    """
def read(
    path: _Path,
    *,
    step_s: float | None = None,
    with_force: bool = False,
    time: str | None = None,
    displacement: str | None = None,
    force: str | None = None,
    time_unit: str | None = None,
    displacement_unit: str | None = None,
    force_unit: str | None = None,
    group: str | None = None,
    skip_invalid: bool = False,
    header: bool | None = None,
    decimal_mark: Literal["point", "comma"] | None = None,
) -> dict[str, NDArray[np.float64]]:
    """Reads a CSV, MDF4 or Parquet recording into the arrays `time_s` and `displacement_m`, and `force_n` if
    `with_force` is true.

    With `step_s` (s) the recording is resampled at the ticks of that step, linearly between samples, as in `dashpot
    replay`. `time`, `displacement` and `force` name the channels; `time_unit`, `displacement_unit` and `force_unit`
    give their units if the file does not. `group` selects a group of an MDF4 file, `header` states whether the first
    row of a text file contains names, and `decimal_mark` is `point` or `comma`. `skip_invalid` skips rows that lack a
    value. A text file whose last line has no line end may be truncated within a number; it is read with a
    `UserWarning`.
    """

class HealthStatus(enum.IntFlag):
    """Bits of a health estimate. Alarms are latched; `DOUBTS` are the bits of an estimate that cannot be trusted."""
    FLOW = 1
    STIFFNESS = 2
    CLEARANCE = 4
    LITTLE_EXCITATION = 8
    INPUT_REJECTED = 16
    RESTARTED = 32
    NO_FORCE = 64
    FORCE_ZERO = 128
    LATE = 256
    SEVERAL_CHANGED = 512
    MISFIT = 1024
    DOUBTS = 1856

class Estimate(NamedTuple):
    """An estimated value and its standard deviation."""
    value: float
    sd: float

class HealthAlarm(NamedTuple):
    """An alarm: its parameter, when it was first raised (s), and a sentence."""
    parameter: str
    time_s: float
    words: str

class HealthCause(NamedTuple):
    """A possible cause of what the end of a recording shows, with its size, its probability, and a sentence.

    `kind` is a name such as `clearance` or `force_scale`; `value` is in the unit of that quantity.
    """
    kind: str
    value: float
    probability: float
    words: str

@dataclass(frozen=True, eq=False, repr=False)
class Health:
    """Health of a damper at the end of a recording. `dashpot.health` returns it.

    The quantities from `flow_factor` to `added_friction_n` are each a `dashpot.Estimate`. `samples` were used and
    `rejected` left out. `alarms` lists each alarm once; `doubts` has sentences that say why the estimates cannot be
    trusted. `causes` has the possible causes of a change, the most likely first, or is `None` with a baseline and for a
    recording that is too short to tell; `remarks` belongs to the causes. `history` has arrays over `time_s`: each
    estimate and its standard deviation (`clearance_m`, `clearance_m_sd`, ...), the bits `status`, the extremes of the
    force, and the share of the samples used.
    """
    flow_factor: Estimate
    damping_factor: Estimate
    stiffness_n_per_m: Estimate
    clearance_m: Estimate
    lag_s: Estimate
    compliance_m_per_n: Estimate
    force_zero_n: Estimate
    added_friction_n: Estimate
    samples: int
    rejected: int
    status: HealthStatus
    is_trusted: bool
    displacement_noise_m: float
    force_noise_n: float
    alarms: list[HealthAlarm]
    doubts: list[str]
    causes: list[HealthCause] | None
    remarks: list[str]
    history: dict[str, NDArray[Any]]
    def plot(self, quantity: str = "clearance_m", axes: Any = None) -> Any:
        """Plots an estimate over time with a band of two standard deviations, and returns the axes, new ones by
        default. An unknown name raises `KeyError`.
        """
    def _repr_html_(self) -> str: ...

def health(
    damper: Damper,
    recording: _Recording,
    *,
    step_s: float = 0.001,
    displacement_noise_m: float | None = None,
    force_noise_n: float | None = None,
    memory_s: float | None = None,
    law_deviation: float | None = None,
    lag_s: float | None = None,
    lag_sd_s: float | None = None,
    baseline: Health | None = None,
) -> Health:
    """Estimates the health of a damper from its recorded motion and force, as `dashpot replay --health`: damping,
    stiffness and clearance with standard deviations, alarms, and the likely cause of a change.

    `recording` has the float64 arrays `time_s`, `displacement_m` and `force_n`: a dictionary, as `dashpot.read(path,
    with_force=True)` returns it, or a sequence of the three. It is resampled to ticks of `step_s` (s). Noise that is
    not given is estimated from the recording. `memory_s` is the time in contact after which the weight of a sample
    drops to 1/e (default 1 s), `law_deviation` the relative error of the model of a healthy damper within a stroke
    (default 0.05), `lag_s` the lag of the measured force and `lag_sd_s` its standard deviation (default 0 and 1 ms).

    `baseline` is the result of a recording of the damper when it was healthy; without it, the damper itself is the
    baseline. Ctrl-C cancels the estimate.
    """

@dataclass(frozen=True, eq=False, repr=False)
class Fleet:
    """Trends of a fleet's dampers. `dashpot.fleet` returns it.

    `trends` has a row for each damper and parameter, the damper to look at first in front, and `readings` a row for
    each recording: dictionaries of columns, as `pandas.DataFrame` accepts them, with the names of the files that
    `dashpot health` writes with `--trends` and `--output`. `recordings_used` of the `recordings` have a place in a
    trend; the column `refused_because` of `readings` says why others have none. `text` is the report of the command.
    """
    vehicles: int
    dampers: int
    recordings: int
    recordings_used: int
    recordings_unreadable: int
    trends: dict[str, _Column]
    readings: dict[str, _Column]
    text: str
    def _repr_html_(self) -> str: ...

def fleet(
    folder: _Path,
    damper: Damper,
    *,
    mileage: bool = False,
    limit_damping_factor: float | None = None,
    limit_stiffness_n_per_m: float | None = None,
    limit_clearance_m: float | None = None,
    accept_several_changed: bool = False,
    step_s: float = 0.001,
    displacement_noise_m: float | None = None,
    force_noise_n: float | None = None,
    memory_s: float | None = None,
    law_deviation: float | None = None,
    lag_s: float | None = None,
    lag_sd_s: float | None = None,
    time: str | None = None,
    displacement: str | None = None,
    force: str | None = None,
    time_unit: str | None = None,
    displacement_unit: str | None = None,
    force_unit: str | None = None,
    group: str | None = None,
    skip_invalid: bool = False,
    header: bool | None = None,
    decimal_mark: Literal["point", "comma"] | None = None,
) -> Fleet:
    """Estimates trends of a fleet's dampers over months of recordings, as `dashpot health`: rates of change, and when
    limits are reached.

    The file recordings.csv in `folder` lists the recordings; without it, files must be named
    VEHICLE/DAMPER/DATE.EXTENSION. `damper` is the model of recordings that name none. `mileage` uses the mileage
    instead of the date. The limits are the lowest damping relative to nominal, the lowest stiffness and the highest
    clearance, by default those of the kind of damper. `accept_several_changed` uses readings of which several
    parameters have changed together. The other arguments are those of `dashpot.health` and `dashpot.read`. Ctrl-C
    cancels the estimate.
    """

@dataclass(frozen=True, eq=False, repr=False)
class ResponseCurves:
    """Curves of a `dashpot.Response`: arrays with one row per amplitude and one column per frequency.

    For x = A sin wt, the first harmonic of the force is A (K' sin wt + K" cos wt): `storage_n_per_m` is K' (N/m),
    `loss_n_per_m` is K", `dynamic_stiffness_n_per_m` the magnitude of both, `loss_angle_deg` the phase by which the
    force leads the displacement (degrees; NaN without a force), and `damping_n_s_per_m` is K"/w (N s/m).
    """
    dynamic_stiffness_n_per_m: NDArray[np.float64]
    loss_angle_deg: NDArray[np.float64]
    storage_n_per_m: NDArray[np.float64]
    loss_n_per_m: NDArray[np.float64]
    damping_n_s_per_m: NDArray[np.float64]

@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """Frequency response of a damper at `frequency_hz` and `amplitude_m`. `dashpot.response` returns it.

    `harmonic` has the curves of the periodic force, `linearised` those for a peak velocity of 0.1 mm/s with the
    clearance taken up (a single row), and `swept` those of one motion through all frequencies, or `None`. `difference`
    has the relative differences of the swept from the harmonic complex stiffness, or is `None`.
    """
    frequency_hz: NDArray[np.float64]
    amplitude_m: NDArray[np.float64]
    harmonic: ResponseCurves
    linearised: ResponseCurves
    swept: ResponseCurves | _MaybeNone
    difference: NDArray[np.float64] | _MaybeNone
    def plot(self, quantity: str = "dynamic_stiffness_n_per_m", axes: Any = None) -> Any:
        """Plots a quantity of the curves over frequency with matplotlib, one line per amplitude and a dashed one for
        the linearised damper, and returns the axes, new ones by default. An unknown name raises `AttributeError`.
        """

def response(
    damper: Damper,
    amplitude_m: float | Sequence[float] | NDArray[np.float64] | None = None,
    *,
    frequency_hz: NDArray[np.float64] | None = None,
    swept: bool = False,
    octaves_per_minute: float = 1.0,
) -> Response:
    """Computes dynamic stiffness, loss angle and damping over frequency and amplitude, and those of the linearised
    damper, as `dashpot response`.

    `amplitude_m` (m) is a number or a sequence. `frequency_hz` (Hz) is a float64 array; the default is that of the
    command, 41 frequencies from 0.1 to 20 Hz in a constant ratio. With `swept`, one motion through all frequencies,
    which must rise, at `octaves_per_minute` is demodulated and compared. Use a loop over `damper.replace` to compare
    dampers. Ctrl-C cancels the computation.
    """

@dataclass(frozen=True)
class StepError:
    """Largest errors of a damper's step in one precision over a fixed set of motions. `dashpot.verify` returns them.

    `nrmse` is the root mean square error of the worst motion over its root mean square force, `largest_error_n` the
    largest error at a tick, and `largest_wrong_sign_n` the largest force where that of the reference has the opposite
    sign or is zero. The motions are pairs of kind and speed (m/s). `promised_nrmse` and `promised_error_n` are
    guaranteed for every motion of the class in docs/numerics.md.
    """
    scalar: Literal["f32", "f64"]
    step_s: float
    nrmse: float
    nrmse_motion: tuple[str, float]
    largest_error_n: float
    largest_error_over_limit: float
    largest_error_motion: tuple[str, float]
    largest_wrong_sign_n: float
    promised_nrmse: float
    promised_error_n: float

@dataclass(frozen=True)
class RecordedError:
    """Errors of a damper's step in one precision on a recorded motion. `dashpot.verify` returns them.

    `nrmse` is the error of the step alone, with the reference on the displacements at the ticks; `nrmse_on_recording`
    includes the resampling, with the reference on the samples of the recording. `rejected_inputs` is the number of
    ticks whose displacement was held or limited.
    """
    scalar: Literal["f32", "f64"]
    step_s: float
    nrmse: float
    largest_error_over_peak: float
    largest_error_n: float
    reference_rms_n: float
    reference_peak_n: float
    nrmse_on_recording: float
    rejected_inputs: int

@overload
def verify(
    damper: Damper,
    recording: None = None,
    *,
    step_s: float | Sequence[float] | None = None,
    top_speed_m_per_s: float | None = None,
) -> list[StepError]:
    """Measures the accuracy of the fixed step against the adaptive reference solver, as `dashpot verify`: two rows for
    each step of `step_s` (s), one in each precision.

    Without a recording the damper follows about a hundred motions scaled to it, and each row is a `dashpot.StepError`;
    `top_speed_m_per_s` is the top speed of the motions. `recording` has the float64 arrays `time_s` and
    `displacement_m`, as a dictionary or a pair, and each row is then a `dashpot.RecordedError`. Ctrl-C cancels between
    two steps.
    """
@overload
def verify(
    damper: Damper,
    recording: _Recording,
    *,
    step_s: float | Sequence[float] | None = None,
    top_speed_m_per_s: None = None,
) -> list[RecordedError]:
    """Measures the accuracy of the fixed step against the adaptive reference solver, as `dashpot verify`: two rows for
    each step of `step_s` (s), one in each precision.

    Without a recording the damper follows about a hundred motions scaled to it, and each row is a `dashpot.StepError`;
    `top_speed_m_per_s` is the top speed of the motions. `recording` has the float64 arrays `time_s` and
    `displacement_m`, as a dictionary or a pair, and each row is then a `dashpot.RecordedError`. Ctrl-C cancels between
    two steps.
    """

@dataclass(frozen=True, eq=False, repr=False)
class Shims:
    """A valve of a damper and its shim pack. `dashpot.shims` returns one for each valve.

    `shims_m` are the thicknesses of the discs (m), which are clamped at `clamp_radius_m` and free at `free_radius_m`.
    `equivalent_thickness_m` and `edge_compliance_m_per_pa` follow from disc theory under uniform pressure, as does
    `cw`, the deflection coefficient `cw_m6_per_n` over `radius_m`; all three are `None` if the file gives the
    compliance `given_edge_compliance_m_per_pa` instead of discs. The damper model uses
    `effective_edge_compliance_m_per_pa`, which is one of the two multiplied by `equivalent_pressure_factor`, and no
    lift below `preload_pa`.

    `pressures` has columns over `pressure_pa`: `lift_m` and `flow_m3_per_s` as used, `theory_uniform_m`, and the
    published deflections, NaN except for the packs of the source paper, as `theory_over_published`.
    """
    valve: str
    clamp_radius_m: float
    free_radius_m: float
    shims_m: NDArray[np.float64]
    equivalent_thickness_m: float | None
    edge_compliance_m_per_pa: float | None
    cw: dict[str, NDArray[np.float64]] | None
    given_edge_compliance_m_per_pa: float | None
    equivalent_pressure_factor: float
    effective_edge_compliance_m_per_pa: float
    preload_pa: float
    theory_over_published: float | None
    pressures: dict[str, NDArray[np.float64]]
    def plot(self, quantity: str = "lift_m", axes: Any = None) -> Any:
        """Plots a column of `pressures` over the pressure with matplotlib, and returns the axes, new ones by default.
        An unknown name raises `KeyError`.
        """
    def _repr_html_(self) -> str: ...

def shims(damper: Damper) -> list[Shims]:
    """Computes the shim packs of a damper's three valves, as `dashpot shims`: stiffness by disc theory, and lift and
    flow over the pressure as the damper model uses them. Each valve is a `dashpot.Shims`. A reduced damper has no
    valves and is refused.
    """

@dataclass(frozen=True, eq=False, repr=False)
class Modes:
    """Modes of a vehicle. `dashpot.modes` returns it.

    `modes` has columns, as `pandas.DataFrame` accepts them: what moves (`mode`), `undamped_hz`, `damped_hz` and
    `damping_ratio`, which is negative if a mode grows. `axle_loads_n` is an array, and `speed_km_h` the speed of the
    modes, `None` at standstill. The critical speeds and the amplitude of the limit cycle, `limit_cycle_m`, are `None`
    unless `hunting` found them. `friction_elements` is the number of friction elements of the vehicle.
    """
    vehicle: str
    axle_loads_n: NDArray[np.float64]
    speed_km_h: float | None
    critical_speed_km_h: float | None
    nonlinear_critical_speed_km_h: float | None
    limit_cycle_m: float | None
    friction_elements: int
    modes: dict[str, _Column]
    def _repr_html_(self) -> str: ...

def modes(
    vehicle: _Path,
    *,
    speed_km_h: float | None = None,
    hunting: bool = False,
    sliding: bool = False,
    friction: float = 0.4,
    dampers: _Dampers | None = None,
    overrides: _Overrides | None = None,
    contact: dict[str, Any] | None = None,
) -> Modes:
    """Computes axle loads and natural modes of a vehicle at standstill or at a speed, as `dashpot modes`: frequency,
    damping and what moves.

    `vehicle` is built in or a file; `dampers`, `overrides` and `contact` are those of `dashpot.vehicle`. With `hunting`
    the critical speeds are searched for, and the modes are those at the linear one. With `sliding` the friction
    elements slide and have no part in a mode; otherwise they stick.
    """

@dataclass(frozen=True, eq=False, repr=False)
class SheetTest:
    """A measured test of a `dashpot.Sheet`.

    `indices` has the values by name, `half_widths` half of the 95 % interval of each, and `limits` a dictionary for
    each limit of the sheet: `index`, `value`, `half_width`, `least`, `most`, `verdict` (`within`, `undecided` or
    `outside`) and further keys. `recording`, `start_s` and `end_s` say where it was measured, in `cycles` cycles;
    `unsteady_cycles` were left out. `distortion` is the displacement about a sine, `force_change` the change of the
    force from the first to the last cycles, each as a share. `displacement_m`, `velocity_m_per_s` and `force_n` are the
    mean cycle, in steps of `step_s`.
    """
    name: str
    amplitude_m: float
    frequency_hz: float
    peak_velocity_m_per_s: float
    temperature_c: float | None
    step_s: float
    cycles: int
    indices: dict[str, float | None]
    limits: list[dict[str, Any]]
    recording: str
    start_s: float
    end_s: float
    unsteady_cycles: int
    distortion: float
    force_change: float
    half_widths: dict[str, float | None]
    displacement_m: NDArray[np.float64]
    velocity_m_per_s: NDArray[np.float64]
    force_n: NDArray[np.float64]

@dataclass(frozen=True, eq=False, repr=False)
class Sheet:
    """An acceptance sheet from recordings of a bench. `dashpot.sheet` returns it.

    `verdict` is `passed`, `failed`, `undecided`, `incomplete` or `no_limits`; `is_good` is true for the first and the
    last. `tests` has a `dashpot.SheetTest` for each measured test, and `missing` the names of the others. `recordings`
    states each file with its SHA-256, `other_motions` the motions that belong to no test, and `unused_cycles` the
    cycles that belong to no steady motion. `limits` and `limits_not_kept` are numbers. `page` is the sheet as a
    self-contained HTML page, for archiving or printing, and `text` the report of the command.
    """
    title: str
    sheet: str
    fields: dict[str, str]
    verdict: Literal["passed", "failed", "undecided", "incomplete", "no_limits"]
    is_good: bool
    limits: int
    limits_not_kept: int
    warnings: list[str]
    tests: list[SheetTest]
    recordings: list[dict[str, Any]]
    missing: list[str]
    other_motions: list[dict[str, Any]]
    unused_cycles: list[Any]
    text: str
    page: str
    def plot(self, axes: Any = None) -> Any:
        """Plots the mean loops of force over displacement with matplotlib; returns the axes, new ones by default."""
    def _repr_html_(self) -> str: ...

def sheet(
    sheet: _Path,
    recordings: _Path | Sequence[_Path],
    *,
    temperature_c: float | Sequence[float | None] | None = None,
    force_uncertainty_percent: float = 0.0,
    displacement_uncertainty_percent: float = 0.0,
    serial_number: str | None = None,
    operator: str | None = None,
    date: str | None = None,
    time: str | None = None,
    displacement: str | None = None,
    force: str | None = None,
    time_unit: str | None = None,
    displacement_unit: str | None = None,
    force_unit: str | None = None,
    group: str | None = None,
    skip_invalid: bool = False,
    header: bool | None = None,
    decimal_mark: Literal["point", "comma"] | None = None,
) -> Sheet:
    """Computes an acceptance sheet from recordings of a bench, as `dashpot sheet`: indices with uncertainties, limits
    and the verdict.

    `sheet` is built in or a file. `recordings` is a file or a sequence of files, and `temperature_c` the oil's
    temperature in them (degrees Celsius): a number, or a sequence with one for each. The uncertainties are those of the
    calibration of the sensors, in per cent of the value (half of a 95 % interval). Serial number, operator and date are
    for the header. The other arguments are those of `dashpot.read`. A sheet that is not passed is returned like any
    other: see its `verdict`.
    """
