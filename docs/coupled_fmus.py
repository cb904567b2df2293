"""A vehicle and one of its dampers, each an FMU, step by step in FMPy.

    python3 coupled_fmus.py VEHICLE.fmu DAMPER.fmu OUTPUT.csv

The vehicle steps first, the damper follows its displacement, and its force is the vehicle's input of the next step: the force acts one
step after the displacement that it answers. A row of OUTPUT.csv has every output of the vehicle after a step.
"""

import csv
import shutil
import sys

from fmpy import extract, instantiate_fmu, read_model_description


class Part:
    """An FMU that has begun, its numbers by name."""

    def __init__(self, path):
        self.folder = extract(path)
        self.description = read_model_description(self.folder)
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.fmu = instantiate_fmu(self.folder, self.description, fmi_type="CoSimulation")
        if self.description.fmiVersion == "2.0":
            self.fmu.setupExperiment(startTime=0)
            self.get_reals, self.set_reals = self.fmu.getReal, self.fmu.setReal
        else:
            self.get_reals, self.set_reals = self.fmu.getFloat64, self.fmu.setFloat64
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def names(self, causality):
        return [name for name, v in self.variables.items() if v.causality == causality and v.type in ("Real", "Float64")]

    def get(self, names):
        return self.get_reals([self.variables[name].valueReference for name in names])

    def set(self, name, value):
        self.set_reals([self.variables[name].valueReference], [value])

    def end(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder)


def main():
    vehicle, damper = Part(sys.argv[1]), Part(sys.argv[2])
    experiment = vehicle.description.defaultExperiment
    step_s = float(experiment.stepSize)
    (force,) = vehicle.names("input")
    displacement = force.removesuffix("_force_n") + "_displacement_m"
    outputs = vehicle.names("output")
    with open(sys.argv[3], "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow([*outputs, force])
        for step in range(round(float(experiment.stopTime) / step_s)):
            vehicle.fmu.doStep(step * step_s, step_s)
            damper.set("displacement_m", *vehicle.get([displacement]))
            damper.fmu.doStep(step * step_s, step_s)
            rows.writerow(map(repr, vehicle.get([*outputs, force])))
            vehicle.set(force, *damper.get(["force_n"]))
    vehicle.end()
    damper.end()


if __name__ == "__main__":
    main()
