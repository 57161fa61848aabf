# SPDX-License-Identifier: Apache-2.0
"""Corners, funnels, wedges, ladders and card houses: rest that hangs on more than one wall."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, ConvexHull, Plane, Simulation, Sphere
from carom.stress.case import Group, largest
from carom.stress.grounds import G, world
from carom.stress.motion import about

cases = Group("contact")


@cases.case(
    "a ball in the corner of three walls: three independent normals at once",
    "largest distance from its place in 10 s, after 5 s to settle",
    1e-6,
    "m",
    note="the limit of a box at rest for an hour",
)
def ball_in_a_corner(solver: str = "automatic") -> float:
    scene = world(ground=False)
    for normal in ([1, 0, 1], [-1, 1, 1], [-1, -1, 1]):
        scene.add(Plane(normal, 0), static=True)
    scene.add(Sphere(0.1), position=[0.01, 0.02, 0.5])
    simulation = Simulation(scene, contact_solver=solver)
    simulation.advance(5.0)
    start, worst = np.array(simulation.centres()[3]), 0.0
    for _ in range(600):
        simulation.step()
        worst = largest(worst, float(np.linalg.norm(simulation.centres()[3] - start)))
    return worst


@cases.case(
    "a ball dropped into a funnel narrower than itself, eight planes at 30 degrees to the vertical",
    "distance from the closed-form place of rest after 5 s",
    1e-3,
    "m",
    note="the library's rule for overlap at rest is 0.4 mm, which this slope doubles",
)
def ball_in_a_funnel() -> float:
    scene, tilt = world(ground=False), math.radians(30)
    for i in range(8):
        a = 2 * math.pi * i / 8
        out = np.array([math.cos(a), math.sin(a), 0])
        normal = -math.cos(tilt) * out + [0, 0, math.sin(tilt)]
        # the walls meet in the point (0, 0, 0)
        scene.add(Plane(normal, 0), static=True, friction=0.1)
    scene.add(Sphere(0.1), position=[0.003, 0.001, 1.0], friction=0.1)
    simulation = Simulation(scene)
    simulation.advance(5.0)
    rest = 0.1 / math.sin(tilt)  # distance 0.1 from every wall
    return float(np.linalg.norm(simulation.centres()[8] - [0, 0, rest]))


@cases.case(
    "a card and a block held on a wall by friction alone: how they share the load is undetermined",
    "how far either slips in 2 s, pressed with 50 N",
    1e-6,
    "m",
)
def card_between_two_walls() -> float:
    scene = world(ground=False)
    scene.add(Box([1, 1, 1]), static=True, position=[-0.5, 0, 0], friction=0.8)
    card = scene.add(Box([0.002, 0.1, 0.1]), mass=0.01, position=[0.001, 0, 0], friction=0.8)
    press = scene.add(Box([0.1, 0.1, 0.1]), mass=1.0, position=[0.052, 0, 0], friction=0.8)
    simulation = Simulation(scene, dt=1 / 240)
    # friction must hold 0.01 kg and 1 kg: mu N = 0.8 * 50 > 9.91
    simulation.hold_wrench(press, [-50.0, 0, 0])
    start = np.array(simulation.centres())
    simulation.advance(2.0)
    return float(np.abs(simulation.centres() - start)[[card, press]].max())


@cases.case(
    "a wedge of 1e-3 rad falls 5 cm into a slot: its walls push 1000 times its weight",
    "largest impulse of a step over the one that stops it, m (v + g dt) / sin(a / 2)",
    1.01,
    "of the needed",
    note="one step may see the impact and its own share of gravity; the fall is 0.99 m/s",
)
def thin_wedge_in_a_slot(dt: float = 1 / 240) -> float:
    half, scene = 5e-4, world(ground=False)
    for side in (1, -1):
        normal = [side * math.cos(half), 0, math.sin(half)]
        scene.add(Plane(normal, 0), static=True, friction=0.0)
    points = [
        [side * (10 + z) * math.tan(half), y, z]
        for side in (1, -1)
        for y in (-0.2, 0.2)
        for z in (-0.5, 0)
    ]
    scene.add(ConvexHull(points), mass=1.0, position=[0, 0, 10.05], friction=0.0)
    simulation = Simulation(scene, dt=dt)
    most = 0.0
    for _ in range(round(5 / dt)):
        simulation.step()
        impulse = simulation.contacts()["impulse"]
        most = largest(most, float(np.linalg.norm(impulse.reshape(len(impulse), -1), axis=1).sum()))
    if not np.isfinite(simulation.poses()).all() or most == 0:
        return math.inf
    return most / ((math.sqrt(2 * G * 0.05) + G * dt) / math.sin(half))


@cases.case(
    "two cards lean on each other; they stand while mu >= tan(a) / 2, and fall beyond",
    "of tilts 10 % on either side of the bound, wrong outcomes",
    0,
    "outcomes",
)
def house_of_two_cards(friction: float = 0.3) -> float:
    wrong = 0
    for factor in (0.9, 1.1):
        tilt = math.atan(2 * friction * factor)
        scene = world(friction=friction)
        length, thick = 1.0, 0.01
        for side in (1, -1):
            # the lower outer edge on the ground, the upper inner edge on the plane x = 0
            turn = about([0, 1, 0], -side * tilt)
            c, s = math.cos(tilt), math.sin(tilt)
            x = side * (length * s / 2 + thick * c / 2)
            z = length * c / 2 + thick * s / 2
            scene.add(
                Box([thick, 0.6, length]), position=[x, 0, z], orientation=turn, friction=friction
            )
        simulation = Simulation(scene, dt=1 / 240)
        start = simulation.centres()[1][2]
        simulation.advance(2.0)
        stands = simulation.centres()[1][2] > 0.98 * start
        wrong += stands != (factor < 1)
    return wrong


@cases.case(
    "a ladder against a smooth wall stands while mu >= tan(a) / 2, and slides beyond",
    "of tilts 5 % on either side of the bound, wrong outcomes",
    0,
    "outcomes",
)
def ladder_on_a_smooth_wall(friction: float = 0.3) -> float:
    wrong, length, thick = 0, 1.0, 1e-3
    for factor in (0.95, 1.05):
        tilt = math.atan(2 * friction * factor)
        scene = world(friction=friction)
        scene.add(Box([1, 4, 4]), static=True, position=[-0.5, 0, 1], friction=0.0)
        x = length * math.sin(tilt) / 2 + thick * math.cos(tilt) / 2
        z = length * math.cos(tilt) / 2 + thick * math.sin(tilt) / 2
        scene.add(
            Box([thick, 0.6, length]),
            position=[x, 0, z],
            orientation=about([0, 1, 0], -tilt),
            friction=friction,
        )
        simulation = Simulation(scene, dt=1 / 240)
        simulation.advance(2.0)
        stands = simulation.centres()[2][2] > 0.98 * z
        wrong += stands != (factor < 1)
    return wrong


@cases.case(
    "books over the edge of a table stand to half of 1 + 1/2 + 1/3 + 1/4 lengths and no further",
    "of overhangs 1 % under and over the bound, wrong outcomes",
    0,
    "outcomes",
)
def book_overhang() -> float:
    wrong = 0
    for factor in (0.99, 1.01):
        scene = world(ground=False)
        scene.add(Box([2.0, 1.0, 1.0]), static=True, position=[-1.0, 0, -0.5])
        x = 0.0
        for k in range(4, 0, -1):  # from the lowest book up
            x += factor / (2 * k)
            scene.add(Box([1.0, 0.6, 0.1]), position=[x - 0.5, 0, 0.05 + 0.1 * (4 - k)])
        simulation = Simulation(scene, dt=1 / 240)
        start = np.array(simulation.centres())
        simulation.advance(3.0)
        stands = float(np.linalg.norm(simulation.centres() - start, axis=1).max()) < 0.02
        wrong += stands != (factor < 1)
    return wrong


@cases.case(
    "a semicircular arch of 15 stones stands while it is thicker than 0.1075 of its radius",
    "of thicknesses 0.12 and 0.09, wrong outcomes",
    0,
    "outcomes",
    note="0.1075 is for infinitely many stones that do not slide; 15 may do with a little less",
)
def masonry_arch() -> float:
    wrong, stones, turn = 0, 15, math.pi / 15
    for thickness in (0.12, 0.09):
        scene = world(friction=1.0)
        for i in range(stones):
            points = [
                [r * math.cos(a), y, r * math.sin(a)]
                for r in (1 - thickness / 2, 1 + thickness / 2)
                for a in (i * turn, (i + 1) * turn)
                for y in (-0.1, 0.1)
            ]
            middle = np.mean(points, axis=0)
            scene.add(ConvexHull(points - middle), position=middle, friction=1.0)
        simulation = Simulation(scene, dt=1 / 240)
        top = simulation.centres()[1 + stones // 2][2]
        simulation.advance(4.0)
        stands = simulation.centres()[1 + stones // 2][2] > 0.95 * top
        wrong += stands != (thickness > 0.1075)
    return wrong
