"""Couples two FMUs in FMPy, step by step: a vehicle and its one external damper.

    python3 coupled_fmus.py VEHICLE.fmu DAMPER.fmu OUTPUT.csv

The vehicle steps first, and the damper follows its displacement. The damper's force is the vehicle's input in the next step,
so it acts one step after the displacement that caused it. Each row of OUTPUT.csv has every output of the vehicle after a step.
"""

import csv
import shutil
import sys

from fmpy import extract, instantiate_fmu, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Discard, fmi2Terminated


class Part:
    """An instantiated FMU with its variables by name."""

    def __init__(self, path):
        self.folder = extract(path)
        self.description = read_model_description(self.folder)
        self.step_s = float(self.description.defaultExperiment.stepSize)
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.is_2 = self.description.fmiVersion == "2.0"

    def __enter__(self):
        self.fmu = instantiate_fmu(self.folder, self.description, fmi_type="CoSimulation")
        if self.is_2:
            self.fmu.setupExperiment(startTime=0)
            self.get_reals, self.set_reals = self.fmu.getReal, self.fmu.setReal
        else:
            self.get_reals, self.set_reals = self.fmu.getFloat64, self.fmu.setFloat64
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        return self

    def __exit__(self, *_):
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)

    def names(self, causality):
        return [name for name, v in self.variables.items() if v.causality == causality and v.type in ("Real", "Float64")]

    def get(self, names):
        return self.get_reals([self.variables[name].valueReference for name in names])

    def set(self, name, value):
        self.set_reals([self.variables[name].valueReference], [value])

    def step(self, number):
        """Performs the step with this number, counted from 0. Returns False if the run ended with it."""
        try:
            result = self.fmu.doStep(number * self.step_s, self.step_s)
        except FMICallException as error:
            if error.status == fmi2Discard and self.is_2 and self.fmu.getBooleanStatus(fmi2Terminated):
                return False
            raise
        return self.is_2 or not result[1]


def main():
    with Part(sys.argv[1]) as vehicle, Part(sys.argv[2]) as damper:
        if vehicle.step_s != damper.step_s:
            sys.exit(f"the vehicle steps {vehicle.step_s} s, the damper {damper.step_s} s: export it with --step-us")
        # Other inputs are speed, friction, and forces on bodies.
        displacement_of = {name: name.removesuffix("_force_n") + "_displacement_m" for name in vehicle.names("input")}
        outside = [name for name, displacement in displacement_of.items() if displacement in vehicle.variables]
        if len(outside) != 1:
            sys.exit(f"this script couples one external damper, but the vehicle has {len(outside)}")
        force, displacement = outside[0], displacement_of[outside[0]]
        outputs = [*vehicle.names("output"), force]
        steps = round(float(vehicle.description.defaultExperiment.stopTime) / vehicle.step_s)
        with open(sys.argv[3], "w", newline="") as file:
            rows = csv.writer(file)
            rows.writerow(outputs)
            for step in range(steps):
                goes_on = vehicle.step(step)
                rows.writerow(map(repr, vehicle.get(outputs)))
                if not goes_on:
                    print(f"the vehicle ended after {step + 1} steps")
                    break
                damper.set("displacement_m", *vehicle.get([displacement]))
                damper.step(step)
                vehicle.set(force, *damper.get(["force_n"]))


if __name__ == "__main__":
    main()
