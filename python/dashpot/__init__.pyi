import enum
from collections.abc import Iterator, Mapping, Sequence
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
    "HybridStatus",
    "Measured",
    "Motion",
    "MotionFilter",
    "State",
    "Status",
    "Study",
    "TrackingReading",
    "TransferSystem",
    "Vehicle",
    "VehicleRun",
    "calibrate",
    "contact",
    "creep_forces",
    "read",
    "vehicle",
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

    Intervals include the effect of the oil's temperature, known within `temperature_uncertainty_k`, and its density,
    known within `density_uncertainty_kg_per_m3` (half-widths of 95 % intervals). Parameters that the tests do not
    determine are refused, and so is a model whose misfit beyond the noise exceeds `max_misfit_percent` of a test's
    force. Ctrl-C cancels the fit.
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
