import enum
from collections.abc import Iterator, Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple, TypeAlias, TypeVar, final, overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

_Path: TypeAlias = str | bytes | PathLike[str] | PathLike[bytes]
_Overrides: TypeAlias = dict[str, float | str | bool]
_Floats: TypeAlias = NDArray[np.float32] | NDArray[np.float64]
_Column: TypeAlias = NDArray[np.float64] | NDArray[np.int64] | list[str | int | float | None]
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

class DashpotError(ValueError): ...
class DashpotKeyError(DashpotError, KeyError): ...
class DashpotFileError(DashpotError, OSError):
    def __init__(self, words: str, errno: int | None = None, filename: str | None = None) -> None: ...

class Status(enum.IntFlag):
    INPUT_HELD = 1
    INPUT_LIMITED = 2
    SATURATED = 4
    DAMPER_SWAPPED = 8
    CORRUPTED = 16
    RESTARTED = 32

@final
class Damper:
    def __new__(cls, name: _Path, overrides: _Overrides | None = None) -> Damper: ...
    @staticmethod
    def from_toml(text: str, overrides: _Overrides | None = None, name: str = "damper") -> Damper: ...
    def to_toml(self) -> str: ...
    def replace(self, overrides: _Overrides) -> Damper: ...
    @property
    def name(self) -> str: ...
    def keys(self) -> list[str]: ...
    def values(self) -> list[float]: ...
    def items(self) -> list[tuple[str, float]]: ...
    @overload
    def get(self, key: object, default: None = None, /) -> float | None: ...
    @overload
    def get(self, key: object, default: _T, /) -> float | _T: ...
    def __getitem__(self, key: str, /) -> float: ...
    def __contains__(self, key: object, /) -> bool: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def build(self, step_s: float = 0.001, dtype: DTypeLike | None = None) -> BuiltDamper: ...
    def rig(self, amplitude_m: float, frequency_hz: float, step_s: float = 0.0001) -> Cycle: ...
    def indices(self, amplitude_m: float, frequency_hz: float, step_s: float = 0.0001) -> dict[str, float | None]: ...
    def characteristic(self, velocity_m_per_s: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def reference(self, x: NDArray[np.float64], step_s: float) -> NDArray[np.float64]: ...

@final
class BuiltDamper:
    @property
    def step_s(self) -> float: ...
    @property
    def dtype(self) -> np.dtype[np.float32] | np.dtype[np.float64]: ...
    @property
    def revision(self) -> int: ...
    @property
    def clearance_m(self) -> float: ...
    @property
    def force_limit_n(self) -> float: ...
    def with_clearance_m(self, clearance_m: float) -> BuiltDamper: ...
    def at_rest(self, displacement_m: float = 0.0) -> State: ...
    def step(self, state: State, displacement_m: float) -> float: ...
    def replay(
        self, x: _A, *, state: State | None = None, out: _A | None = None
    ) -> _A: ...
    def state_from_bytes(self, saved: bytes) -> State: ...

@final
class State:
    @property
    def displacement_m(self) -> float: ...
    @property
    def piston_displacement_m(self) -> float: ...
    @property
    def force_n(self) -> float: ...
    @property
    def revision(self) -> int: ...
    @property
    def rejected_inputs(self) -> int: ...
    @property
    def status(self) -> Status: ...
    def clear_status(self) -> None: ...
    def to_bytes(self) -> bytes: ...
    def __copy__(self) -> State: ...
    def __deepcopy__(self, _memo: Any) -> State: ...
    def __eq__(self, other: object, /) -> bool: ...

@final
class Bank:
    def __new__(cls, dampers: Sequence[BuiltDamper]) -> Bank: ...
    def at_rest(self, displacements_m: _Floats | None = None) -> list[State]: ...
    def replay(
        self, x: _A, *, states: Sequence[State] | None = None, out: _A | None = None
    ) -> _A: ...
    @property
    def step_s(self) -> float: ...
    @property
    def dtype(self) -> np.dtype[np.float32] | np.dtype[np.float64]: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[BuiltDamper]: ...

@final
class Cycle:
    @property
    def displacement_m(self) -> NDArray[np.float64]: ...
    @property
    def velocity_m_per_s(self) -> NDArray[np.float64]: ...
    @property
    def force_n(self) -> NDArray[np.float64]: ...
    @property
    def step_s(self) -> float: ...
    @property
    def cycles(self) -> int: ...
    @property
    def indices(self) -> dict[str, float | None]: ...

@final
class VehicleRun:
    @property
    def case(self) -> str: ...
    @property
    def step_s(self) -> float: ...
    @property
    def ending(self) -> str: ...
    @property
    def is_completed(self) -> bool: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def history(self) -> dict[str, NDArray[np.float64]]: ...
    @property
    def indices(self) -> dict[str, Any] | None: ...

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
    dampers: dict[str, _Path | Damper] | dict[str, _Path] | dict[str, Damper] | None = None,
    overrides: _Overrides | None = None,
    signals: Sequence[str] | None = None,
) -> VehicleRun: ...

@final
class Vehicle:
    def __new__(
        cls,
        case: _Path,
        *,
        outside: Sequence[str] = ...,
        dampers: dict[str, _Path | Damper] | dict[str, _Path] | dict[str, Damper] | None = None,
        overrides: _Overrides | None = None,
    ) -> Vehicle: ...
    @property
    def inputs(self) -> list[str]: ...
    @property
    def outputs(self) -> list[str]: ...
    @property
    def step_s(self) -> float: ...
    @property
    def time_s(self) -> float: ...
    @property
    def ending(self) -> str | None: ...
    def set(self, name: str, value: float) -> None: ...
    def get(self, name: str) -> float: ...
    def replace_damper(self, name: str, damper: Damper) -> None: ...
    def step(self, ticks: int = 1, inputs: NDArray[np.float64] | None = None) -> NDArray[np.float64]: ...
    def reset(self) -> None: ...
    def save(self) -> bytes: ...
    def restore(self, state: bytes) -> None: ...

class HybridStatus(enum.IntFlag):
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
    displacement_m: float
    velocity_m_per_s: float = 0.0
    acceleration_m_per_s2: float = 0.0
    jerk_m_per_s3: float = 0.0

class Measured(NamedTuple):
    displacement_m: float
    force_n: float

class Command(NamedTuple):
    command_m: float
    force_n: float
    status: HybridStatus

class TrackingReading(NamedTuple):
    delay_s: float
    amplitude: float
    relative_error: float
    error_m: float

class EnergyReading(NamedTuple):
    added_j: float
    added_share: float

@final
class MotionFilter:
    def __new__(cls, pole_hz: float, step_s: float = 0.001) -> MotionFilter: ...
    def rest_at(self, displacement_m: float) -> None: ...
    def push(self, displacement_m: float) -> Motion: ...
    def __copy__(self) -> MotionFilter: ...
    def __deepcopy__(self, _memo: Any) -> MotionFilter: ...

@final
class TransferSystem:
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
    def tick(self, desired: Sequence[float], measured: Sequence[float] | None = None) -> Command: ...
    def place(self, displacement_m: float) -> None: ...
    def end(self) -> None: ...
    def clear(self) -> bool: ...
    @property
    def tracking(self) -> TrackingReading: ...
    @property
    def energy(self) -> EnergyReading: ...
    @property
    def status(self) -> HybridStatus: ...
    @property
    def phase(self) -> Literal["approaching", "running", "ending", "held"]: ...
    @property
    def compensator(self) -> Literal["none", "polynomial", "inverse", "adaptive"]: ...
    @property
    def coefficients(self) -> tuple[float, float, float, float] | None: ...
    @property
    def step_s(self) -> float: ...
    def __copy__(self) -> TransferSystem: ...
    def __deepcopy__(self, _memo: Any) -> TransferSystem: ...

@final
class Study:
    def __new__(cls, name: _Path, seeds: int | None = None) -> Study: ...
    @staticmethod
    def from_toml(text: str, seeds: int | None = None, name: str = "study") -> Study: ...
    @property
    def columns(self) -> list[str]: ...
    @property
    def digest(self) -> str: ...
    def __len__(self) -> int: ...
    def row(self, number: int) -> dict[str, str | int | float | None]: ...
    def run(self, *, shard: tuple[int, int] | None = None, threads: int | None = None) -> dict[str, _Column]: ...

@final
class Calibrated:
    @property
    def damper(self) -> Damper: ...
    @property
    def values(self) -> dict[str, float]: ...
    @property
    def intervals(self) -> dict[str, tuple[float | None, float | None]]: ...
    @property
    def standard_deviations(self) -> dict[str, float]: ...
    @property
    def correlation(self) -> NDArray[np.float64]: ...
    @property
    def loops(self) -> list[dict[str, Any]]: ...
    @property
    def assumed(self) -> dict[str, dict[str, Any]]: ...
    @property
    def warnings(self) -> list[str]: ...

def calibrate(
    damper: Damper,
    tests: Sequence[Sequence[NDArray[np.float64]]] | None = None,
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
) -> Calibrated: ...
@final
class Contact:
    @property
    def conicity(self) -> dict[str, NDArray[np.float64]]: ...
    @property
    def shifts(self) -> dict[str, NDArray[np.float64]]: ...
    @property
    def elastic_conicity(self) -> dict[str, NDArray[np.float64]] | None: ...
    @property
    def wheels(self) -> dict[str, NDArray[np.float64]] | None: ...
    @property
    def patches(self) -> dict[str, NDArray[np.float64]] | None: ...

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
) -> Contact: ...
def creep_forces(
    creepages: NDArray[np.float64],
    *,
    load_n: float,
    a_m: float,
    b_m: float,
    friction: float,
    shear_modulus_pa: float | None = None,
    poisson_ratio: float | None = None,
) -> NDArray[np.float64]: ...
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
) -> dict[str, NDArray[np.float64]]: ...
