"""Runs ORVD on the inputs in this folder and writes gz18-straight-60.csv and gz18-straight-120.csv.

    python3 run.py ORVD PROGRAM WORK [SPEED_KM_H...]

ORVD is the folder of its sources, PROGRAM its orvd_gz18_dynamics_qualification, WORK a new folder for input and output.
Without speeds, it runs at 60 and 120 km/h.
"""

import csv
import json
import resource
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
WHEELSETS = ["front_leading", "front_trailing", "rear_leading", "rear_trailing"]
TARGET_N = 68295.99375
# ORVD fixes the tread datum at 746.5 mm from the middle of the axle. S1002 has it at 750 mm: 1360 mm back to back,
# 70 mm from the back of the flange. Moving the points aside by the difference has the same effect.
WHEEL_SHIFT_MM = 750 - 746.5
# Radius at which the wheels start to roll, from `dashpot contact`: 68.296 kN per wheel, shift 0.
ROLLING_RADIUS_M = 0.419966


def points(name):
    lines = (HERE / name).read_text().splitlines()
    return [[float(number) for number in line.split()] for line in lines if not line.startswith("#")]


def write_json(path, value):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(value, indent=1))


def write_profile(path, role, identifier, points_mm):
    write_json(path, {
        "profile_identifier": identifier,
        "profile_role": role,
        "coordinate_frame": "lateral_right_vertical_down",
        "length_unit": "meter",
        "lateral_meters": [1e-3 * y for y, _ in points_mm],
        "vertical_meters": [1e-3 * z for _, z in points_mm],
    })


def write_data_root(root):
    """Writes the profiles and the irregularity where ORVD looks for them."""
    wheel = [[y + WHEEL_SHIFT_MM, z] for y, z in points("wheel.txt")]
    name = "gz18_reference_wheel_profile"
    write_profile(root / "vehicle_library/gz18/wheel_profiles" / f"{name}.json", "wheel", name, wheel)
    write_profile(root / "track_library/rail_profiles/uic60_rail_profile.json", "rail", "uic60_rail_profile",
                  points("rail.txt"))
    with open(HERE / "irregularity.csv") as file:
        rows = list(csv.DictReader(file))
    folder = root / "track_library/irregularities"
    for direction in ["lateral", "vertical"]:
        write_json(folder / "series" / f"dashpot_{direction}.json", {
            "series_identifier": f"dashpot_{direction}",
            "track_station_meters": [float(row["distance_m"]) for row in rows],
            "displacement_meters": [1e-3 * float(row[f"{direction}_mm"]) for row in rows],
        })
    write_json(folder / "dashpot.json", {
        "track_irregularity_identifier": "dashpot",
        "coordinate_frame": "track_lateral_right_vertical_down",
        "lateral_series_identifier": "dashpot_lateral",
        "vertical_series_identifier": "dashpot_vertical",
    })


def run(orvd, program, work, startup, name, duration_s):
    """Runs ORVD and returns its rows, 5 ms apart, and its computing times."""
    write_json(work / f"{name}.json", startup)
    output = work / name
    begin = time.monotonic(), processor_s()
    subprocess.run([
        program, orvd / "vehicle_library/gz18/vehicle_definition.json", work / f"{name}.json",
        orvd / "track_library/geometries/straight_level_1100m.json", work / "root", "dashpot", output,
        str(round(duration_s * 1e9)), "5000000",
    ], check=True, env={"OMP_NUM_THREADS": "1"})
    whole_s, used_s = time.monotonic() - begin[0], processor_s() - begin[1]
    with open(output / "observations.tsv") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    performance = json.loads((output / "performance.json").read_text())
    return rows, [performance["advance_wall_seconds"], whole_s, used_s]


def processor_s():
    """Processor time of all programs that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def first_load_n(rows):
    return float(rows[0]["front_leading_wheelset.right.vertical_support_force_on_wheel_newtons"])


def main():
    orvd, program, work = [Path(argument).absolute() for argument in sys.argv[1:4]]
    work.mkdir()
    write_data_root(work / "root")
    startup = json.loads((orvd / "vehicle_library/gz18/startup_states/moving_startup_60kmh.json").read_text())
    startup["common_wheel_spin_generation"]["effective_rolling_radius_meters"] = ROLLING_RADIUS_M
    # Height of the rails at which the wheels carry the vehicle at the start: load to the power 2/3 is almost linear.
    offsets_m, linear = [0.0], []
    for attempt in range(20):
        startup["rail_profile_reference_vertical_offset_meters"] = offsets_m[-1]
        rows, _ = run(orvd, program, work, startup, f"load-{attempt}", 0.005)
        linear.append(first_load_n(rows) ** (2 / 3))
        missing = TARGET_N ** (2 / 3) - linear[-1]
        if abs(missing) < 1e-4:
            break
        if attempt == 0 or linear[-2] == 0:
            offsets_m.append(offsets_m[-1] - 1e-4)
        else:
            offsets_m.append(offsets_m[-1] + missing * (offsets_m[-1] - offsets_m[-2]) / (linear[-1] - linear[-2]))
    print(f"vertical offset of the rails {offsets_m[-1]:.9f} m, load {first_load_n(rows):.2f} N")
    for speed_km_h in [int(speed) for speed in sys.argv[4:]] or [60, 120]:
        startup["initial_longitudinal_speed_meters_per_second"] = speed_km_h / 3.6
        rows, [advance_s, whole_s, used_s] = run(orvd, program, work, startup, f"straight-{speed_km_h}", 20)
        print(f"{speed_km_h} km/h: integration {advance_s:.1f} s, whole process {whole_s:.1f} s, "
              f"processor {used_s:.1f} s")
        with open(HERE / f"gz18-straight-{speed_km_h}.csv", "w") as file:
            file.write("time_s" + "".join(f",lateral_{i}_mm,yaw_{i}_mrad" for i in range(1, 5))
                       + ",body_lateral_mm,right_load_1_kn\n")
            for row in rows[::4]:
                numbers = [f"{float(row['time_seconds']):.2f}"]
                for wheelset in WHEELSETS:
                    for quantity in ["lateral_meters", "yaw_radians"]:
                        numbers.append(f"{1e3 * float(row[f'{wheelset}_wheelset.{quantity}']):.5f}")
                numbers.append(f"{1e3 * float(row['carbody.lateral_meters']):.5f}")
                load = row["front_leading_wheelset.right.vertical_support_force_on_wheel_newtons"]
                numbers.append(f"{1e-3 * float(load):.4f}")
                file.write(",".join(numbers) + "\n")


main()
