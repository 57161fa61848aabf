# SPDX-License-Identifier: Apache-2.0
"""Friction at its bound on a slope, in closed form: sticking, sliding, rolling, tipping."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, Plane, Scene, Simulation, Sphere, UniformGravity
from carom.stress.case import Group, largest
from carom.stress.grounds import G

cases = Group("contact")


def slope(angle: float, friction: float) -> Scene:
    """A plane under gravity that leans, as seen by somebody on it: x points downhill."""
    scene = Scene()
    scene.effects.append(UniformGravity([G * math.sin(angle), 0, -G * math.cos(angle)]))
    scene.add(Plane([0, 0, 1], 0), static=True, friction=friction)
    return scene


ANGLE = math.radians(30)


def _brick_on_slope(excess: float, seconds: float) -> Simulation:
    """A flat brick on 30 degrees with mu = tan(30) (1 + excess)."""
    friction = math.tan(ANGLE) * (1 + excess)
    scene = slope(ANGLE, friction)
    scene.add(Box([1, 1, 0.2]), position=[0, 0, 0.1], friction=friction)
    simulation = Simulation(scene)
    simulation.advance(seconds)
    return simulation


@cases.case(
    "friction a millionth above what holds a brick on a slope of 30 degrees: it must not creep",
    "creep in 10 s, over the time",
    1e-9,
    "m/s",
)
def brick_sticks_by_a_millionth(excess: float = 1e-6) -> float:
    simulation = _brick_on_slope(excess, 1.0)
    start = np.array(simulation.centres()[1])
    simulation.advance(10.0)
    return float(np.linalg.norm(simulation.centres()[1] - start)) / 10


@cases.case(
    "friction a millionth below: it must slide, and at g (sin - mu cos) = 5e-6 m/s^2",
    "relative error of the speed after 10 s",
    1e-2,
    "1",
    note="the net force is 1e-6 of those it is the difference of: 1e-8 of them is asked for",
)
def brick_slides_by_a_millionth(excess: float = -1e-6) -> float:
    v = _brick_on_slope(excess, 10.0).twists()[1, 0]
    return abs(v / (G * math.sin(ANGLE) * 1e-6 * 10) - 1)


@cases.case(
    "a ball on a slope rolls while mu >= (2/7) tan, with (5/7) g sin; less and it slides as well",
    "largest relative error of the acceleration, mu at 1.01, 0.99 and 0.5 of the bound",
    1e-3,
    "1",
)
def ball_rolls_or_slides() -> float:
    worst = 0.0
    for factor in (1.01, 0.99, 0.5):
        friction = 2 / 7 * math.tan(ANGLE) * factor
        scene = slope(ANGLE, friction)
        scene.add(Sphere(0.1), position=[0, 0, 0.1], friction=friction)
        simulation = Simulation(scene)
        simulation.advance(0.5)
        v = simulation.twists()[1, 0]
        simulation.advance(1.0)
        found = simulation.twists()[1, 0] - v
        exact = 5 / 7 * math.sin(ANGLE) if factor > 1 else math.sin(ANGLE) * (1 - 2 / 7 * factor)
        worst = largest(worst, abs(found / (G * exact) - 1))
    return worst


@cases.case(
    "a brick on a slope tips before it slides where it is narrower than mu times its height",
    "of widths 2 % on either side of the bound, wrong outcomes",
    0,
    "outcomes",
)
def brick_tips() -> float:
    wrong = 0
    for factor in (0.98, 1.02):  # width over height times tan: below 1 it tips
        width = math.tan(ANGLE) * factor
        scene = slope(ANGLE, 2.0)
        scene.add(Box([width, 0.5, 1.0]), position=[0, 0, 0.5], friction=2.0)
        simulation = Simulation(scene, dt=1 / 240)
        simulation.advance(3.0)
        tipped = simulation.centres()[1][2] < 0.45
        wrong += tipped != (factor < 1)
    return wrong
