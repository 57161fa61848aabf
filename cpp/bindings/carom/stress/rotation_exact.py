# SPDX-License-Identifier: Apache-2.0
"""Spin against 60-digit arithmetic, where double-precision methods are near their end."""

from __future__ import annotations

import numpy as np

from carom import MassProperties, Scene, Simulation, Sphere, UniformGravity, integrate_free
from carom.stress.case import Group
from carom.stress.flights import (
    DISK,
    NEAR_SEPARATRIX,
    NEARLY_PROLATE,
    NEEDLE,
    TWO_FLIPS,
    UNSTABLE,
    Flight,
)
from carom.stress.motion import AT_REST, angle, spin_energy, spin_momentum, top

cases = Group("rotation")


def error_of(flight: Flight, method: str, steps: int = 1, tolerance: float | None = None) -> float:
    """rad, of the orientation at the end."""
    body = top(flight.moments)
    q, _ = integrate_free(body, AT_REST, flight.w, flight.seconds, steps, method, tolerance)
    return angle(q, flight.truth)


@cases.case(
    "twice past the unstable axis: 36 000 times the first rounding is left of it",
    "angle to 60-digit arithmetic after 40 s, method exact",
    3e-10,
    "rad",
)
def past_the_unstable_axis(method: str = "exact", steps: int = 1) -> float:
    return error_of(UNSTABLE, method, steps)


@cases.case(
    "two flips from a push of 2^-20 rad/s: modulus of the elliptic functions 1 - 1e-12",
    "angle to 60-digit arithmetic after 60 s, method exact",
    1e-9,
    "rad",
    note="the two moments given as doubles are exact, so only 1e6 = 1/2^-20 amplified roundings "
    "of the start, 1e-16 each, and those of 60 s of phase remain",
)
def flips_from_a_small_push(method: str = "exact", steps: int = 1) -> float:
    return error_of(TWO_FLIPS, method, steps)


@cases.case(
    "nearly on the separatrix: the period goes to infinity, the phase loses its digits",
    "angle to 60-digit arithmetic after 20 s, method exact",
    1e-11,
    "rad",
)
def near_the_separatrix(method: str = "exact", steps: int = 1) -> float:
    return error_of(NEAR_SEPARATRIX, method, steps)


@cases.case(
    "two moments equal up to 2^-30: between the elliptic and the trigonometric branch",
    "angle to 60-digit arithmetic after 20 s, method exact",
    1e-12,
    "rad",
)
def nearly_symmetric(method: str = "exact", steps: int = 1) -> float:
    return error_of(NEARLY_PROLATE, method, steps)


@cases.case(
    "a needle spun about its length, moments 1 : 1024",
    "angle to 60-digit arithmetic after 4 s, method exact",
    1e-11,
    "rad",
)
def spun_needle(method: str = "exact", steps: int = 1) -> float:
    return error_of(NEEDLE, method, steps)


@cases.case(
    "a tolerance asked for is a promise, even where errors grow a millionfold",
    "error over what was asked (1e-8 rad), adaptive Taylor, two flips in 60 s",
    1,
    "of what was asked",
)
def taylor_keeps_its_tolerance(tolerance: float = 1e-8) -> float:
    return error_of(TWO_FLIPS, "taylor", 1, tolerance) / 1e-8


@cases.case(
    "200 rad/s about the axis of an almost round disk: 3.3 rad per step of 1/60 s",
    "angle to 60-digit arithmetic after 1 s in 60 steps, the default method",
    1e-4,
    "rad",
)
def almost_round_disk(method: str = "symmetric_top") -> float:
    return error_of(DISK, method, 60)


BRICK = MassProperties.box([0.1, 0.4, 0.9], mass=10)

BRICK_W = (0.1, 5.0, 0.1)


@cases.case(
    "Gazebo's benchmark, a box thrown turning about its middle axis: its engines lose 1 % of L",
    "relative error of the angular momentum after 10 s at 1 ms",
    1e-13,
    "1",
    note="10 000 steps of rounding: 1e4^(1/2) u is 1e-14",
)
def thrown_box_keeps_momentum(method: str = "symmetric_top") -> float:
    scene = Scene()
    scene.effects.append(UniformGravity([0, 0, -9.8]))
    scene.add(
        Sphere(0.1),
        mass_properties=BRICK,
        velocity=[-2, 2, 8],
        angular_velocity=BRICK_W,
    )
    simulation = Simulation(scene, dt=1e-3, integrator=method)
    simulation.advance(10.0)
    moments = np.diag(BRICK.inertia)
    before = spin_momentum(moments, AT_REST, BRICK_W)
    after = spin_momentum(moments, simulation.poses()[0, 3:], simulation.twists()[0, 3:])
    return float(np.linalg.norm(after - before) / np.linalg.norm(before))


@cases.case(
    "the same throw: its energy is what a first-order update loses",
    "relative error of the rotational energy after 10 s at 1 ms",
    1e-5,
    "1",
    note="a splitting of order 2 at h |w| = 5e-3: 8e-3 (h w)^2 = 2e-7 at any time, never growing; "
    "the moments 0.14 : 0.81 amplify it by at most (I3/I1)^2 = 33",
)
def thrown_box_keeps_energy(method: str = "symmetric_top") -> float:
    moments = np.diag(BRICK.inertia)
    q, w = integrate_free(BRICK, AT_REST, BRICK_W, 10.0, 10_000, method)
    return abs(spin_energy(moments, q, w) / spin_energy(moments, AT_REST, BRICK_W) - 1)
