"""Kalman filters over the linear vehicle, one for each hypothesis of the damping."""

import numpy as np
from estimator import RATE_HZ, Array, Vehicle, motion
from numpy.fft import irfft


def bank(a: Array, v: Vehicle, base: Array, grades: list[tuple[float, float]]) -> Array:
    """Squared innovations of Kalman filters over the linear vehicle, one for each grade of damping front and rear.

    Inputs are the motions of the bogies, outputs both accelerations of the body, as in `motion`.
    """
    n, m, t = len(a), motion(a, v), 1 / RATE_HZ
    low = 1 / (1 + (m["w"] / (2 * np.pi * 6)) ** 4)
    bogies = [m[k] * low for k in ("bogie_front", "bogie_rear", "frame_front", "frame_rear")]
    inputs = irfft([*bogies, *(1j * m["w"] * x for x in bogies), m["known"] * low, m["lean"] * low], n).T
    outputs = irfft([m["side"] * low, m["turn"] * low], n).T
    # Rates of y, turn, y', turn' and two yaw dampers from themselves and the inputs; turn is pivot times yaw.
    f = np.zeros((len(grades), 6, 16))
    f[:, 0, 2] = f[:, 1, 3] = f[:, 2, 14] = f[:, 3, 15] = 1
    inertia = v.yaw_inertia / v.mass / v.pivot**2
    for h, grade in enumerate(grades):
        for end, sign in enumerate((1, -1)):
            stiffness, damping = v.spring * base[end], v.law[0] * base[2 + 2 * end:4 + 2 * end].sum() * grade[end]
            for column, value in ((0, stiffness), (1, sign * stiffness), (2, damping), (3, sign * damping),
                                  (6 + end, -stiffness), (10 + end, -damping)):
                f[h, 2, column] -= value / v.mass
                f[h, 3, column] -= sign * value / v.mass
            twist = v.yaw_law[2] * v.yaw_arm**2 * v.yaw_dampers * base[6 + end] / v.pivot
            f[h, 3, 4 + end] = -1 / v.mass
            f[h, 4 + end, [3, 4 + end, 12 + end]] = twist / v.pivot, -v.yaw_law[2] / v.yaw_law[0], -twist
    c = f[:, 2:4].copy()
    c[:, :, 14:] = 0
    f[:, 3] /= inertia
    square = np.concatenate([f * t, np.zeros((len(grades), 10, 16))], 1)
    step = term = np.broadcast_to(np.eye(16), square.shape)
    for k in range(1, 12):
        term = term @ square / k
        step = step + term
    a_d, b_d, c_x, c_u = step[:, :6, :6], step[:, :6, 6:], c[:, :, :6], c[:, :, 6:]
    q, r = np.diag([4e-4, 4e-4 * inertia**2]), np.diag([1e-4, 1e-4 * inertia**2])
    g = np.zeros((6, 2))
    g[2, 0], g[3, 1] = t, t / inertia
    p = np.broadcast_to(1e-4 * np.eye(6), a_d.shape)
    for _ in range(3000):
        spread = c_x @ p @ c_x.transpose(0, 2, 1) + q + r
        gain = (a_d @ p @ c_x.transpose(0, 2, 1) + g @ q) @ np.linalg.inv(spread)
        p = a_d @ p @ a_d.transpose(0, 2, 1) + g @ q @ g.T - gain @ spread @ gain.transpose(0, 2, 1)
    x, cost, weight = np.zeros((len(grades), 6, 1)), np.zeros(len(grades)), np.diag([1, 1 / inertia])
    middle = (inputs + np.roll(inputs, -1, 0))[:, :, None] / 2
    for i in range(n - 200):
        miss = outputs[i][:, None] - c_x @ x - c_u @ inputs[i][:, None]
        x = a_d @ x + b_d @ middle[i] + gain @ miss
        if i >= 500:
            cost += ((weight @ miss) ** 2).sum((1, 2))
    return cost
