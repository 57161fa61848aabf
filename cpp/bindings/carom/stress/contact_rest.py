# SPDX-License-Identifier: Apache-2.0
"""Bodies that should lie still: towers, mass ratios, corners, wedges, an hour of rest."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, ConvexHull, Mesh, Plane, Scene, Simulation, Sphere, UniformGravity
from carom.stress.case import Group
from carom.stress.motion import about
from carom.stress.solids import grid_mesh

cases = Group("contact")
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


@cases.case(
    "thirty boxes: a sweep over the contacts moves the load up by one box at a time",
    "how far any box of 30 gets from its place in 10 s at 60 Hz",
    1e-3,
    "m",
    has_long=True,
)
def stack_of_30(solver: str = "automatic", scale: int = 1) -> float:
    return max(drift_and_overlap(tower([1000.0] * 30), 10.0 * scale, contact_solver=solver))


@cases.case(
    "a box of a million kilograms on ten of one: sequential sweeps would need 6e7",
    "drift or overlap in 10 s at 60 Hz, the worse",
    1e-3,
    "m",
)
def heavy_on_light(solver: str = "automatic") -> float:
    return max(drift_and_overlap(tower([1.0] * 10 + [1e6]), 10.0, contact_solver=solver))


@cases.case(
    "the other order: light on heavy must not be shaken by the heavy one's rounding",
    "drift or overlap in 10 s at 60 Hz, the worse",
    1e-3,
    "m",
)
def light_on_heavy(solver: str = "automatic") -> float:
    return max(drift_and_overlap(tower([1e6] + [1.0] * 10), 10.0, contact_solver=solver))


@cases.case(
    "1000 kg, 1 g, 1000 kg: a nut between two anvils",
    "drift or overlap in 10 s at 60 Hz, the worse",
    1e-3,
    "m",
)
def heavy_light_heavy(solver: str = "automatic") -> float:
    return max(drift_and_overlap(tower([1e3, 1e-3, 1e3]), 10.0, contact_solver=solver))


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
    return max(drift_and_overlap(scene, 5.0, dt=1e-3))


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
    "largest rise of kinetic plus potential energy over the settled one, 1000 kg, 60 s",
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
        worst = max(worst, energy.kinetic + energy.potential - base)
    return worst


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
        worst = max(worst, float(np.linalg.norm(simulation.centres()[3] - start)))
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
    "a card jammed between two walls by friction alone: the forces between them are undetermined",
    "how far a 10 N push through the walls lets the card slip in 2 s",
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
        most = max(most, float(np.linalg.norm(impulse.reshape(len(impulse), -1), axis=1).sum()))
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
