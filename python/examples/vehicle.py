# A locomotive on a track, run from Python. Editors that support `# %%` can run each cell separately.

# %% Two seconds at 180 km/h, with the shipped dampers and with worn vertical dampers
import numpy

import dashpot

names = ["time_s", "body_vertical_acceleration_m_per_s2"]
good = dashpot.vehicle("straight-180", duration_s=2, signals=names)
worn = dashpot.vehicle("straight-180", duration_s=2, signals=names, overrides={"vertical.mount.clearance_m": 5e-3})
assert good.is_completed and worn.is_completed

# %% Vertical acceleration of the body: the index is the root mean square of the history
for name, run in (("good", good), ("worn", worn)):
    acceleration = run.history["body_vertical_acceleration_m_per_s2"]
    rms = numpy.sqrt(numpy.mean(acceleration**2))
    told = run.indices["bodies"][0]["vertical_rms_m_per_s2"]
    print(f"{name}: {rms:.3f} m/s^2 rms")
    assert abs(rms / told - 1) < 1e-9

# %% One row of a study by its number; `pandas.DataFrame(study.run())` contains all rows
study = dashpot.Study.from_toml("""
name = "speed"
observed = ["derailment_greatest"]
[[sweep]]
name = "speed"
case = "straight-180"
duration_s = 1
vary = [{ parameter = "speed_km_h", values = [100, 140, 180] }]
""")
rows = study.run()
print("largest Y/Q:", rows["derailment_greatest"])
assert rows["derailment_greatest"][2] == study.row(2)["derailment_greatest"]
