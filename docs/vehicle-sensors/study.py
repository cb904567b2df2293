"""What accelerometers alone tell about the lateral dampers of a vehicle: prints the tables of vehicle-sensors.md.

    python3 docs/vehicle-sensors/study.py --dashpot target/release/dashpot --folder runs [--workers 2]

The folder keeps the recorded runs, so that only missing ones are computed. Needs numpy.
"""

import argparse
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from bank import bank
from estimator import BLOCK_S, COACH, LINEAR, LOCOMOTIVE, MIN_BLOCKS, MISFIT, PHYSICAL, RATE_HZ, Array, Reading, Vehicle
from estimator import compare, normal, solve
from runs import CONDITIONS, FAULTS, LATERAL, Sensors, record

GROUPS = {"fric": ("fric", LOCOMOTIVE, 3), "phys": ("phys", PHYSICAL, 3), "coac": ("coach", COACH, 3)}
TEST_SEEDS = range(105, 113)
OPERATIONS = ["base", "v100", "v140", "v200", "german", "fra5", "curve", "m110", "m90", "mu20", "incl20", "gauge",
              "kf90", "k90", "yaw1", "vert"]
OTHERS = {"fric": ("new", "f1half", "f1dead", "f1c6"), "phys": ("new", "f1dead", "f1c6"), "physcold": ("new",),
          "physhot": ("new",), "coach": ("new", "f1half", "f1dead", "f1c6"), "coachm": ("new", "f1half")}
NAMES = {
    "base": "180 km/h, class 6", "v100": "100 km/h", "v140": "140 km/h", "v200": "200 km/h",
    "german": "German spectrum, low", "fra5": "class 5, 140 km/h", "curve": "curve R 2000 m, 160 km/h",
    "m110": "body mass + 10 %", "m90": "body mass - 10 %", "mu20": "friction 0.2", "incl20": "rails at 1:20",
    "gauge": "gauge 1431 mm", "kf90": "front springs - 10 %", "k90": "all springs - 10 %",
    "yaw1": "one yaw damper without force", "vert": "front vertical dampers 4 mm",
    "fric": "with dry friction", "phys": "dampers `in-service`", "physcold": "dampers `in-service`, -20 °C",
    "physhot": "dampers `in-service`, 50 °C", "coach": "coach, 160 km/h", "coachm": "coach, body mass + 10 %",
    "new": "new", "f1dead": "front 1 no force", "f2dead": "front 2 no force", "r1dead": "rear 1 no force",
    "f1half": "front 1 half force", "r1half": "rear 1 half force", "f1c3": "front 1, 3 mm", "f1c6": "front 1, 6 mm",
    "f1c12": "front 1, 12 mm", "r1c6": "rear 1, 6 mm", "f1k1": "front 1, Ke 1 MN/m",
    "fpairhalf": "both front half force", "fpairdead": "both front no force", "allhalf": "all half force",
    "allc3": "all 3 mm",
}
CASES = [("base", fault) for fault in FAULTS] + [(c, f) for c in OPERATIONS[1:] for f in ("new", "f1half")]
CASES += [(condition, fault) for condition, faults in OTHERS.items() for fault in faults]


@dataclass
class Study:
    """Readings of recorded runs, each seed with sensors and a baseline of its own."""

    folder: Path
    noise: float = 0.02
    vertical: bool = True
    late_s: float = 0.0  # of the bogies' sensors, after the baseline
    vehicle: Vehicle | None = None

    def __post_init__(self) -> None:
        self.unexplained: list[float] = []  # share of the left sides that each baseline leaves
        self.known: dict[tuple[str, int], tuple[Sensors, list[Array], tuple[Array, Array], Vehicle]] = {}

    def seeds(self, condition: str, fault: str) -> list[int]:
        """Seeds of the runs that stayed on the rails."""
        files = {seed: self.folder / f"{condition}_{fault}_{seed}.npz" for seed in TEST_SEEDS}
        return [seed for seed, file in files.items() if len(np.load(file)["x"])]

    def readings(self, sensors: Sensors, condition: str, fault: str, seed: int) -> Array:
        x = np.load(self.folder / f"{condition}_{fault}_{seed}.npz")["x"]
        a = sensors.read(x, np.random.default_rng([seed, 7]))
        return a if self.vertical else a * np.isin(np.arange(12), LATERAL)

    def baseline(self, condition: str, seed: int) -> tuple[Sensors, list[Array], tuple[Array, Array], Vehicle]:
        name, vehicle, count = GROUPS.get(condition[:4], ("base", LOCOMOTIVE, 6))
        if (name, seed) not in self.known:
            rng, vehicle = np.random.default_rng(seed), self.vehicle or vehicle
            sensors = Sensors(0.015 * rng.standard_normal(12), 0.01 * rng.standard_normal(12), self.noise)
            runs = [self.readings(sensors, name, "new", i) for i in range(1, count + 1)]
            blocks = [normal(a, vehicle) for a in runs]
            matrix, vector, left = (np.concatenate(parts) for parts in zip(*blocks, strict=True))
            both = solve(matrix, vector)
            self.unexplained.append(float(1 - both[0] @ vector.sum(0) / left.sum()))
            self.known[name, seed] = sensors, runs, both, vehicle
        return self.known[name, seed]

    def run(self, condition: str, fault: str, seed: int) -> tuple[Reading, float | None, list[Reading]]:
        """The reading of the whole run, the distance of its first verdict, and readings by blocks."""
        sensors, _, baseline, vehicle = self.baseline(condition, seed)
        sensors = sensors.drifted(np.random.default_rng([seed, 1]))
        a = self.readings(sensors, condition, fault, seed)
        turn = np.exp(-2j * np.pi * self.late_s * np.fft.rfftfreq(len(a), 1 / RATE_HZ))
        a[:, 4:] = np.fft.irfft(np.fft.rfft(a[:, 4:].T) * turn, len(a)).T
        matrix, vector, _ = normal(a, vehicle)
        series = [compare(solve(matrix[:n], vector[:n]), baseline) for n in range(MIN_BLOCKS, len(matrix) + 1)]
        first = next((i for i, reading in enumerate(series) if reading.verdict()), None)
        speed = CONDITIONS[condition][0] / 3.6
        return series[-1], None if first is None else (first + MIN_BLOCKS) * BLOCK_S * speed, series


def extent(values: list[float]) -> str:
    return f"{min(values):.2f} to {max(values):.2f}"


def verdicts(runs: list[Reading]) -> str:
    words = [run.verdict() or "new" for run in runs]
    return ", ".join(f"{word}: {words.count(word)}" for word in dict.fromkeys(sorted(words)))


def faults(study: Study, cases: list[tuple[str, str]]) -> None:
    print("\n| vehicle | dampers | front | rear | front 1 | front 2 | front spring | verdicts | alarm, m |")
    print("|---|---|---|---|---|---|---|---|---|")
    for condition, fault in cases:
        runs = [study.run(condition, fault, seed) for seed in study.seeds(condition, fault)]
        readings, first = [r for r, _, _ in runs], [d for _, d, _ in runs if d is not None]
        values = [extent([float(r.pair[i]) for r in readings]) for i in (0, 1)]
        values += [extent([float(r.each[i]) for r in readings]) for i in (0, 1)]
        values += [extent([float(r.spring[0]) for r in readings])]
        alarm = " to ".join(dict.fromkeys(f"{d:.0f}" for d in (min(first), max(first)))) if first else "-"
        print(f"| {NAMES[condition]} | {NAMES[fault]} | {' | '.join(values)} | {verdicts(readings)} | {alarm} |")
    print(f"\nunexplained: {', '.join(f'{100 * share:.1f} %' for share in study.unexplained)}")


def operations(study: Study) -> None:
    print("\n| operation | new: front | rear | verdicts | half force: front | rear | verdicts |")
    print("|---|---|---|---|---|---|---|")
    for condition in OPERATIONS:
        cells = []
        for fault in ("new", "f1half"):
            readings = [study.run(condition, fault, seed)[0] for seed in study.seeds(condition, fault)]
            cells += [extent([float(r.pair[i]) for r in readings]) for i in (0, 1)] + [verdicts(readings)]
        print(f"| {NAMES[condition]} | {' | '.join(cells)} |")


def methods(folder: Path) -> None:
    """False and missed alarms of each way to evaluate the same runs of the locomotive."""
    print("\n| method | unexplained | new: false alarms | front ratio | half force: front found | front ratio |")
    print("|---|---|---|---|---|---|")
    for name, study in {
        "balance of forces, damper's law": Study(folder), "noise 0.05 m/s^2": Study(folder, 0.05),
        "bogies' sensors 5 ms later than in the baseline": Study(folder, late_s=0.005),
        "bogies' sensors 10 ms later": Study(folder, late_s=0.01),
        "without vertical sensors": Study(folder, vertical=False),
        "body: mass + 20 %, centre of gravity + 0.3 m":
            Study(folder, vehicle=replace(LOCOMOTIVE, mass=1.2 * LOCOMOTIVE.mass, cg_height=2.4)),
        "law: a third less damping, no play": Study(folder, vehicle=replace(LOCOMOTIVE, law=(60, 0.07, 7000, 0))),
        "linear dampers": Study(folder, vehicle=LINEAR),
    }.items():
        cells = []
        for fault, wanted in (("new", ("front", "rear", "both")), ("f1half", ("front",))):
            runs = [study.run(c, fault, seed)[0] for c in OPERATIONS for seed in study.seeds(c, fault)]
            hits = sum(r.verdict().startswith(wanted) for r in runs)
            cells += [f"{hits} of {len(runs)}", extent([float(r.pair[0]) for r in runs])]
        print(f"| {name} | {100 * np.mean(study.unexplained):.1f} % | {' | '.join(cells)} |")


def filters(folder: Path) -> None:
    """The same for Kalman filters over the linear vehicle, of which the likeliest is believed."""
    study, nine = Study(folder, vehicle=LINEAR), [(f, r) for f in (1.0, 0.75, 0.5) for r in (1.0, 0.75, 0.5)]
    fine = [(float(f), float(r)) for f in np.arange(0.7, 1.35, 0.1) for r in np.arange(0.7, 1.35, 0.1)]
    cases = [(c, f) for c in OPERATIONS for f in ("new", "f1half")]
    found: dict[tuple[str, str], list[tuple[float, float]]] = {case: [] for case in cases}
    for seed in TEST_SEEDS:
        sensors, baseline, (value, _), _ = study.baseline("base", seed)
        best = fine[int(np.argmin(np.sum([bank(a, LINEAR, value, fine) for a in baseline], 0)))]
        value = value * np.array([1, 1, best[0], best[0], best[1], best[1], 1, 1])
        later = sensors.drifted(np.random.default_rng([seed, 1]))
        for case, grades in found.items():
            if seed in study.seeds(*case):
                grades.append(nine[int(np.argmin(bank(study.readings(later, *case, seed), LINEAR, value, nine)))])
    for title, conditions in (("as in the baseline", ["base"]), ("all operations", OPERATIONS)):
        alarms = [g != (1, 1) for c in conditions for g in found[c, "new"]]
        hits = [g[0] < 1 and g[1] == 1 for c in conditions for g in found[c, "f1half"]]
        print(f"| linear Kalman filters, {title} | | {sum(alarms)} of {len(alarms)} | | {sum(hits)} of {len(hits)} | |")


def distances(study: Study) -> None:
    """Scatter over the seeds of the ratio of the front bogie after some distance, at 180 km/h."""
    conditions = [c for c in OPERATIONS if CONDITIONS[c][:2] == (180, "fra-6")]
    print("\n| distance, m | new: mean, sd, stated sd | half force: mean, sd, stated sd |\n|---|---|---|")
    series = {f: [study.run(c, f, s)[2] for c in conditions for s in TEST_SEEDS] for f in ("new", "f1half")}
    for i in (0, 4, 8, 16):
        cells = [f"{np.mean(x := [r[i].pair[0] for r in runs]):.3f}, {np.std(x, ddof=1):.3f}, "
                 f"{np.mean([r[i].pair_sd[0] for r in runs]):.3f}" for runs in series.values()]
        print(f"| {(MIN_BLOCKS + i) * BLOCK_S * 50:.0f} | {' | '.join(cells)} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dashpot", default="dashpot")
    parser.add_argument("--folder", type=Path, default=Path("vehicle-sensors"))
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    jobs = [(name, "new", seed) for name, count in (("base", 6), ("fric", 3), ("phys", 3), ("coach", 3))
            for seed in range(1, count + 1)] + [(*case, seed) for seed in TEST_SEEDS for case in CASES]
    with ThreadPoolExecutor(options.workers) as pool:
        list(pool.map(lambda job: record(options.dashpot, options.folder, *job), jobs))
    study = Study(options.folder)
    faults(study, [case for case in CASES if case[0] == "base"])
    operations(study)
    for name in ("fric", "phys", "coach"):
        faults(Study(options.folder), [case for case in CASES if case[0] in OTHERS and case[0].startswith(name)])
    faults(Study(options.folder, vehicle=MISFIT), [case for case in CASES if case[0] == "phys"])
    methods(options.folder)
    filters(options.folder)
    distances(study)


if __name__ == "__main__":
    main()
