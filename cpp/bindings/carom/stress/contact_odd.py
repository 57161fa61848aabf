# SPDX-License-Identifier: Apache-2.0
"""Contacts that should not be: deep overlaps, bodies in one place, bodies taken away."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, Scene, Simulation, Sphere
from carom.stress.case import Group, largest
from carom.stress.grounds import tower, world

cases = Group("contact")


@cases.case(
    "a ball spawned half its radius inside the ground: the lecture's -phi/dt would fire it off",
    "fastest upward speed on the way out",
    3.0,
    "m/s",
    note="the library's bound (tolerance::push_speed): the fall of 0.46 m",
)
def deep_overlap_leaves_slowly(depth: float = 0.5) -> float:
    scene = world()
    scene.add(Sphere(1.0), name="ball", position=[0, 0, depth])
    simulation, worst = Simulation(scene), 0.0
    for _ in range(300):
        before = simulation.centres()[1][2]
        simulation.step()
        # by position as well: a push that is no velocity still moves
        worst = largest(
            worst, simulation.twists()[1, 2], (simulation.centres()[1][2] - before) * 60
        )
    out = abs(simulation.centres()[1][2] - 1.0) < 1e-3
    return float(worst) if out else math.inf


@cases.case(
    "the same overlap: pushing out must not become motion that stays",
    "kinetic energy gained by a 1 kg ball once it is out",
    1e-3,
    "J",
)
def deep_overlap_gains_no_speed() -> float:
    scene = Scene()
    scene.add(Box([4, 4, 4]), static=True, position=[0, 0, -2])
    scene.add(Sphere(1.0), mass=1.0, position=[0, 0, 0.5])
    simulation = Simulation(scene)
    simulation.advance(5.0)
    out = simulation.centres()[1][2] > 1.0 - 1e-3
    return simulation.energy().kinetic if out else math.inf


@cases.case(
    "two equal balls in exactly one place: no direction leads apart",
    "wrong outcomes of 3: not finite, still overlapping after 5 s, or faster than 3 m/s",
    0,
    "outcomes",
)
def two_bodies_in_one_place() -> float:
    scene = Scene()
    for _ in range(2):
        scene.add(Sphere(0.5), mass=1.0)
    simulation = Simulation(scene)
    simulation.advance(5.0)
    centres, twists = simulation.centres(), simulation.twists()
    finite = np.isfinite(centres).all() and np.isfinite(twists).all()
    apart = np.linalg.norm(centres[0] - centres[1]) > 1.0 - 1e-3
    return 3 - int(finite) - int(apart) - int(np.abs(twists).max() <= 3.0)


@cases.case(
    "two equal boxes in exactly one place: every face is equally deep",
    "wrong outcomes of 3: not finite, still overlapping after 5 s, or faster than 3 m/s",
    0,
    "outcomes",
)
def two_boxes_in_one_place() -> float:
    scene = Scene()
    for _ in range(2):
        scene.add(Box([1, 1, 1]), mass=1.0)
    simulation = Simulation(scene)
    simulation.advance(5.0)
    centres, twists = simulation.centres(), simulation.twists()
    finite = np.isfinite(centres).all() and np.isfinite(twists).all()
    apart = np.abs(centres[0] - centres[1]).max() > 1.0 - 1e-3
    return 3 - int(finite) - int(apart) - int(np.abs(twists).max() <= 3.0)


@cases.case(
    "the middle of a tower is taken away while it carries the rest",
    "error of the height of each box after it has fallen and come to rest",
    1e-3,
    "m",
)
def body_removed_in_contact() -> float:
    simulation = Simulation(tower([1000.0] * 5))
    simulation.advance(1.0)
    simulation.remove(3)  # the third box: ids count the ground as 0
    simulation.advance(3.0)
    heights = np.sort(simulation.centres()[1:, 2])
    return float(np.abs(heights - (np.arange(4) + 0.5)).max())


@cases.case(
    "a light body squeezed out between a heavy one and the ground by a wedge-shaped gap of 0",
    "energy gained over the start, 1 : 1e6, in 2 s",
    1e-3,
    "J",
)
def pinched_pea() -> float:
    scene = world(friction=0.1)
    scene.add(Box([1, 1, 1]), mass=1e3, position=[0, 0, 0.55], friction=0.1)
    for x, y in ((-0.4, -0.4), (0.4, -0.4), (0, 0.4)):
        scene.add(Sphere(0.025), mass=1e-3, position=[x, y, 0.025], friction=0.1)
    simulation = Simulation(scene, dt=1 / 240)
    start = simulation.energy()
    base, worst = start.kinetic + start.potential, 0.0
    for _ in range(480):
        simulation.step()
        energy = simulation.energy()
        worst = largest(worst, energy.kinetic + energy.potential - base)
    return worst if np.isfinite(simulation.poses()).all() else math.inf


@cases.case(
    "ten boxes dropped at 100 m/s into a corner: deep and many hits in one step",
    "energy gained over the start in 2 s; inf if a pose is not finite",
    1e-6,
    "J",
)
def boxes_shot_into_a_corner() -> float:
    scene = world(friction=0.4)
    scene.add(Box([1, 10, 10]), static=True, position=[-3, 0, 5], friction=0.4)
    scene.add(Box([10, 1, 10]), static=True, position=[0, -3, 5], friction=0.4)
    for i in range(10):
        scene.add(
            Box([0.5] * 3), position=[-1 + 0.6 * (i % 3), -1 + 0.6 * (i // 3), 1 + 0.1 * i],
            velocity=[-60, -60, -50], friction=0.4,
        )  # fmt: skip
    simulation = Simulation(scene)
    start = simulation.energy()
    base, worst = start.kinetic + start.potential, 0.0
    for _ in range(120):
        simulation.step()
        energy = simulation.energy()
        worst = largest(worst, energy.kinetic + energy.potential - base)
    return worst if np.isfinite(simulation.poses()).all() else math.inf
