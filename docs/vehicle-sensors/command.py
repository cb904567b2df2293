"""The same runs through `dashpot vehicle-sensors`, compared with the estimator of the study."""

import argparse
import json
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from estimator import Array
from runs import LATERAL, PLAY, vehicle_file
from study import CASES, NAMES, TEST_SEEDS, Study

SIGNALS = [f"s{i}_{'lateral' if i in LATERAL else 'vertical'}_acceleration_m_per_s2" for i in range(12)]


def command(dashpot: str, vehicle: Path, condition: str, inputs: list[Path], options: list[str]) -> str:
    """Output of the command; the vehicle is the nominal one, whatever the condition."""
    damper = ["--damper", "lateral=in-service"] if condition.startswith("phys") else []
    line = [dashpot, "vehicle-sensors", "--vehicle", str(vehicle), "--set", f"lateral.{PLAY}=0.5e-3", *damper, *options]
    line += [part for file in inputs for part in ("--input", str(file))]
    return subprocess.run(line, check=True, capture_output=True, text=True).stdout


def write(file: Path, a: Array) -> Path:
    rows = np.column_stack([np.arange(len(a)) / 100, a])
    np.savetxt(file, rows, "%.9g", ",", header=",".join(["time_s", *SIGNALS]), comments="")
    return file


def compare(study: Study, dashpot: str, condition: str, seed: int, faults: list[str]) -> list[tuple[str, str, Array]]:
    """For each fault with a run: verdicts of study and command, and differences of their ratios by bogie."""
    found = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        vehicle = folder / "vehicle.toml"
        vehicle.write_text(vehicle_file("coach" if condition.startswith("coach") else "base"))
        sensors, runs, _, _ = study.baseline(condition, seed)
        inputs = [write(folder / f"{i}.csv", a) for i, a in enumerate(runs)]
        baseline = folder / "baseline.json"
        command(dashpot, vehicle, condition, inputs, ["--new-baseline", str(baseline)])
        later = sensors.drifted(np.random.default_rng([seed, 1]))
        for fault in faults:
            if seed not in study.seeds(condition, fault):
                continue
            ride = write(folder / "ride.csv", study.readings(later, condition, fault, seed))
            options = ["--baseline", str(baseline), "--format", "json"]
            bogies = json.loads(command(dashpot, vehicle, condition, [ride], options))["bogies"]
            worn = [b for b in bogies if b["condition"] == "worn"]
            word = "both" if len(worn) == 2 else ""
            if len(worn) == 1:
                word = worn[0]["bogie"].split()[0] + (f" {(worn[0]['damper'] or '')[-1:]}").rstrip()
            reading = study.run(condition, fault, seed)[0]
            word = word or ("undecided" if any(b["condition"] == "undecided" for b in bogies) else "new")
            found.append((reading.verdict() or "new", word, np.array([b["ratio"] for b in bogies]) - reading.pair))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--dashpot", default="dashpot")
    parser.add_argument("--folder", type=Path, default=Path("vehicle-sensors"), help="runs that study.py has recorded")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    study = Study(options.folder)
    conditions: dict[str, list[str]] = {}
    for condition, fault in CASES:
        conditions.setdefault(condition, []).append(fault)
    print("| operation | runs | same verdict | undecided | greatest difference of a ratio |\n|---|---|---|---|---|")
    with ThreadPoolExecutor(options.workers) as pool:
        for condition, faults in conditions.items():
            jobs = [pool.submit(compare, study, options.dashpot, condition, seed, faults) for seed in TEST_SEEDS]
            found = [entry for job in jobs for entry in job.result()]
            same = sum(one == other for one, other, _ in found)
            undecided = sum(other == "undecided" for _, other, _ in found)
            worst = max(float(np.abs(difference).max()) for _, _, difference in found)
            print(f"| {NAMES[condition]} | {len(found)} | {same} | {undecided} | {worst:.3f} |")
            for one, other, _ in found:
                if one != other and (one, other) != ("new", "undecided"):
                    print(f"    {one}, not {other}")


if __name__ == "__main__":
    main()
