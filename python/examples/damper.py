# A damper in Python: its parameters, its forces under a motion, and its bench test. Editors that support `# %%` can run
# each cell separately.

# %% A shipped preset with a clearance of 1 mm
import numpy

import dashpot

damper = dashpot.Damper("in-service", {"mount.clearance_m": 1e-3})
assert damper["mount.clearance_m"] == 1e-3

# %% Two seconds of a 5 mm sine at 1 Hz, in single precision as on the target
built = damper.build(step_s=1e-3, dtype=numpy.float32)
time_s = numpy.arange(2000) * built.step_s
x = (5e-3 * numpy.sin(2 * numpy.pi * time_s)).astype(numpy.float32)
force_n = built.replay(x)
print(f"largest force {force_n.max():.0f} N in extension, {-force_n.min():.0f} N in compression")
assert force_n.max() <= built.force_limit_n

# %% Tick by tick, as a controller does: the same bits
state = built.at_rest(x[0])
assert all(built.step(state, one) == force for one, force in zip(x, force_n))
assert state.status == dashpot.Status(0)

# %% A damper with a closed-form answer: a spring K in series with a damper C
known = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0.0})
indices = known.indices(amplitude_m=1e-3, frequency_hz=1.0)
c, k, w = known["reduced.damping_n_s_per_m"], known["mount.stiffness_n_per_m"], 2 * numpy.pi
expected_n = c * w * 1e-3 / numpy.hypot(1, w * c / k)
print(f"bench test {indices['max_extension_force_n']:.2f} N, closed form {expected_n:.2f} N")
assert abs(indices["max_extension_force_n"] / expected_n - 1) < 1e-4

# %% Eight dampers with increasing clearance in one call
clearances_m = numpy.linspace(0, 3.5e-3, 8)
bank = dashpot.Bank([built.with_clearance_m(clearance_m) for clearance_m in clearances_m])
forces_n = bank.replay(numpy.repeat(x[:, None], len(bank), axis=1))
energy_j = numpy.sum(forces_n[1000:] * numpy.gradient(x[1000:])[:, None], axis=0)
print("energy per cycle, J:", ", ".join(f"{energy:.1f}" for energy in energy_j))
assert (numpy.diff(energy_j) < 0).all()
