"""Tests an installed wheel: it computes, and contains its licences and no part under another one."""

from importlib import metadata
from pathlib import Path

import dashpot

indices = dashpot.Damper("in-service").indices(amplitude_m=0.01, frequency_hz=1.0)
assert indices["max_extension_force_n"] > 1000.0, indices

# The pages of sheets contain uPlot.
about = metadata.metadata("dashpot")
assert about["License-Expression"] == "(MIT OR Apache-2.0) AND MIT", about
top = Path(__file__).parents[2]
licences = {
    "LICENSE-APACHE": "LICENSE-APACHE",
    "LICENSE-MIT": "LICENSE-MIT",
    "LICENSE-UPLOT": "report/src/page/uplot/LICENSE",
}
for licence, source in licences.items():
    assert licence in about.get_all("License-File"), about
    [packaged] = [file for file in metadata.files("dashpot") if file.name == licence]
    assert packaged.read_text() == (top / source).read_text(), licence

# Licences of other third-party texts are kept with those texts, which are not in the package.
library = Path(dashpot._dashpot.__file__).read_bytes()
assert b"Modelica Association" not in library
