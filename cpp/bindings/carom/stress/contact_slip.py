# SPDX-License-Identifier: Apache-2.0
"""Friction on the level, in closed form: stopping, rolling, cones, wedges, Painleve."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, ConvexHull, Plane, Scene, Simulation, Sphere
from carom.stress.case import Group, largest
from carom.stress.grounds import G, world
from carom.stress.motion import about

cases = Group("contact")


@cases.case(
    "a cube pushed to 1 m/s stops after v^2 / (2 mu g) = 0.1274 m (ContactBench, mu 0.4)",
    "error of the distance at 1 ms",
    1e-5,
    "m",
    note="a step that ends in mid-slide errs by v dt / 2 of its own last speed, mu g dt: 2e-6 m",
)
def cube_slides_to_a_stop(dt: float = 1e-3) -> float:
    scene = world(friction=0.4)
    scene.add(Box([0.2] * 3), mass=1.0, position=[0, 0, 0.1], velocity=[1, 0, 0], friction=0.4)
    simulation = Simulation(scene, dt=dt)
    simulation.advance(1.0)
    return abs(float(simulation.centres()[1][0]) - 1 / (2 * 0.4 * G))


@cases.case(
    "a sliding ball without spin takes up rolling and keeps 5/7 of its speed, whatever mu",
    "largest relative error of the rolling speed, mu 0.05 to 1",
    2e-3,
    "1",
    note="the step in which sliding ends is the only one in error: mu g dt / v at most 1.6e-2 of "
    "which the solver resolves a tenth",
)
def sliding_becomes_rolling() -> float:
    worst = 0.0
    for friction in (0.05, 0.3, 1.0):
        scene = world(friction=friction)
        scene.add(Sphere(0.1), position=[0, 0, 0.1], velocity=[3, 0, 0], friction=friction)
        simulation = Simulation(scene, dt=1 / 240)
        simulation.advance(2 * 3 / (7 * friction * G) + 0.2)
        worst = largest(worst, abs(simulation.twists()[1, 0] / (3 * 5 / 7) - 1))
    return worst


@cases.case(
    "friction is a cone, not a pyramid: a slip at 37 degrees must keep its direction",
    "angle between push and slip, particle-like block under (-1, 0.8) N (Horak-Trinkle)",
    1e-6,
    "rad",
)
def slip_along_the_push() -> float:
    scene = world(friction=0.3)
    block = scene.add(Box([0.2, 0.2, 0.01]), mass=0.2, position=[0, 0, 0.005], friction=0.3)
    simulation = Simulation(scene, dt=0.01)
    simulation.hold_wrench(block, [-1.0, 0.8, 0], point_b=[0, 0, -0.005])
    simulation.advance(1.0)
    v = simulation.twists()[1, :2]
    push = np.array([-1.0, 0.8])
    cross = push[0] * v[1] - push[1] * v[0]
    return abs(math.atan2(cross, float(push @ v)))


@cases.case(
    "the same slip has a closed form: (1.2806 - 0.5886) / 0.2 m/s^2",
    "relative error of its speed after 1 s",
    1e-6,
    "1",
)
def slip_acceleration() -> float:
    scene = world(friction=0.3)
    block = scene.add(Box([0.2, 0.2, 0.01]), mass=0.2, position=[0, 0, 0.005], friction=0.3)
    simulation = Simulation(scene, dt=0.01)
    simulation.hold_wrench(block, [-1.0, 0.8, 0], point_b=[0, 0, -0.005])
    simulation.advance(1.0)
    exact = math.hypot(1, 0.8) / 0.2 - 0.3 * G
    return abs(float(np.linalg.norm(simulation.twists()[1, :2])) / exact - 1)


@cases.case(
    "spinning on the spot under torsional friction: w falls in a line and stops at I w0 / T",
    "relative error of the time of stopping, by the spin lost in the first half",
    1e-3,
    "1",
)
def spinning_ball_slows_in_a_line() -> float:
    reach, radius, w0 = 0.002, 0.1, 10.0
    scene = world()
    scene.add(
        Sphere(radius), mass=1.0, position=[0, 0, radius], angular_velocity=[0, 0, w0],
        spinning_resistance=reach,
    )  # fmt: skip
    simulation = Simulation(scene, dt=1 / 240)
    stop = 0.4 * radius**2 * w0 / (reach * G)
    simulation.advance(stop / 2)
    half = simulation.twists()[1, 5]
    simulation.advance(stop)
    if abs(simulation.twists()[1, 5]) > 1e-9:
        return math.inf
    return abs((w0 / 2) / (w0 - half) - 1)


@cases.case(
    "a block wedged under its own friction angle must stay, however hard it is pushed in",
    "distance it backs out in 2 s after a push of 100 N, wedge angle 20 degrees, mu 0.5",
    1e-6,
    "m",
    note="a wedge of half angle a holds itself while tan(a) < mu: tan(10 degrees) = 0.18",
)
def wedge_holds_itself(friction: float = 0.5) -> float:
    half, scene = math.radians(10), Scene()  # no gravity: only friction keeps it
    for side in (1, -1):
        normal = [side * math.cos(half), 0, math.sin(half)]
        scene.add(Plane(normal, 0), static=True, friction=friction)
    points = [
        [side * (1 + z) * math.tan(half), y, z]
        for side in (1, -1)
        for y in (-0.2, 0.2)
        for z in (-0.2, 0.2)
    ]
    wedge = scene.add(ConvexHull(points), mass=1.0, position=[0, 0, 1.0], friction=friction)
    simulation = Simulation(scene, dt=1 / 240)
    simulation.hold_wrench(wedge, [0, 0, -100.0])
    simulation.advance(1.0)
    simulation.hold_wrench(wedge, [0, 0, 0.0])
    start = np.array(simulation.centres()[2])
    simulation.advance(2.0)
    return float(np.linalg.norm(simulation.centres()[2] - start))


@cases.case(
    "Painleve's rod: a slanted rod that slides on a tip with mu 2 has no solution in rigid statics",
    "energy gained in 1 s over the start, 20 angles of 5 to 85 degrees; inf if not finite",
    1e-6,
    "J",
)
def painleve_rod() -> float:
    worst = 0.0
    for i in range(20):
        angle = math.radians(5 + 80 * i / 19)
        scene = world(friction=2.0)
        turn = about([0, 1, 0], math.pi / 2 - angle)  # the rod's z axis, leaning towards +x
        tip = 0.5 * math.sin(angle) + 0.005 * math.cos(angle)
        scene.add(
            Box([0.01, 0.01, 1.0]), mass=1.0, position=[0, 0, tip + 1e-4], orientation=turn,
            velocity=[5.0, 0, 0], friction=2.0,
        )  # fmt: skip
        simulation = Simulation(scene, dt=1e-3)
        start = simulation.energy()
        base = start.kinetic + start.potential
        for _ in range(20):
            simulation.advance(0.05)
            energy = simulation.energy()
            worst = largest(worst, energy.kinetic + energy.potential - base)
        if not np.isfinite(simulation.poses()).all():
            return math.inf
    return worst
