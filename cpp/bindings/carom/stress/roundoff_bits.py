# SPDX-License-Identifier: Apache-2.0
"""Runs that must repeat to the last bit, whatever order or company bodies are in."""

from __future__ import annotations

import numpy as np

from carom import Box, Scene, Simulation, Sphere, UniformGravity
from carom.stress.case import Group
from carom.stress.grounds import tower, world
from carom.stress.motion import lone_body

cases = Group("roundoff")


def _tumbling_pile(shift: float = 0.0, zero: float = 0.0) -> Scene:
    """Six boxes and balls that fall on one another on a floor."""
    scene = Scene()
    scene.effects.append(UniformGravity([zero, zero, -9.81]))
    offset = np.array([shift, -shift, shift])
    scene.add(Box([10, 10, 1]), static=True, position=offset + np.array([zero, zero, -0.5]))
    for i in range(6):
        shape = Box([0.4, 0.5, 0.6]) if i % 2 else Sphere(0.25)
        scene.add(
            shape, mass=1.0 + i,
            position=offset + np.array([0.125 * (i % 3), 0.25 * (i % 2), 0.5 + 0.75 * i]),
            velocity=[zero, zero, zero], angular_velocity=[zero, 1.0, zero],
        )  # fmt: skip
    return scene


@cases.case(
    "a run repeated, and once more from a saved state: any use of an address or a clock shows",
    "of 3 runs of a tumbling pile, those whose 64-bit state differs",
    0,
    "runs",
)
def same_bits_again() -> float:
    hashes = []
    for _ in range(2):
        simulation = Simulation(_tumbling_pile())
        simulation.advance(0.5)
        saved = simulation.save()
        simulation.advance(1.5)
        hashes.append(simulation.state_hash())
    simulation.restore(saved)
    simulation.advance(1.5)
    hashes.append(simulation.state_hash())
    return sum(h != hashes[0] for h in hashes)


@cases.case(
    "-0.0 for 0.0 in positions, velocities and gravity: a sign of zero decides nothing physical",
    "largest difference of any number of the state after 2 s",
    0,
    "m, m/s",
)
def signed_zeros() -> float:
    ends = []
    for zero in (0.0, -0.0):
        simulation = Simulation(_tumbling_pile(zero=zero))
        simulation.advance(2.0)
        ends.append(np.concatenate([simulation.poses().ravel(), simulation.twists().ravel()]))
    return float(np.abs(ends[0] - ends[1]).max())


@cases.case(
    "bodies added in another order: rows differ, physics must not",
    "largest difference of a box's place after 3 s, a tower of 8 built up and built down",
    1e-6,
    "m",
)
def order_of_adding() -> float:
    forth = Simulation(tower([100.0 * (i + 1) for i in range(8)]))
    scene = world()
    for i in reversed(range(8)):
        scene.add(Box([1, 1, 1]), mass=100.0 * (i + 1), position=[0, 0, i + 0.5])
    back = Simulation(scene)
    forth.advance(3.0)
    back.advance(3.0)
    return float(np.abs(forth.centres()[1:] - back.centres()[:0:-1]).max())


@cases.case(
    "a lone body is the same body in a crowd: lanes of a vector must not mix",
    "differences in any bit of 9 equal flights, alone and with 1 to 8 others",
    0,
    "flights",
)
def alone_or_in_lanes() -> float:
    alone = lone_body((1, 2, 2.5), (3, 5, 2), 0.01)
    alone.advance(1.0)
    wrong = 0
    for others in range(1, 9):
        scene = Scene()
        rng = np.random.default_rng(others)
        for i in range(others):
            scene.add(
                Box([0.1, 0.2, 0.3]),
                position=[5.0 * i + 5, 0, 0],
                angular_velocity=rng.normal(size=3),
            )
        template = alone.scene.bodies[0]
        scene.add(Sphere(0.1), mass_properties=template.mass_properties, angular_velocity=[3, 5, 2])
        crowd = Simulation(scene, dt=0.01)
        crowd.advance(1.0)
        wrong += not np.array_equal(crowd.poses()[-1, 3:], alone.poses()[0, 3:])
    return wrong
