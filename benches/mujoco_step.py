"""Yardstick of the vehicle's tick: a 1 ms step of MuJoCo with the same number of degrees of freedom.

    python3 -m venv /tmp/mujoco && /tmp/mujoco/bin/pip install mujoco && /tmp/mujoco/bin/python benches/mujoco_step.py

The model has nine bodies with the masses of the six-axle locomotive and six degrees of freedom each. Each of the six
wheelsets rests on six spheres, which touch a plane in 36 points with friction. Springs and dashpots along and about three
axes connect wheelsets, bogies and body. Creep and profiles are not modelled: the contact of a general engine represents
the cost of a scene of this size. In the scene `free` only the plane supports the bodies, which is the minimum cost of 54
degrees of freedom and 36 contacts; the scene `vehicle` adds the springs as joints.
"""

import time

import mujoco

STEP_S = 1e-3
SETTLE = 3000
STEPS = 2000
ROUNDS = 15
GRAVITY_M_PER_S2 = 9.81
AXLES_X_M = [7.54, 5.39, 3.24, -3.24, -5.39, -7.54]
BOGIES_X_M = [5.39, -5.39]
WHEELSET = (3239, (2450, 405, 2450))
BOGIE = (20563, (7370, 73274, 78243))
BODY = (63400, (143500, 1521000, 1718000))
BALLS = "".join(
    f'<geom type="sphere" size="0.1" pos="{x} {y} -0.525" mass="0"/>' for x in (-0.3, 0, 0.3) for y in (-0.75, 0.75)
)


def springs(stiffness, damping, load_n):
    """Three slides and three hinges; the vertical one carries the load from above."""
    joints = ""
    for axis, (k, c) in zip(("1 0 0", "0 1 0", "0 0 1"), zip(stiffness, damping)):
        rest = load_n / k if axis == "0 0 1" else 0
        joints += f'<joint type="slide" axis="{axis}" stiffness="{k}" damping="{c}" springref="{-rest}"/>'
    for axis, k in zip(("1 0 0", "0 1 0", "0 0 1"), stiffness):
        joints += f'<joint type="hinge" axis="{axis}" stiffness="{k}" damping="{k / 50}"/>'
    return joints


def body(place, mass_and_inertia, joints, inside):
    mass, inertia = mass_and_inertia
    x, z = place
    return (
        f'<body pos="{x} 0 {z}">{joints}<inertial pos="0 0 0" mass="{mass}" '
        f'diaginertia="{" ".join(map(str, inertia))}"/>{inside}</body>'
    )


def scene(bodies):
    return f"""<mujoco><compiler balanceinertia="true"/><option timestep="{STEP_S}" integrator="implicitfast"/>
<worldbody><geom type="plane" size="0 0 1"/>{bodies}</worldbody></mujoco>"""


def free():
    """Nine equal bodies on four spheres each."""
    feet = "".join(
        f'<geom type="sphere" size="0.1" pos="{x} {y} -0.525" mass="0"/>' for x in (-0.3, 0.3) for y in (-0.75, 0.75)
    )
    return scene("".join(body((3 * i, 0.625), WHEELSET, "<freejoint/>", feet) for i in range(9)))


def vehicle():
    """A tree: wheelsets attached to bogies attached to the body."""
    bogies = ""
    # The plane carries a wheelset's weight; its spring carries only the parts above it.
    primary_n = -(BODY[0] + 2 * BOGIE[0]) * GRAVITY_M_PER_S2 / 6
    secondary_n = -BODY[0] * GRAVITY_M_PER_S2 / 2
    primary = springs((40e6, 11e6, 4.3e6), (1e5, 1e5, 160e3), primary_n)
    secondary = springs((852e3, 852e3, 3.2e6), (1e5, 1e5, 200e3), secondary_n)
    for number, x in enumerate(BOGIES_X_M):
        axles = AXLES_X_M[3 * number : 3 * number + 3]
        wheelsets = "".join(body((axle - x, -0.14), WHEELSET, primary, BALLS) for axle in axles)
        bogies += body((x, -1.334), BOGIE, secondary, wheelsets)
    return scene(body((0, 2.099), BODY, "<freejoint/>", bogies))


def measure(name, xml):
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, SETTLE)
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        mujoco.mj_step(model, data, STEPS)
        times.append((time.perf_counter() - start) / STEPS * 1e6)
    times.sort()
    # A scene that fell over or flew apart has no meaningful time.
    assert data.ncon == 36 and abs(data.qvel).max() < 0.1, (data.ncon, abs(data.qvel).max())
    print(
        f"{name}: {model.nv} degrees of freedom, {data.ncon} contacts, "
        f"{times[ROUNDS // 2]:.1f} us per step (median of {ROUNDS}, minimum {times[0]:.1f})"
    )


if __name__ == "__main__":
    print(f"MuJoCo {mujoco.__version__}")
    measure("free", free())
    measure("vehicle", vehicle())
