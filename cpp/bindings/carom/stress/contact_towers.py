# SPDX-License-Identifier: Apache-2.0
"""Towers, mass ratios and an hour of rest: bodies that should lie still."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, Mesh, Simulation
from carom.stress.case import Group, largest
from carom.stress.grounds import drift_and_overlap, tower, world
from carom.stress.solids import grid_mesh

cases = Group("contact")


@cases.case(
    "thirty boxes: a sweep over the contacts moves the load up by one box at a time",
    "how far any box of 30 gets from its place in 10 s at 60 Hz",
    1e-3,
    "m",
    has_long=True,
)
def stack_of_30(solver: str = "automatic", scale: int = 1) -> float:
    return largest(drift_and_overlap(tower([1000.0] * 30), 10.0 * scale, contact_solver=solver))


@cases.case(
    "a box of a million kilograms on ten of one: sequential sweeps would need 6e7",
    "drift or overlap in 10 s at 60 Hz, the worse",
    1e-3,
    "m",
)
def heavy_on_light(solver: str = "automatic") -> float:
    return largest(drift_and_overlap(tower([1.0] * 10 + [1e6]), 10.0, contact_solver=solver))


@cases.case(
    "the other order: light on heavy must not be shaken by the heavy one's rounding",
    "drift or overlap in 10 s at 60 Hz, the worse",
    1e-3,
    "m",
)
def light_on_heavy(solver: str = "automatic") -> float:
    return largest(drift_and_overlap(tower([1e6] + [1.0] * 10), 10.0, contact_solver=solver))


@cases.case(
    "1000 kg, 1 g, 1000 kg: a nut between two anvils",
    "drift or overlap in 10 s at 60 Hz, the worse",
    1e-3,
    "m",
)
def heavy_light_heavy(solver: str = "automatic") -> float:
    return largest(drift_and_overlap(tower([1e3, 1e-3, 1e3]), 10.0, contact_solver=solver))


@cases.case(
    "ContactBench's press: 1000 kg on two cubes of 1 g side by side, 1 : 1e6, mu 0.9",
    "drift or overlap in 5 s at 1 ms, the worse",
    1e-3,
    "m",
)
def press_on_two_cubes() -> float:
    scene = world(friction=0.95)
    for x in (-0.2, 0.2):
        scene.add(Box([0.1] * 3), mass=1e-3, position=[x, 0, 0.05], friction=0.9)
    scene.add(Box([0.6, 0.2, 0.2]), mass=1e3, position=[0, 0, 0.2], friction=0.9)
    return largest(drift_and_overlap(scene, 5.0, dt=1e-3))


@cases.case(
    "an hour at rest: whatever creeps by rounding has 216 000 steps to get somewhere",
    "drift of a box in 3600 s at 60 Hz (ten hours with --long)",
    1e-6,
    "m",
    has_long=True,
)
def an_hour_of_rest(scale: int = 1) -> float:
    scene = world()
    scene.add(Box([1, 1, 1]), name="box", position=[0, 0, 0.5])
    simulation = Simulation(scene)
    simulation.advance(1.0)
    start = np.array(simulation.centres()[1])
    simulation.advance(3600.0 * scale)
    return float(np.linalg.norm(simulation.centres()[1] - start))


@cases.case(
    "the same rest: a solver that pushes too much pumps energy in",
    "largest rise of kinetic plus potential energy over the settled one, 3000 kg, 60 s",
    1e-6,
    "J",
)
def rest_gains_no_energy() -> float:
    scene = world()
    for i in range(3):
        scene.add(Box([1, 1, 1]), position=[0, 0, 0.5 + i])
    simulation = Simulation(scene)
    simulation.advance(5.0)
    settled = simulation.energy()
    base, worst = settled.kinetic + settled.potential, 0.0
    for _ in range(600):
        simulation.advance(0.1)
        energy = simulation.energy()
        worst = largest(worst, energy.kinetic + energy.potential - base)
    return worst


@cases.case(
    "four equal corners under a cube: two forces are enough, so the split is undetermined",
    "largest difference between the four forces over their mean",
    1e-12,
    "1",
)
def cube_on_four_corners() -> float:
    scene = world()
    scene.add(Box([1, 1, 1]), position=[0, 0, 0.5])
    simulation = Simulation(scene)
    simulation.advance(2.0)
    impulses = simulation.contacts()["impulse"]
    if len(impulses) != 4:
        return math.inf
    pushes = np.linalg.norm(impulses.reshape(4, -1), axis=1)
    return float((pushes.max() - pushes.min()) / pushes.mean())


@cases.case(
    "a sheet of no thickness under a stack: both sides of every triangle are outside",
    "how far the lowest of three boxes sinks into it in 5 s",
    1e-3,
    "m",
)
def stack_on_a_sheet() -> float:
    scene = world(ground=False)
    scene.add(Mesh(*grid_mesh(4.0, 3)), static=True)
    for i in range(3):
        scene.add(Box([0.5] * 3), position=[0.1, 0.2, 0.25 + 0.5 * i])
    simulation = Simulation(scene)
    start = np.array(simulation.centres())
    simulation.advance(5.0)
    return float(np.linalg.norm(simulation.centres() - start, axis=1).max())


@cases.case(
    "a plate a micrometre thick dropped flat: all its corners land at once, and it has no depth",
    "largest distance of the plate from the ground after 3 s",
    1e-3,
    "m",
)
def plate_dropped_flat() -> float:
    scene = world()
    scene.add(Box([0.5, 0.5, 1e-6]), name="plate", position=[0, 0, 0.3])
    simulation = Simulation(scene)
    simulation.advance(3.0)
    if not np.isfinite(simulation.poses()).all():
        return math.inf
    return abs(float(simulation.centres()[1][2]))
