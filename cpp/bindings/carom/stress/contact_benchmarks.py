# SPDX-License-Identifier: Apache-2.0
"""SimBenchmark's contact scenes (ETH RSL, 2018), held against the best figure it published.

Its rows are of Bullet, DART, MuJoCo, ODE and RaiSim; the limits here are the best of them at the
same step.
"""

from __future__ import annotations

import math

import numpy as np

from carom import Box, Plane, Scene, Simulation, Sphere, UniformGravity
from carom.stress.case import Group
from carom.stress.grounds import G, world

cases = Group("contact")


@cases.case(
    "a slab pushed askew under 25 balls: friction pyramids turn the push, sweeps do not converge",
    "mean square error of the velocities over 4 s at 1 ms, against the closed form",
    5.7e-9,
    "m^2/s^2",
    note="the best published: Bullet 5.7e-9, RaiSim 4.1e-7, MuJoCo 6.9e-3, ODE and DART 3.14",
)
def slab_under_25_balls(dt: float = 1e-3) -> float:
    scene = Scene()
    scene.effects.append(UniformGravity([0, 0, -G]))
    # a pair has the root of both frictions: 0.4 on the ground, 0.8 under the balls
    scene.add(Plane([0, 0, 1], 0), static=True, friction=0.2)
    slab = scene.add(Box([20, 20, 1]), mass=10.0, position=[0, 0, 0.5], friction=0.8)
    for i in range(25):
        place = [2.0 * (i % 5) - 4, 2.0 * (i // 5) - 4, 1.5]
        scene.add(Sphere(0.5), mass=1.0, position=place, friction=0.8)
    push = np.array([0.5, math.sqrt(0.75), 0])
    simulation = Simulation(scene, dt=dt)
    # at the ground, so that the push does not tilt the slab any more than friction does
    simulation.hold_wrench(slab, 150.0 * push, point_b=[0, 0, -0.5])
    rest = 0.4 * (10 + 25) * G
    of_ball = (150 - rest) / 10 / (3.5 + 25 / 10)
    exact = np.array([0.0, (150 - rest - 25 * of_ball) / 10] + [of_ball] * 25)
    errors = []
    for _ in range(400):
        simulation.advance(0.01)
        v = simulation.twists()[:, :3]
        errors.append(np.square(v - simulation.time * exact[:, None] * push)[1:].sum(1).mean())
    return float(np.mean(errors))


@cases.case(
    "49 elastic balls from 5 m for 20 s at a coarse 10 ms: found late, a bounce gains or loses",
    "mean square of the energy error, E0 = 24 kJ",
    186,
    "J^2",
    note="the best published at this step: RaiSim 186, ODE 1.9e4, Bullet and DART 7.4e6",
)
def elastic_balls_at_coarse_steps(dt: float = 1e-2) -> float:
    scene = world(friction=0.0, restitution=1.0)
    for i in range(49):
        scene.add(
            Sphere(0.1), mass=10.0, position=[0.5 * (i % 7), 0.5 * (i // 7), 5.0], friction=0.0,
            restitution=1.0,
        )  # fmt: skip
    simulation = Simulation(scene, dt=dt)
    start, errors = simulation.energy(), []
    for _ in range(round(20 / dt)):
        simulation.step()
        energy = simulation.energy()
        errors.append(energy.kinetic + energy.potential - start.kinetic - start.potential)
    return float(np.mean(np.square(errors)))


def _cube_of_216(height: float, restitution: float) -> Scene:
    scene = world(friction=0.0, restitution=restitution)
    rng = np.random.default_rng(91)
    for i in range(216):
        place = 0.21 * np.array([i % 6, i // 6 % 6, i // 36]) + rng.uniform(-1e-3, 1e-3, 3)
        scene.add(
            Sphere(0.1), mass=10.0, position=place + np.array([0, 0, height]), friction=0.0,
            restitution=restitution,
        )  # fmt: skip
    return scene


@cases.case(
    "216 balls in a cube fall apart: many touch at once and slide off one another",
    "mean over 2 s of the sum over pairs of the overlap squared, at 10 ms",
    0.015,
    "m^2",
    note="the best published at this step: RaiSim 0.015, ODE 0.016, MuJoCo 0.93, Bullet 37",
)
def cube_of_216_overlaps(dt: float = 1e-2) -> float:
    simulation, sums = Simulation(_cube_of_216(0.11, 0.0), dt=dt), []
    upper = np.triu_indices(216, 1)
    for _ in range(round(2 / dt)):
        simulation.step()
        x = simulation.centres()[1:]
        apart = np.linalg.norm(x[:, None] - x[None], axis=2)[upper]
        overlap = np.maximum(0.2 - apart, 0).tolist() + np.maximum(0.1 - x[:, 2], 0).tolist()
        sums.append(float(np.square(overlap).sum()))
    return float(np.mean(sums))


@cases.case(
    "the same cube, elastic, dropped from 1 m: thousands of hits, each with an energy to keep",
    "mean square of the energy error over 2 s at 1 ms, E0 = 35 kJ",
    8.4,
    "J^2",
    note="the best published at this step: RaiSim 8.4, ODE 112, Bullet 4.2e4, DART 3.5e5",
)
def elastic_cube_of_216(dt: float = 1e-3) -> float:
    simulation = Simulation(_cube_of_216(1.101, 1.0), dt=dt)
    start, errors = simulation.energy(), []
    for _ in range(round(2 / dt)):
        simulation.step()
        energy = simulation.energy()
        errors.append(energy.kinetic + energy.potential - start.kinetic - start.potential)
    return float(np.mean(np.square(errors)))
