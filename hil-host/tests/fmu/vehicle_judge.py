"""Checks the FMU of a vehicle with FMPy: problems in its description, a complete run, and rejected calls.

    python3 vehicle_judge.py FMU
"""

import pathlib
import shutil
import sys

import fmpy
import numpy as np
from fmpy.validation import validate_fmu

FORCE = "front_lateral_damper_1_force_n"
VELOCITY = "front_lateral_damper_1_velocity_m_per_s"
DISPLACEMENT = "front_lateral_damper_1_displacement_m"


def main():
    path = sys.argv[1]
    problems = validate_fmu(path)
    if problems:
        sys.exit("\n".join(problems))
    messages = []
    result = fmpy.simulate_fmu(
        path,
        output=["ending", "distance_m", DISPLACEMENT, VELOCITY],
        output_interval=1e-3,
        debug_logging=True,
        logger=lambda *told: messages.append(told[-1].decode()),
    )
    rates = np.diff(result[DISPLACEMENT]) / 1e-3
    assert np.array_equal(rates, result[VELOCITY][1:]), "the rate is not that of the last step"
    coarse = fmpy.simulate_fmu(path, output=["ending"], output_interval=1e-2, early_return_allowed=True)
    assert coarse["time"][-1] == result["time"][-1], "the end within a longer step"
    assert list(result["ending"][:-1]) == [0] * (len(result) - 1)
    print("rows", len(result), "ending", result["ending"][-1], "distance", repr(result["distance_m"][-1]))
    print("ended at", f"{result['time'][-1]:.3f}", "s")
    print(*messages, sep="\n")
    states(path)
    refusals(path)
    print("with a force:", run(path, "9e3"))
    print("no number:", run(path, "nan"))
    print("an output:", run(path, "1", DISPLACEMENT))


def states(path):
    """A state that is read, serialized, deserialized and restored continues with the same bits."""
    folder = fmpy.extract(path)
    description = fmpy.read_model_description(folder)
    references = {v.name: v.valueReference for v in description.modelVariables}
    fmu = fmpy.instantiate_fmu(folder, description, fmi_type="CoSimulation")
    is_3 = description.fmiVersion == "3.0"
    if not is_3:
        fmu.setupExperiment(startTime=0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    outputs = [v.valueReference for v in description.modelVariables if v.causality == "output" and v.name != "ending"]
    get, put = (fmu.getFloat64, fmu.setFloat64) if is_3 else (fmu.getReal, fmu.setReal)

    def steps(begin, end):
        rows = []
        for step in range(begin, end):
            put([references[FORCE]], [1e4 * np.sin(0.1 * step)])
            fmu.doStep(step * 1e-3, 1e-3)
            rows.append(list(get(outputs)))
        return rows

    steps(0, 300)
    got = fmu.getFMUState()
    serialized = fmu.serializeFMUState(got)
    at_300 = list(get(outputs))
    expected = steps(300, 600)
    again = fmu.deserializeFMUState(serialized)
    fmu.setFMUState(again)
    assert list(get(outputs)) == at_300, "outputs of a state that was set"
    assert steps(300, 600) == expected, "steps from a state that was set"
    fmu.setFMUState(got)
    assert steps(300, 600) == expected, "steps from a state that was got"
    fmu.freeFMUState(got)
    fmu.freeFMUState(again)
    fmu.terminate()
    fmu.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)


def refusals(path):
    """With resources of another export no instance is created, and nothing is written there."""
    for name, change in (("case.json", b" "), (".tables", b" "), (".tables", None)):
        folder = fmpy.extract(path)
        resources = pathlib.Path(folder, "resources")
        (file,) = (file for file in resources.iterdir() if file.name.endswith(name))
        if change is None:
            file.unlink()
        else:
            file.write_bytes(file.read_bytes() + change)
        before = sorted(file.name for file in resources.iterdir())
        messages = []
        try:
            fmpy.simulate_fmu(folder, stop_time=0.01, logger=lambda *told: messages.append(told[-1].decode()))
            sys.exit(f"{name} {change}: an instance")
        except Exception:  # FMPy has one exception class per version
            print(name, change, messages[0].rsplit("/", 1)[-1].split(".tables")[-1])
        assert sorted(file.name for file in resources.iterdir()) == before
        shutil.rmtree(folder)


def run(path, value, name=FORCE):
    """Displacement of the body after half a second with a start value, or the message about an error."""
    try:
        result = fmpy.simulate_fmu(
            path, stop_time=0.5, start_values={name: value}, output=["body_lateral_m"], output_interval=1e-3
        )
        return result["body_lateral_m"][-1]
    except Exception as error:  # FMPy has one exception class per version
        return str(error).split(" ", 1)[1]


if __name__ == "__main__":
    main()
