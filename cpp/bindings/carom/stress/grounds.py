# SPDX-License-Identifier: Apache-2.0
"""What contact cases share: a ground under gravity, a tower, how far bodies strayed."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, Plane, Scene, Simulation, UniformGravity

G = 9.81


def world(friction: float = 0.5, restitution: float = 0.0, ground: bool = True) -> Scene:
    """Gravity, and a ground at z = 0."""
    scene = Scene()
    scene.effects.append(UniformGravity([0, 0, -G]))
    if ground:
        scene.add(
            Plane([0, 0, 1], 0), name="ground", static=True, friction=friction,
            restitution=restitution,
        )  # fmt: skip
    return scene


def tower(masses, size: float = 1.0) -> Scene:
    """Boxes on one another, the first at the bottom."""
    scene = world()
    for i, mass in enumerate(masses):
        scene.add(Box([size] * 3), mass=mass, position=[0, 0, size * (i + 0.5)])
    return scene


def drift_and_overlap(scene: Scene, seconds: float, dt: float = 1 / 60, **settings):
    """(largest distance of a centre from its start, deepest overlap), m."""
    simulation = Simulation(scene, dt=dt, **settings)
    start = np.array(simulation.centres())
    report = simulation.advance(seconds)
    moved = np.linalg.norm(simulation.centres() - start, axis=1)
    if not np.isfinite(moved).all():
        return math.inf, math.inf
    return float(moved.max()), report.contact.deepest_overlap
