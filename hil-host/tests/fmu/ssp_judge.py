"""Checks an SSP file against the schema of the standard, runs it in FMPy, and writes one signal.

    python3 ssp_judge.py SSP COMPONENT.SIGNAL STOP_S OUTPUT
"""

import sys
import zipfile
from pathlib import Path

import fmpy.ssp
import numpy as np
from fmpy.ssp.simulation import simulate_ssp
from lxml import etree

STEP_S = 1e-3


def main():
    ssp, signal, stop_s, output = sys.argv[1:5]
    schema = next((Path(fmpy.ssp.__file__).parent / "schema").rglob("SystemStructureDescription.xsd"))
    description = zipfile.ZipFile(ssp).read("SystemStructure.ssd")
    etree.XMLSchema(file=str(schema)).assertValid(etree.fromstring(description))
    result = simulate_ssp(ssp, start_time=0, stop_time=float(stop_s), step_size=STEP_S)
    np.savetxt(output, result[signal], fmt="%.17g")


if __name__ == "__main__":
    main()
