"""Condition of the lateral dampers of a vehicle from accelerations alone: the balance of forces on its body."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.fft import irfft, rfft, rfftfreq

Array = np.ndarray
RATE_HZ, G = 100.0, 9.81
PARAMETERS = 8  # springs front and rear, lateral dampers front 1, 2, rear 1, 2, yaw dampers front and rear
BLOCK_S, MIN_BLOCKS, LIMIT, SIGMAS = 1.0, 12, 0.15, 5.0
FLOORS, APART = np.array([0.02] * 2 + [0.06] * 4), 3.0  # deviations of drifting sensors and changing operation


@dataclass(frozen=True)
class Vehicle:
    """What the estimator knows of a vehicle, in t, m and kN; a law is C, Vr, Ke, 2a."""

    file: str
    mass: float
    yaw_inertia: float
    pivot: float  # distance of a bogie's centre from the middle
    cg_height: float
    plane: float  # height of lateral springs and dampers
    spring: float  # lateral stiffness of the springs of one bogie
    spring_yaw: float
    law: tuple[float, ...]
    offset: float  # lateral dampers ahead of and behind the bogie's centre
    yaw_law: tuple[float, ...]
    yaw_dampers: int
    yaw_arm: float = 1.3
    body_height: float = 1.1  # of the sensors
    bogie_height: float = 0.7


LOCOMOTIVE = Vehicle("locomotive", 63.4, 1718, 5.39, 2.099, 0.684, 852, 815, (90, 0.07, 7000, 0.5e-3), 1.0,
                     (1320, 0.01553, 12000, 0), 4)
COACH = Vehicle("coach", 32, 1970, 9.5, 1.8, 0.8275, 320, 320, (32, 0.3, 6000, 0.5e-3), 0.2,
                (1320, 0.01553, 4000, 0), 2)
PHYSICAL = replace(LOCOMOTIVE, law=(120, 0.167, 3000, 0.5e-3))  # `in-service`, fitted to a run as new
MISFIT = replace(LOCOMOTIVE, law=(120, 0.03, 7000, 0.5e-3))  # a law that `in-service` has not
LINEAR = replace(LOCOMOTIVE, law=(90, 7, 7e4, 0), yaw_law=(1320, 1, 12000, 0))


def force(x: Array, laws: list[tuple[float, ...]]) -> Array:
    """Forces of dampers with saturation, mount and clearance over displacements, by the trapezoidal rule."""
    damping, velocity, stiffness, clearance = np.array(laws, float).T
    highest, half, q = damping * velocity, clearance / 2, 0.5 / (RATE_HZ * damping)
    gain, yielding, out = stiffness / (1 + stiffness * q), 1 / stiffness, np.empty_like(x)
    piston, f = np.zeros_like(x[0]), np.zeros_like(x[0])
    for i, now in enumerate(x):
        stretch = now - piston - q * f
        play = np.minimum(np.maximum(stretch, -half), half)
        f = out[i] = np.minimum(np.maximum(gain * (stretch - play), -highest), highest)
        piston = now - play - f * yielding
    return out


def motion(a: Array, v: Vehicle, low_hz: float = 0.3) -> dict[str, Array]:
    """Spectra of the body's force per mass and of the motion between body and bogies, from readings."""
    n, ramp = len(a), int(2 * RATE_HZ)
    window = np.ones(n)
    window[:ramp] = 0.5 - 0.5 * np.cos(np.pi * np.arange(ramp) / ramp)
    window[-ramp:] = window[:ramp][::-1]
    w = 2 * np.pi * np.maximum(rfftfreq(n, 1 / RATE_HZ), 1e-9)
    high = 1 / (1 + (2 * np.pi * low_hz / w) ** 4)
    s = rfft((a - a.mean(0)) * window[:, None], axis=0).T * high
    twice = -1 / w**2  # integrates twice
    roll, roll_f, roll_r = (twice * x for x in ((s[3] - s[2]) / 2.4, (s[7] - s[6]) / 2, (s[11] - s[10]) / 2))
    yaw, yaw_f, yaw_r = (twice * x for x in ((s[0] - s[1]) / (2 * v.pivot), (s[4] - s[5]) / 5, (s[8] - s[9]) / 5))
    above, frame = v.body_height - v.plane, v.bogie_height - v.plane
    ends = [twice * (s[0] + high * G * roll) - above * roll, twice * (s[1] + high * G * roll) - above * roll]
    bogies = [twice * ((s[i] + s[i + 1]) / 2 + high * G * p) - frame * p for i, p in ((4, roll_f), (8, roll_r))]
    lean = G / 4 * (roll_f + roll_r - 2 * roll), G / 4 * (roll_f - roll_r)  # of the static force of the springs
    side = (s[0] + s[1]) / 2 + (v.cg_height - v.body_height) * roll / twice - lean[0]
    turn = v.yaw_inertia / v.mass / v.pivot * yaw / twice - lean[1]
    side_known, down = lean[0] + G * roll * high, (v.cg_height - v.plane) * roll
    return {"w": w, "known": side_known, "lean": lean[1], "side": side, "turn": turn,
            "bogie_front": bogies[0] + down, "bogie_rear": bogies[1] + down, "frame_front": yaw_f, "frame_rear": yaw_r,
            "front": ends[0] - bogies[0], "rear": ends[1] - bogies[1],
            "yaw_front": yaw - yaw_f, "yaw_rear": yaw - yaw_r}


def equations(a: Array, v: Vehicle, high_hz: float = 6.0) -> tuple[Array, Array]:
    """Both balances of the body, lateral and yaw, kN: left sides (n, 2) and right sides by parameter (n, 2, 8)."""
    n, m = len(a), motion(a, v)
    side, turn, front, rear, yaw_f, yaw_r = (
        irfft(m[k], n) for k in ("side", "turn", "front", "rear", "yaw_front", "yaw_rear"))
    o, none = v.offset, np.zeros(n)
    x = [front + o * yaw_f, front - o * yaw_f, rear + o * yaw_r, rear - o * yaw_r, v.yaw_arm * yaw_f, v.yaw_arm * yaw_r]
    forces = force(np.stack(x, 1), [v.law] * 4 + [v.yaw_law] * 2).T
    d, y = forces[:4], (forces[4:] * v.yaw_arm * v.yaw_dampers + v.spring_yaw * np.stack([yaw_f, yaw_r])) / v.pivot
    k, e = (v.spring * front, v.spring * rear), o / v.pivot
    right = -np.array([[*k, *d, none, none],
                       [k[0], -k[1], (1 + e) * d[0], (1 - e) * d[1], (e - 1) * d[2], -(1 + e) * d[3], *y]])
    both = np.concatenate([v.mass * np.array([side, turn])[:, None], right], 1)
    low = 1 / (1 + (m["w"] / (2 * np.pi * high_hz)) ** 4)
    both = irfft(rfft(both) * low, n)
    return both[:, 0].T, both[:, 1:].transpose(2, 0, 1)


def normal(a: Array, v: Vehicle) -> tuple[Array, Array, Array]:
    """Normal equations and squared left sides of each block of 1 s, without the first 5 s and the last 2 s."""
    left, right = equations(a, v)
    size = int(BLOCK_S * RATE_HZ)
    count = (len(a) - 700) // size
    left, right = (x[500:500 + count * size].reshape(count, size, *x.shape[1:]) for x in (left, right))
    return np.einsum("bnep,bneq->bpq", right, right), np.einsum("bnep,bne->bp", right, left), (left**2).sum((1, 2))


def solve(matrix: Array, vector: Array) -> tuple[Array, Array]:
    """Parameters by least squares, and their covariance from the scatter of the blocks."""
    inverse = np.linalg.inv(matrix.sum(0))
    value = inverse @ vector.sum(0)
    rest, n = vector - matrix @ value, len(vector)
    return value, inverse @ rest.T @ rest @ inverse * n / (n - PARAMETERS)


@dataclass(frozen=True)
class Reading:
    """Relative to the baseline: of both dampers of the bogies, of each damper, and the deviations; springs."""

    pair: Array
    pair_sd: Array
    each: Array
    each_sd: Array
    spring: Array

    def verdict(self) -> str:
        """`front`, `rear` or `both`, with the damper if one alone explains it; nothing if no bogie is worn."""
        worn = [i for i in (0, 1) if self.pair[i] < 1 - max(LIMIT, SIGMAS * self.pair_sd[i])]
        if len(worn) != 1:
            return "both" if worn else ""
        two, sd = self.each[2 * worn[0]:][:2], self.each_sd[2 * worn[0]:][:2]
        apart = abs(two[1] - two[0]) > APART * np.hypot(*sd)
        return ("front", "rear")[worn[0]] + (f" {1 + int(np.argmin(two))}" if apart else "")


def compare(now: tuple[Array, Array], baseline: tuple[Array, Array]) -> Reading:
    """Ratios to the baseline over the median ratio of springs and yaw dampers, which a change of mass changes too."""
    (value, cov), (base, base_cov) = now, baseline
    scale = float(np.median((value / base)[[0, 1, 6, 7]]))
    mean = np.zeros((6, PARAMETERS))
    for i in range(4):
        mean[i // 2, 2 + i] = 0.5
        mean[2 + i, 2 + i] = 1
    reference = mean @ base
    ratio = mean @ value / reference / scale
    variance = np.diag(mean @ (cov / scale**2) @ mean.T) + ratio**2 * np.diag(mean @ base_cov @ mean.T)
    sd = np.sqrt(variance / reference**2 + FLOORS**2)
    return Reading(ratio[:2], sd[:2], ratio[2:], sd[2:], (value / base)[:2] / scale)
