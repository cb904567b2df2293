"""Runs of the study: faults, conditions, their recording with `dashpot vehicle`, and the errors of sensors."""

import shutil
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from estimator import COACH, LOCOMOTIVE, Array, G

DATA = Path(__file__).resolve().parents[2] / "data"
LATERAL = [0, 1, 4, 5, 8, 9]  # of the twelve sensors; the others are vertical

FRONT, REAR = ("front lateral damper", "rear lateral damper")
C, PLAY, KE = ("reduced.damping_n_s_per_m", "mount.clearance_m", "mount.stiffness_n_per_m")
FAULTS = {
    "new": [], "f1dead": [f"{FRONT} 1.{C}=90"], "f2dead": [f"{FRONT} 2.{C}=90"], "r1dead": [f"{REAR} 1.{C}=90"],
    "f1half": [f"{FRONT} 1.{C}=45e3"], "r1half": [f"{REAR} 1.{C}=45e3"],
    "f1c3": [f"{FRONT} 1.{PLAY}=3e-3"], "f1c6": [f"{FRONT} 1.{PLAY}=6e-3"], "f1c12": [f"{FRONT} 1.{PLAY}=12e-3"],
    "r1c6": [f"{REAR} 1.{PLAY}=6e-3"], "f1k1": [f"{FRONT} 1.{KE}=1e6"],
    "fpairhalf": [f"{FRONT} {i}.{C}=45e3" for i in (1, 2)], "fpairdead": [f"{FRONT} {i}.{C}=90" for i in (1, 2)],
    "allhalf": [f"lateral.{C}=45e3"], "allc3": [f"lateral.{PLAY}=3e-3"],
}


def loads(factor: float, mass: float, roll: float, pitch: float, yaw: float) -> list[str]:
    """Overrides for a body of another mass."""
    keys = zip(("mass_kg", *(f"{axis}_inertia_kg_m2" for axis in ("roll", "pitch", "yaw"))), (mass, roll, pitch, yaw),
               strict=True)
    return [f"body.{key}={factor * value}" for key, value in keys]


def springs(bogies: str) -> list[str]:
    return [f"{b} secondary spring.stiffness_n_per_m=[383.4e3, 383.4e3, 1596e3]" for b in bogies.split()]


BODY = (63400, 143500, 1521e3, 1718e3)
IN_SERVICE = ["--damper", "lateral=in-service"]
# name: speed, spectrum, overrides, options
CONDITIONS: dict[str, tuple[float, str, list[str], list[str]]] = {
    "base": (180, "fra-6", [], []), "v100": (100, "fra-6", [], []), "v140": (140, "fra-6", [], []),
    "v200": (200, "fra-6", [], []), "fra5": (140, "fra-5", [], []), "german": (180, "german-low", [], []),
    "curve": (160, "fra-6", [], []),
    "m110": (180, "fra-6", loads(1.1, *BODY), []), "m90": (180, "fra-6", loads(0.9, *BODY), []),
    "mu20": (180, "fra-6", [], ["--friction", "0.2"]), "incl20": (180, "fra-6", [], ["--rail-inclination", "0.05"]),
    "gauge": (180, "fra-6", [], ["--gauge-m", "1.431"]),
    "kf90": (180, "fra-6", springs("front"), []), "k90": (180, "fra-6", springs("front rear"), []),
    "yaw1": (180, "fra-6", [f"front yaw damper 1.{C}=1320"], []),
    "vert": (180, "fra-6", [f"front vertical damper.{PLAY}=4e-3"], []),
    "fric": (180, "fra-6", [], []), "phys": (180, "fra-6", [], IN_SERVICE),
    "physcold": (180, "fra-6", ["lateral.oil.temperature_c=-20"], IN_SERVICE),
    "physhot": (180, "fra-6", ["lateral.oil.temperature_c=50"], IN_SERVICE),
    "coach": (160, "fra-6", [], []), "coachm": (160, "fra-6", loads(1.1, 32e3, 56800, 1.97e6, 1.97e6), []),
}
CURVE = 'length_m = 50\n\n[[part]]\nkind = "transition"\nlength_m = 100\n\n[[part]]\nkind = "circular"\n' \
    "length_m = 20000\nradius_m = 2000\ncant_m = 0.1\n\n[irr"


def vehicle_file(condition: str) -> str:
    """The shipped vehicle with the sensors as ride points; `fric` has dry friction and a traction rod in addition."""
    vehicle = COACH if condition.startswith("coach") else LOCOMOTIVE
    text = (DATA / f"vehicles/{vehicle.file}.toml").read_text().split("[[ride_point")[0]
    places: list[tuple[str, float, float, float]] = [("body", vehicle.pivot, 0, 1.1), ("body", -vehicle.pivot, 0, 1.1)]
    places += [("body", 0, -1.2, 1.1), ("body", 0, 1.2, 1.1)]
    for name, x in (("front bogie", vehicle.pivot), ("rear bogie", -vehicle.pivot)):
        places += [(name, x + 2.5, 0, 0.7), (name, x - 2.5, 0, 0.7), (name, x, -1, 0.7), (name, x, 1, 0.7)]
        if condition == "fric":
            between, ahead = f'between = ["{name}", "body"]', np.sign(x)
            text += f'\n[[friction]]\nname = "{name} friction"\n{between}\ndirection = "lateral"\n' \
                f"stiffness_n_per_m = 10e6\nfriction_n = 2000\nat_m = [[{x}, -0.978, 0.684], [{x}, 0.978, 0.684]]\n" \
                f'\n[[traction_rod]]\nname = "{name} rod"\n{between}\nstiffness_n_per_m = 10e6\n' \
                f"damping_n_s_per_m = 25e3\nfrom_m = [{x}, 0, 0.4]\nto_m = [{x - 1.5 * ahead:.2f}, 0, 0.5]\n"
    for i, (name, x, y, z) in enumerate(places):
        text += f'\n[[ride_point]]\nname = "s{i}"\nbody = "{name}"\nat_m = [{x:.2f}, {y}, {z}]\n'
    return text


def record(dashpot: str, folder: Path, condition: str, fault: str, seed: int) -> None:
    """Runs 35 s and keeps accelerations and rolls of the sensors at 100 Hz; nothing of a run that leaves the rails."""
    file = folder / f"{condition}_{fault}_{seed}.npz"
    if file.exists():
        return
    speed, spectrum, overrides, options = CONDITIONS[condition]
    work = folder / f"{condition}_{fault}_{seed}.tmp"
    work.mkdir(parents=True, exist_ok=True)
    track = (DATA / "tracks/straight.toml").read_text().replace("length_m = 1000", "length_m = 20000")
    track = track.replace("seed = 1", f"seed = {seed}").replace("fra-6", spectrum)
    if condition == "curve":
        track = track.replace("length_m = 20000\n\n[irr", CURVE, 1)
    (work / "track.toml").write_text(track)
    (work / "vehicle.toml").write_text(vehicle_file(condition))
    changes = FAULTS[fault]
    if condition.startswith("coach"):
        changes = [change.replace("=45e3", "=16e3") for change in changes]
    if condition == "phys" and fault == "f1dead":
        changes = [f"{FRONT} 1.{PLAY}=20e-3"]
    sets = [f"vertical.{PLAY}=0.5e-3", f"lateral.{PLAY}=0.5e-3", *overrides, *changes]
    command = [dashpot, "vehicle", "-q", "--vehicle", str(work / "vehicle.toml"), "--track", str(work / "track.toml"),
               "--speed-km-h", f"{speed}", "--start-m", "-15", "--duration-s", "35", "--step-us", "2000", "--no-page",
               "--output", str(work), *(part for value in sets for part in ("--set", value)), *options]
    if subprocess.run(command, check=False).returncode:
        np.savez_compressed(file, x=np.empty((0, 15)))
        shutil.rmtree(work)
        return
    with (work / "history.csv").open() as lines:
        names = lines.readline().strip().split(",")
    axis = ["lateral" if i in LATERAL else "vertical" for i in range(12)]
    columns = [f"s{i}_{a}_acceleration_m_per_s2" for i, a in enumerate(axis)]
    columns += ["body_roll_rad", "front_bogie_roll_rad", "rear_bogie_roll_rad"]
    x = np.loadtxt(work / "history.csv", delimiter=",", skiprows=1, usecols=[names.index(c) for c in columns])
    taps = np.sinc((np.arange(101) - 50) / 5) * np.hamming(101)  # anti-alias filter, 500 to 100 Hz
    x = np.stack([np.convolve(column, taps / taps.sum(), "same")[::5] for column in x.T], 1)
    np.savez_compressed(file, x=x.astype(np.float32))
    shutil.rmtree(work)


@dataclass(frozen=True)
class Sensors:
    """Errors of twelve accelerometers: factors of gain, tilt towards the other axis, noise and resolution."""

    gain: Array
    tilt: Array
    noise: float = 0.02
    resolution: float = 0.005

    def drifted(self, rng: np.random.Generator) -> "Sensors":
        """Later: gains by another 0.5 %, tilts by 2 mrad."""
        gain, tilt = self.gain + 0.005 * rng.standard_normal(12), self.tilt + 0.002 * rng.standard_normal(12)
        return replace(self, gain=gain, tilt=tilt)

    def read(self, x: Array, rng: np.random.Generator) -> Array:
        """Readings: lateral sensors also see the gravity of their body's roll."""
        a = x[:, :12].astype(float)
        a[:, LATERAL] -= G * x[:, [12, 12, 13, 13, 14, 14]]
        means = a.reshape(-1, 3, 2, 2).mean(3)[:, :, ::-1].repeat(2, 2).reshape(-1, 12)  # the other axis of each body
        a = (a + self.tilt * means) * (1 + self.gain) + self.noise * rng.standard_normal(a.shape)
        return np.round(a / self.resolution) * self.resolution
