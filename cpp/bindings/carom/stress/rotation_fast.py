# SPDX-License-Identifier: Apache-2.0
"""Spin too fast, too slow or too thin for the step."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from carom import METHODS, integrate_free
from carom.stress.case import Group, largest
from carom.stress.motion import AT_REST, about, angle, lone_body, spin_energy, top

cases = Group("rotation")
# 2 pi to 60 digits (mpmath: mp.dps = 60; 2 * mp.pi)
TWO_PI = Fraction("6.28318530717958647692528676655900576839433879875021164194989")


def remainder_of_turns(radians: Fraction) -> float:
    """An exact angle less its whole turns, rad in [0, 2 pi)."""
    return float(radians - (radians // TWO_PI) * TWO_PI)


@cases.case(
    "159 155 turns in a second: 2653 per step, of which all but the last fraction must go",
    "angle to the exact one after 1 s, a ball at 1e6 rad/s, dt 1/60",
    1e-8,
    "rad",
    note="asked was 1e-9 rad per turn, 1.6e-4; 60 steps whose 16667 rad round to 2e-12 each, and a "
    "direction good to u turned 1e6 rad, give 2e-10",
)
def ball_at_a_million_radians(method: str = "symmetric_top") -> float:
    simulation = lone_body((1, 1, 1), (0, 0, 1e6), 1 / 60, method)
    simulation.advance(1.0)
    expected = about([0, 0, 1], remainder_of_turns(Fraction(10**6)))
    return angle(simulation.poses()[0, 3:], expected)


@cases.case(
    "a needle, moments 1 : 1e-8, end over end at 1e4 rad/s: 167 rad per step",
    "worst relative energy error in 60 steps of 1/60 s",
    1e-2,
    "1",
)
def needle_end_over_end(method: str = "symmetric_top") -> float:
    moments, w = (1.0, 1 + 5e-9, 1e-8), np.array([1e4, 3e3, 50.0])
    simulation = lone_body(moments, w, 1 / 60, method)
    start, worst = spin_energy(moments, AT_REST, w), 0.0
    for _ in range(60):
        simulation.step()
        now = spin_energy(moments, simulation.poses()[0, 3:], simulation.twists()[0, 3:])
        worst = largest(worst, abs(now / start - 1))
    return worst


@cases.case(
    "too fast for any affordable number of sub-steps: this must be said, not hidden",
    "steps of 10 at 1e6 rad/s whose cap is not in the report",
    0,
    "steps",
)
def a_capped_spin_is_reported(spin: float = 1e6) -> float:
    simulation = lone_body((1, 2, 2.5), (spin, spin, spin), 1 / 60)
    return 10 - simulation.advance(10 / 60).rotation.capped


@cases.case(
    "moments 1 : 2 : 2.5 at 300 rad/s, 5 rad per step: sub-steps must come by themselves",
    "worst relative energy error in 600 steps of 1/60 s",
    2e-3,
    "1",
    note="what the library says of its sub-steps (tolerance::rotation_energy)",
)
def fast_tumble_gets_substeps(method: str = "symmetric_top") -> float:
    moments, w = (1, 2, 2.5), np.array([300.0, 200, 100])
    simulation = lone_body(moments, w, 1 / 60, method)
    start, worst = spin_energy(moments, AT_REST, w), 0.0
    for _ in range(600):
        simulation.step()
        now = spin_energy(moments, simulation.poses()[0, 3:], simulation.twists()[0, 3:])
        worst = largest(worst, abs(now / start - 1))
    return worst


@cases.case(
    "no spin, denormal spin, spin whose square underflows: 0/0 in every formula of an axis",
    "methods and spins (12 x 4) whose orientation is not kept, or not finite",
    0,
    "cases",
    note="1e-300 rad/s for 1 s turns by less than any bit of q holds",
)
def vanishing_spin() -> float:
    wrong = 0
    for method in METHODS:
        for spin in (0.0, 5e-324, 1e-300, 1e-170):
            q, w = integrate_free(top((1, 2, 2.5)), AT_REST, [spin, spin, -spin], 1.0, 60, method)
            # what is left after q's largest component: at most the true turn of 1e-170 rad
            kept = abs(q[3]) == 1 and np.abs(q[:3]).max() <= 2 * spin
            wrong += not (kept and np.isfinite(w).all())
    return wrong


@cases.case(
    "the lecture's square-root step is real only up to |dt w| = 2",
    "spins of 1.9, 2, 2.1, 3.3 rad/step that end non-finite, or beyond 2 without a flag",
    0,
    "cases",
)
def square_root_step_says_it_is_clamped() -> float:
    wrong = 0
    for turn in (1.9, 2.0, 2.1, 3.3):
        flight = integrate_free(
            top((1, 1, 1)), AT_REST, [0, 0, turn], 10.0, 10, "lecture_quaternion_sqrt"
        )
        wrong += not np.isfinite(flight.orientation).all()
        wrong += (flight.status == "clamped") != (turn > 2)
    return wrong


@cases.case(
    "a symmetric top is solved exactly, so even 3 rad per step must show no error",
    "angle to the closed form after 100 steps of 1 s, moments 2 2 1",
    1e-12,
    "rad",
    note="300 rad of turn in 100 steps of about 16 u",
)
def symmetric_top_at_any_step(method: str = "symmetric_top") -> float:
    moments, w, seconds = (2.0, 2.0, 1.0), np.array([0.5, 0.3, 3.0]), 100.0
    momentum = np.array(moments) * w
    size = float(np.linalg.norm(momentum))
    # precession about L at |L| / I1, then spin about the body's z at w3 (1 - I3 / I1)
    precession = about(momentum / size, math.fmod(size / moments[0] * seconds, 4 * math.pi))
    spin = about([0, 0, 1], math.fmod(w[2] * (1 - moments[2] / moments[0]) * seconds, 4 * math.pi))
    x, y, z, s = precession
    a, b, c, d = spin
    expected = [
        s * a + x * d + y * c - z * b,
        s * b - x * c + y * d + z * a,
        s * c + x * b - y * a + z * d,
        s * d - x * a - y * b - z * c,
    ]
    q, _ = integrate_free(top(moments), AT_REST, w, seconds, 100, method)
    return angle(q, expected)
