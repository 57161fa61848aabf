# SPDX-License-Identifier: Apache-2.0
"""Bodies too fast for the step, told by their poses alone: none may be where it cannot get."""

from __future__ import annotations

import math

import numpy as np

from carom import Box, Compound, ConvexHull, Mesh, Part, Plane, Scene, Simulation, Sphere
from carom.stress.case import Group, largest
from carom.stress.motion import about, matrix
from carom.stress.solids import ball_mesh, grid_mesh

cases = Group("ccd")


@cases.case(
    "1200 m in one step against a plate of 0.1 mm: before and after it is far away",
    "of 12 balls, boxes, hulls and meshes with spin, those found behind the plate",
    0,
    "bodies",
)
def bullets_against_a_plate(ccd: str = "auto") -> float:
    rng, through = np.random.default_rng(81), 0
    ball = ball_mesh(0.01, 1)
    shapes = (Sphere(0.01), Box([0.02] * 3), ConvexHull(ball[0]), Mesh(*ball))
    for i in range(12):
        scene = Scene()
        scene.add(Box([1e-4, 20, 20]), static=True)
        scene.add(
            shapes[i % 4], position=[-700.0, *rng.uniform(-1, 1, 2)], velocity=[12_000, 0, 0],
            angular_velocity=rng.uniform(-100, 100, 3), restitution=0.5 * (i % 3), ccd=ccd,
        )  # fmt: skip
        simulation = Simulation(scene, dt=0.1)
        for _ in range(5):
            simulation.step()
            if not simulation.centres()[1, 0] <= 0:
                through += 1
                break
    return through


def _rod_at_a_wall(dt: float, ccd: str) -> tuple[float, float, float]:
    """(deepest corner inside the wall, m; spin after the hit and its closed form, rad/s).

    A free rod turns about z at 100 rad/s beside a wall 0.4 m away, until a corner meets it. With
    neither friction nor bounce the impulse there is w p / (1/m + p^2/I), p the corner's lever.
    """
    length, width, gap, spin, mass = 1.0, 0.02, 0.4, 100.0, 1.0
    scene = Scene()
    scene.add(Box([0.01, 4, 4]), static=True, position=[gap + 0.005, 0, 0], friction=0.0)
    rod = scene.add(
        Box([length, width, width]), mass=mass, orientation=about([0, 0, 1], math.pi / 2),
        angular_velocity=[0, 0, -spin], friction=0.0, ccd=ccd,
    )  # fmt: skip
    simulation = Simulation(scene, dt=dt)
    corners = 0.5 * np.array(
        [[i * length, j * width, k * width] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
    )
    deepest = 0.0
    for _ in range(math.ceil(0.1 / dt)):
        simulation.step()
        pose = simulation.poses()[rod]
        x = (corners @ matrix(pose[3:]).T + pose[:3])[:, 0]
        deepest = largest(deepest, float(x.max()) - gap)
    reach = math.hypot(length, width) / 2  # of a corner
    lever = math.sqrt(reach**2 - gap**2)
    inertia = mass * (length**2 + width**2) / 12
    impulse = spin * lever / (1 / mass + lever**2 / inertia)
    return deepest, -float(simulation.twists()[rod, 5]), spin - impulse * lever / inertia


@cases.case(
    "a rod at 100 rad/s, 1.7 rad per step, swings into a 1 cm wall: others let it in by 20 cm",
    "deepest corner inside the wall in 0.1 s at 60 Hz",
    1e-4,
    "m",
)
def spinning_rod_stays_out(ccd: str = "auto") -> float:
    return _rod_at_a_wall(1 / 60, ccd)[0]


@cases.case(
    "the same rod: clamping its rotation keeps it out and kills its spin (4 to 12 rad/s elsewhere)",
    "error of the spin after the hit over its closed form, at 60 Hz",
    0.05,
    "1",
)
def spinning_rod_keeps_its_spin(ccd: str = "auto") -> float:
    _, found, exact = _rod_at_a_wall(1 / 60, ccd)
    return abs(found / exact - 1)


@cases.case(
    "a closed cup is jerked at up to 100 m/s at every step: its balls are hit from all sides",
    "of 6 balls, those outside after 100 steps of 1/60 s",
    0,
    "balls",
    has_long=True,
)
def shaken_cup_keeps_its_balls(ccd: str = "auto", scale: int = 1) -> float:
    rng, half, thick = np.random.default_rng(82), 0.5, 0.01
    parts = []
    for axis in range(3):
        extents = [2 * (half + thick)] * 3
        extents[axis] = thick
        for side in (1, -1):
            place = np.zeros(3)
            place[axis] = side * (half + thick / 2)
            parts.append(Part(Box(extents), place))
    scene = Scene()
    cup = scene.add(Compound(parts), mass=1e4, restitution=0.5, ccd=ccd)
    for i in range(6):
        scene.add(
            Sphere(0.05), mass=1.0, position=[0.3 * (i % 3 - 1), 0.3 * (i // 3) - 0.15, 0.0],
            restitution=0.5, ccd=ccd,
        )  # fmt: skip
    simulation, out = Simulation(scene), set()
    for _ in range(100 * scale):
        simulation.set_state(
            cup, velocity=rng.uniform(-60, 60, 3), angular_velocity=rng.uniform(-5, 5, 3)
        )
        simulation.step()
        pose = simulation.poses()[cup]
        seen = (simulation.centres()[1:] - pose[:3]) @ matrix(pose[3:])
        out |= set(np.nonzero(~(np.abs(seen).max(axis=1) < half))[0].tolist())
    return len(out)


@cases.case(
    "five sheets of 50 micrometres, 1 cm apart, under fire at 300 m/s",
    "of 20 balls and boxes, those found behind the first sheet within 6 steps",
    0,
    "bodies",
)
def sheets_of_fifty_micrometres(ccd: str = "auto") -> float:
    rng, scene = np.random.default_rng(83), Scene()
    for i in range(5):
        scene.add(Box([4, 4, 50e-6]), static=True, position=[0, 0, -0.01 * i])
    for i in range(20):
        scene.add(
            Sphere(0.01) if i % 2 else Box([0.02] * 3), velocity=[*rng.uniform(-30, 30, 2), -300],
            position=[-0.9 + 0.45 * (i % 5), -0.6 + 0.4 * (i // 5), 7.0 + 0.1 * i],
            angular_velocity=rng.uniform(-50, 50, 3), ccd=ccd,
        )  # fmt: skip
    simulation, through = Simulation(scene), set()
    for _ in range(6):
        simulation.step()
        through |= set(np.nonzero(~(simulation.centres()[5:, 2] >= 0))[0].tolist())
    return len(through)


def _chain(ccd: str) -> Simulation:
    """A hundred balls in a row, 1 mm apart, and one that comes at 300 m/s."""
    scene = Scene()
    for i in range(100):
        scene.add(
            Sphere(0.01), mass=0.03, position=[0.021 * i, 0, 0], restitution=1.0, friction=0.0,
            ccd=ccd,
        )  # fmt: skip
    scene.add(
        Sphere(0.01), mass=0.03, position=[-3.0, 0, 0], velocity=[300, 0, 0], restitution=1.0,
        friction=0.0, ccd=ccd,
    )  # fmt: skip
    return Simulation(scene)


@cases.case(
    "a row of 100 balls hit at 300 m/s: a hundred hits, one after the other, in one step",
    "deepest overlap of two neighbours, or inf if their order has changed",
    1e-4,
    "m",
)
def chain_of_balls_keeps_its_order(ccd: str = "auto") -> float:
    simulation, deepest = _chain(ccd), 0.0
    for _ in range(6):
        simulation.step()
        x = simulation.centres()[:, 0]
        gaps = np.diff(np.concatenate([x[-1:], x[:-1]]))
        if gaps.min() <= 0:
            return math.inf
        deepest = largest(deepest, 0.02 - float(gaps.min()))
    return deepest


@cases.case(
    "the same row: what goes in must come out, however many hits a step has to hold",
    "relative error of the momentum after six steps",
    1e-12,
    "1",
)
def chain_of_balls_keeps_its_momentum(ccd: str = "auto") -> float:
    simulation = _chain(ccd)
    before = simulation.momentum()[0]
    simulation.advance(0.1)
    return abs(simulation.momentum()[0] / before - 1)


@cases.case(
    "two balls of 1 cm head on at 5000 m/s each: in one step each crosses the other's whole place",
    "of 20 pairs, those that have changed their order",
    0,
    "pairs",
)
def balls_head_on(ccd: str = "auto") -> float:
    wrong = 0
    for i in range(20):
        scene = Scene()
        for side in (-1, 1):
            scene.add(
                Sphere(0.01), mass=1.0, position=[side * (20.0 + 7 * i), 0, 0],
                velocity=[-side * 5000, 0, 0], restitution=0.05 * i, ccd=ccd,
            )  # fmt: skip
        simulation = Simulation(scene)
        simulation.advance(5 / 60)
        wrong += not simulation.centres()[0, 0] < simulation.centres()[1, 0]
    return wrong


@cases.case(
    "an elastic ball at 1000 m/s between walls 1 mm from it: 8000 hits in one step (Zeno's cap)",
    "how far its centre gets beyond the walls in 60 steps",
    0,
    "m",
)
def ball_in_a_narrow_gap(ccd: str = "auto") -> float:
    scene = Scene()
    for side in (-1, 1):
        scene.add(
            Box([1, 2e5, 2e5]), static=True, position=[side * (0.5 + 0.051), 0, 0],
            restitution=1.0, friction=0.0,
        )  # fmt: skip
    scene.add(Sphere(0.05), velocity=[1000.0, 3.0, 0], restitution=1.0, friction=0.0, ccd=ccd)
    simulation, worst = Simulation(scene), 0.0
    for _ in range(60):
        simulation.step()
        worst = largest(worst, abs(float(simulation.centres()[2, 0])) - 0.051)
        if not math.isfinite(worst):
            return math.inf
    return largest(worst, 0.0)


@cases.case(
    "a box shot at 500 m/s between walls that converge by 4 degrees: ever more hits, ever closer",
    "deepest corner inside a wall at the end of any of 60 steps; inf if not finite",
    1e-3,
    "m",
)
def box_between_converging_walls(ccd: str = "auto") -> float:
    half, scene = math.radians(2), Scene()
    normals = [[side * math.cos(half), 0, math.sin(half)] for side in (1, -1)]
    for normal in normals:
        scene.add(Plane(normal, 0), static=True, friction=0.2)
    scene.add(
        Box([0.1, 0.15, 0.2]), mass=1.0, position=[0.01, 0, 8.0], velocity=[20, 0, -500],
        angular_velocity=[0, 30, 0], restitution=0.3, friction=0.2, ccd=ccd,
    )  # fmt: skip
    simulation, deepest = Simulation(scene), 0.0
    corners = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    corners = corners * [0.05, 0.075, 0.1]
    for _ in range(60):
        simulation.step()
        pose = simulation.poses()[2]
        if not np.isfinite(pose).all():
            return math.inf
        points = corners @ matrix(pose[3:]).T + pose[:3]
        deepest = largest(deepest, float(-(points @ np.array(normals).T).min()))
    return deepest


@cases.case(
    "a mesh ball spins at 500 rad/s on its way through an open mesh: triangles against triangles",
    "of 8 meshes at 50 to 6400 m/s, those with a point 1 mm behind the sheet",
    0,
    "meshes",
)
def mesh_against_a_sheet(ccd: str = "auto") -> float:
    rng, through = np.random.default_rng(84), 0
    vertices, faces = ball_mesh(0.1, 1)
    vertices = vertices * [1.0, 0.5, 0.25]
    for i in range(8):
        speed = 50.0 * 2**i
        scene = Scene()
        scene.add(Mesh(*grid_mesh(6.0, 3)), static=True)
        spin = rng.normal(size=3)
        scene.add(
            Mesh(vertices, faces), position=[0.3, 0.2, 0.2 + 1.7 * speed / 60],
            velocity=[0, 0, -speed], angular_velocity=spin / np.linalg.norm(spin) * 500, ccd=ccd,
        )  # fmt: skip
        simulation = Simulation(scene)
        for _ in range(6):
            simulation.step()
            pose = simulation.poses()[1]
            points = vertices @ matrix(pose[3:]).T + pose[:3]
            if not np.isfinite(points).all():
                return math.inf
            inside = np.abs(points[:, :2]).max(axis=1) < 2.9
            if pose[2] < 0 and np.abs(pose[:2]).max() < 2.9:
                through += 1
                break
            if inside.any() and points[inside, 2].min() < -1e-3:
                through += 1
                break
    return through
