# SPDX-License-Identifier: Apache-2.0
"""Spin over long times: what must not drift, and symmetries that must hold."""

from __future__ import annotations

import itertools
import math

import numpy as np

from carom import METHODS, integrate_free
from carom.stress.case import Group, largest
from carom.stress.motion import (
    AT_REST,
    U,
    about,
    angle,
    matrix,
    product,
    top,
    watch,
)

cases = Group("rotation")
TILTED = product(about([1, 0, 0], 0.7), about([0, 0.6, 0.8], 1.9))
TOP = (1.0, 2.0, 3.0)
NEAR_MIDDLE = (1e-6, 2.0, -1e-6)


@cases.case(
    "a hair off the unstable axis: it flips for ever, and energy drift would end the flipping",
    "worst relative energy error in 1e6 steps of 0.1 rad",
    2e-4,
    "1",
    has_long=True,
)
def flips_keep_energy(method: str = "symmetric_top", scale: int = 1) -> float:
    return watch(TOP, NEAR_MIDDLE, 0.05, 1_000_000 * scale, 1000 * scale, method)[0]


@cases.case(
    "the same million steps; momentum rebuilt from body axes walks away",
    "worst relative error of the momentum vector in 1e6 steps",
    1e-12,
    "1",
    has_long=True,
)
def flips_keep_momentum(method: str = "symmetric_top", scale: int = 1) -> float:
    return watch(TOP, NEAR_MIDDLE, 0.05, 1_000_000 * scale, 1000 * scale, method)[1]


@cases.case(
    "exactly about the unstable axis: only rounding could tip it over",
    "largest tilt of the middle axis in 10 turns, body axes along the world's",
    1e-13,
    "rad",
)
def balanced_on_middle_axis(method: str = "symmetric_top") -> float:
    q, w = np.array(AT_REST), np.array([0.0, 2.0, 0.0])
    worst = 0.0
    for _ in range(100):
        q, w = integrate_free(top(TOP), q, w, math.pi / 10, 10, method)
        axis = matrix(q)[:, 1]
        worst = largest(worst, math.hypot(axis[0], axis[2]))
    return worst


@cases.case(
    "the same, turned so that no component is zero: rounding itself is a push",
    "largest tilt of the middle axis in 3 turns, body axes askew",
    3e-10,
    "rad",
    note="a tilt grows as exp(w t sqrt((I2-I1)(I3-I2)/(I1 I3))): 5e4 in 3 turns, and 10 roundings "
    "of 1.1e-16 per step of 30 steps start it; after 10 turns (e^36) any double body has flipped",
)
def balanced_askew(method: str = "symmetric_top") -> float:
    q = TILTED
    w = 2 * matrix(q)[:, 1]
    start = matrix(q)[:, 1]
    worst = 0.0
    for _ in range(30):
        q, w = integrate_free(top(TOP), q, w, math.pi / 10, 10, method)
        worst = largest(worst, float(np.linalg.norm(np.cross(matrix(q)[:, 1], start))))
    return worst


def _relabelled() -> list[np.ndarray]:
    """The proper rotations that permute the axes: one for each of the six orders."""
    found = []
    for order in itertools.permutations(range(3)):
        p = np.zeros((3, 3))
        p[range(3), order] = 1
        found.append(p * np.linalg.det(p))
    return found


def _as_quaternion(r: np.ndarray) -> np.ndarray:
    """Of a rotation matrix, by the eigenvector of its quaternion form (no branch)."""
    k = np.array(
        [
            [r[0, 0] - r[1, 1] - r[2, 2], 0, 0, 0],
            [r[1, 0] + r[0, 1], r[1, 1] - r[0, 0] - r[2, 2], 0, 0],
            [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], r[2, 2] - r[0, 0] - r[1, 1], 0],
            [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)],
        ]
    )
    return np.linalg.eigh(k)[1][:, -1]


def naming_error(method: str) -> float:
    """rad between flights of one body whose axes are named in each of the six orders."""
    w, ends = np.array([1.0, 0.7, -0.4]), []
    for p in _relabelled():
        back = _as_quaternion(p.T)  # new body axes to the old ones
        moments = np.abs(p) @ np.array(TOP)
        q, _ = integrate_free(top(moments), product(TILTED, back), w, 10.0, 1000, method)
        ends.append(product(q, [-back[0], -back[1], -back[2], back[3]]))
    return largest(angle(ends[0], q) for q in ends)


@cases.case(
    "the same body with its axes named otherwise must move the same (Gram-Schmidt does not)",
    "worst angle between the 6 namings after 10 s, every method but Gram-Schmidt",
    1e-12,
    "rad",
)
def axis_names_do_not_matter(methods: tuple[str, ...] = METHODS) -> float:
    return largest(naming_error(m) for m in methods if m != "lecture_gram_schmidt")


@cases.case(
    "only a time-symmetric update comes back the way it went",
    "angle to the start after 1000 steps forth and 1000 back",
    1e-10,
    "rad",
)
def flight_is_reversible(method: str = "symmetric_top") -> float:
    q, w = integrate_free(top(TOP), TILTED, [1.0, 0.7, -0.4], 50.0, 1000, method)
    q, _ = integrate_free(top(TOP), q, -w, 50.0, 1000, method)
    return angle(TILTED, q)


@cases.case(
    "q and -q are one orientation: a sign test somewhere would tell them apart",
    "methods whose flights from q and from -q differ in any bit",
    0,
    "methods",
)
def sign_of_q_does_not_matter() -> float:
    wrong = 0
    for method in METHODS:
        ends = [
            integrate_free(top(TOP), sign * TILTED, [1.0, 0.7, -0.4], 3.0, 100, method)
            for sign in (1.0, -1.0)
        ]
        same = any(np.array_equal(ends[0][0], sign * ends[1][0]) for sign in (1, -1))
        wrong += not (same and np.array_equal(ends[0][1], ends[1][1]))
    return wrong


@cases.case(
    "ten million products of rotations: the length of q walks, a matrix shears",
    "| |q| - 1 | after 2e6 steps (2e7 with --long)",
    8e-15,
    "1",
    has_long=True,
    note="8 x 1e-15, the common rule of all cases",
)
def length_of_q_stays_one(method: str = "symmetric_top", scale: int = 1) -> float:
    q, w, worst = TILTED, np.array([1.0, 0.7, -0.4]), 0.0
    for _ in range(20):
        q, w = integrate_free(top(TOP), q, w, 5e3 * scale, 100_000 * scale, method)
        worst = largest(worst, abs(float(np.linalg.norm(q)) - 1))
    return worst


@cases.case(
    "a flat plate sits on the edge of what a tensor may be; the last bit must not pick a branch",
    "angle between I3 = 2 and I3 = 2 + 9e-16 after 1000 steps",
    1e-11,
    "rad",
    note="50 rad of turn times a change of 4e-16 in I3, with 1000 steps of rounding of 16 u",
)
def flat_plate_has_no_edge(method: str = "symmetric_top") -> float:
    ends = [
        integrate_free(top((1, 1, third)), TILTED, [1.0, 0.7, -0.4], 30.0, 1000, method)[0]
        for third in (2.0, 2.0 + 2 * 4 * U)
    ]
    return angle(*ends)
