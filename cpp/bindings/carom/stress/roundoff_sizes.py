# SPDX-License-Identifier: Apache-2.0
"""Far from the origin, tiny, huge and many: where doubles run out of digits."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from carom import Box, Plane, Scene, Simulation, Sphere, UniformGravity
from carom.stress.case import Group, largest
from carom.stress.grounds import world

cases = Group("roundoff")


def _box_slides(shift: float) -> np.ndarray:
    """Where a pushed box comes to rest, seen from where it was put."""
    scene = Scene()
    scene.effects.append(UniformGravity([0, 0, -9.81]))
    offset = np.array([shift, -shift, shift])
    scene.add(Box([16, 16, 1]), static=True, position=offset - [0, 0, 0.5])
    scene.add(Box([0.5] * 3), position=offset + np.array([0, 0, 0.25]), velocity=[1.5, 0.5, 0])
    simulation = Simulation(scene)
    simulation.advance(1.0)
    return simulation.centres()[1] - offset


@cases.case(
    "the same sliding box 1000 km from the origin, where a step of the grid of doubles is 1e-10 m",
    "distance between the two places of rest",
    1e-6,
    "m",
)
def slide_a_thousand_kilometres_away(shift: float = 2.0**20) -> float:
    return float(np.linalg.norm(_box_slides(shift) - _box_slides(0.0)))


@cases.case(
    "the same 100 000 km from the origin, where doubles lie 1.5e-8 m apart",
    "distance between the two places of rest",
    1e-4,
    "m",
    note="100 times the limit of 1000 km away, as the grid of doubles is 100 times coarser",
)
def slide_a_hundred_thousand_kilometres_away() -> float:
    return slide_a_thousand_kilometres_away(2.0**27)


@cases.case(
    "a tower 1000 km from the origin: its gaps are a hundred steps of the grid of doubles",
    "largest drift of ten boxes in 5 s",
    1e-3,
    "m",
)
def tower_a_thousand_kilometres_away() -> float:
    scene, shift = Scene(), np.array([2.0**20, -(2.0**20), 2.0**20])
    scene.effects.append(UniformGravity([0, 0, -9.81]))
    scene.add(Box([4, 4, 1]), static=True, position=shift - [0, 0, 0.5])
    for i in range(10):
        scene.add(Box([1, 1, 1]), position=shift + np.array([0, 0, 0.5 + i]))
    simulation = Simulation(scene)
    start = np.array(simulation.centres())
    simulation.advance(5.0)
    return float(np.linalg.norm(simulation.centres() - start, axis=1).max())


@cases.case(
    "velocities that are denormal numbers: products underflow, and some processors crawl",
    "distance moved in 1 s by bodies at 1e-310 m/s and rad/s, in free flight and on the ground",
    1e-12,
    "m",
)
def denormal_velocities() -> float:
    tiny, worst = 1e-310, 0.0
    for ground in (False, True):
        scene = world() if ground else Scene()
        scene.add(
            Box([1, 1, 1]), name="box", position=[0, 0, 0.5], velocity=[tiny, -tiny, 0],
            angular_velocity=[tiny, 0, -tiny],
        )  # fmt: skip
        simulation = Simulation(scene)
        start = np.array(simulation.centres()[-1])
        simulation.advance(1.0)
        if not np.isfinite(simulation.poses()).all():
            return math.inf
        # at rest on the ground a box may sink by the solver's own residual, nothing more
        worst = largest(worst, float(np.linalg.norm((simulation.centres()[-1] - start)[:2])))
    return worst


@cases.case(
    "speeds from 1e100 to 1e308 m/s: squares overflow, and one NaN would spread to every body",
    "of 5 scenes, those where the bystander is not exact or a lost body is not reported",
    0,
    "scenes",
)
def overflow_is_contained() -> float:
    wrong = 0
    for speed in (1e100, 1e154, 1e200, 1e300, 1e308):
        scene = Scene()
        dart = scene.add(Sphere(1.0), velocity=[speed, 0, 0])
        scene.add(Sphere(1.0), position=[0, 100, 0], velocity=[0, 0, 1.0])
        simulation = Simulation(scene, dt=0.25)
        report = simulation.advance(100.0)
        finite = np.isfinite(simulation.poses()).all() and np.isfinite(simulation.twists()).all()
        moved = abs(simulation.poses()[dart, 0] / (speed * 100) - 1) < 1e-9
        honest = moved or dart in report.frozen
        wrong += not (finite and honest and simulation.poses()[1, 2] == 100.0)
    return wrong


@cases.case(
    "speeds so large that v + dv = v: the push of a contact is lost in rounding",
    "iterations of the contact solver per step at 1e17 m/s on a floor; inf if not finite",
    1000,
    "iterations",
    note="the lecture's loop runs until the velocity changes, for ever here; a solver's own caps, "
    "a few hundred, must end it",
)
def push_lost_in_rounding() -> float:
    scene = Scene()
    scene.add(Plane([0, 0, 1], 0), static=True)
    scene.add(Sphere(0.5), position=[0, 0, 0.5], velocity=[1e17, 0, -1e-3])
    scene.add(Box([1, 1, 1]), position=[0, 5, 0.5], velocity=[0, 1e17, -1e-3])
    simulation = Simulation(scene)
    report = simulation.advance(100 / 60)
    finite = np.isfinite(simulation.poses()).all()
    return report.contact.iterations / report.steps if finite else math.inf


@cases.case(
    "the momentum of 4000 bodies that nearly cancels: the order of a plain sum would show",
    "error over the sum of |m v|, against rational arithmetic",
    1e-13,
    "1",
    note="a plain sum of n terms errs by at most n u = 4e-13 and, as a random walk, by 7e-15",
)
def momentum_of_many() -> float:
    rng, scene = np.random.default_rng(61), Scene()
    masses = 10 ** rng.uniform(-3, 3, 4000)
    speeds = rng.normal(size=4000)
    speeds[1::2], masses[1::2] = -speeds[::2] * (1 + 1e-9), masses[::2]
    for i, (mass, speed) in enumerate(zip(masses, speeds, strict=True)):
        scene.add(Sphere(0.1), mass=float(mass), position=[i, 0, 0], velocity=[float(speed), 0, 0])
    found = Simulation(scene).momentum()[0]
    terms = [Fraction(float(m)) * Fraction(float(v)) for m, v in zip(masses, speeds, strict=True)]
    exact, size = sum(terms), sum(abs(t) for t in terms)
    return float(abs(Fraction(float(found)) - exact) / size)


@cases.case(
    "a million tiny steps add up a position: each loses half a bit the same way",
    "error of x after 1e6 steps at 0.1 m/s, over the distance",
    1e-10,
    "1",
    note="1e6 additions of at most u each: 1.1e-10",
)
def a_million_small_additions() -> float:
    scene = Scene()
    scene.add(Sphere(0.1), velocity=[0.1, 0, 0])
    simulation = Simulation(scene, dt=1e-3)
    simulation.advance(1000.0)
    return abs(float(simulation.poses()[0, 0]) / 100 - 1)
