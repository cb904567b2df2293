"""Checks an FMU with FMPy: problems in its description, and forces for the displacements in a file.

    python3 fmpy_judge.py FMU DISPLACEMENTS_M OUTPUT_FORCES_N [--compile]

DISPLACEMENTS_M contains one number per line, one for each communication step of 1 ms.
"""

import shutil
import sys

import fmpy
import numpy as np
from fmpy.build import build_platform_binary
from fmpy.validation import validate_fmu

STEP_S = 1e-3


def main():
    fmu, displacements, output = sys.argv[1:4]
    problems = validate_fmu(fmu)
    if problems:
        sys.exit("\n".join(problems))
    folder = fmpy.extract(fmu)
    try:
        if "--compile" in sys.argv:
            shutil.rmtree(f"{folder}/binaries", ignore_errors=True)
            build_platform_binary(folder, generator="Unix Makefiles", all_warnings=True)
        x = np.loadtxt(displacements)
        time = np.arange(len(x)) * STEP_S
        columns = [("time", np.float64), ("displacement_m", np.float64)]
        result = fmpy.simulate_fmu(
            folder,
            start_time=0,
            stop_time=len(x) * STEP_S,
            step_size=STEP_S,
            output_interval=STEP_S,
            input=np.array(list(zip(time, x)), dtype=columns),
            output=["force_n", "status"],
            validate=True,
        )
        np.savetxt(output, result["force_n"], fmt="%.17g")
        print("status", int(result["status"][-1]))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
